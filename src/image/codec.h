// Image files through OpenImageIO, which brings some 250 shared libraries: half a second to load. So what needs it is a
// shared object of its own, lkao_image_codec.so, loaded when the first image is read or written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace lkao::image {

enum class Format { exr, png };

// All throw std::runtime_error with one line naming `path` and the fault.
struct Codec {
  Image (*read)(const std::string& path);
  // Of a PNG, JPEG or WebP in memory; `path` is for messages.
  Image (*decode)(const std::string& path, std::string_view bytes);
  // The bytes of a file; `path` is for messages.
  std::vector<unsigned char> (*encode)(const std::string& path, const Image& image, Format format);
};

// Throws std::runtime_error with one line where the shared object is missing. Any thread.
const Codec& codec();

// The one function that the shared object exports.
inline constexpr const char* kCodecFunction = "lkao_image_codec";

}  // namespace lkao::image
