#include "image/codec.h"

#include <stdexcept>

#include <dlfcn.h>

#include <fmt/format.h>

#include "image/one_line.h"

namespace lkao::image {
namespace {

// Found by the run path of what this is linked into: the program has it in its own folder, or as installed, Python's
// module beside it. Stays until the program ends.
const Codec& load() {
  void* const object = dlopen("lkao_image_codec.so", RTLD_NOW | RTLD_LOCAL);
  void* const function = object != nullptr ? dlsym(object, kCodecFunction) : nullptr;
  if (function == nullptr) throw std::runtime_error(fmt::format("cannot load images: {}", one_line(dlerror())));
  return *reinterpret_cast<const Codec* (*)()>(function)();
}

}  // namespace

const Codec& codec() {
  static const Codec& loaded = load();
  return loaded;
}

}  // namespace lkao::image
