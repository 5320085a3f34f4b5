#include "scene/formats/gltf/parse.h"

#include <cstddef>
#include <stdexcept>

#include "scene/formats/text.h"

namespace lkao::scene::gltf {

nlohmann::json parse(std::string_view text) {
  constexpr std::size_t kLongest = 200;  // the message quotes what could not be read
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1 ...": the part in brackets helps nobody.
    const std::string_view what = error.what();
    throw std::runtime_error("truncated or malformed glTF: " + shortened(what.substr(what.find(']') + 2), kLongest));
  }
}

}  // namespace lkao::scene::gltf
