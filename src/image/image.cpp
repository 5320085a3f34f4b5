#include "image/image.h"

#include <algorithm>

namespace lkao::image {

int Image::channel(const std::string& name) const {
  const auto found = std::find(channels.begin(), channels.end(), name);
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

}  // namespace lkao::image
