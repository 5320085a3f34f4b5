#include <cctype>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "image/atomic_file.h"
#include "image/codec.h"
#include "image/image.h"

namespace lkao::image {
namespace {

[[noreturn]] void fail_to_write(const std::string& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
}

Format format_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".exr") return Format::exr;
  if (ending == ".png") return Format::png;
  if (ending.empty()) fail_to_write(path, "the file name has no ending; images are written as .exr or .png");
  fail_to_write(path, fmt::format("images of type '{}' are not supported; use .exr or .png", ending));
}

void check_image(const std::string& path, const Image& image, Format format) {
  const int channel_count = image.channel_count();
  if (image.width <= 0 || image.height <= 0 || channel_count == 0) fail_to_write(path, "the image is empty");
  const std::size_t value_count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                  static_cast<std::size_t>(channel_count);
  if (image.pixels.size() != value_count) {
    fail_to_write(path, "the image has " + std::to_string(image.pixels.size()) + " values instead of " +
                            std::to_string(value_count));
  }
  const std::set<std::string> names(image.channels.begin(), image.channels.end());
  if (names.size() != image.channels.size()) fail_to_write(path, "two channels have the same name");
  if (names.contains("")) fail_to_write(path, "a channel has no name");
  if (format == Format::png && channel_count > 4) {
    fail_to_write(path, fmt::format("PNG holds at most 4 channels, the image has {}", channel_count));
  }
}

}  // namespace

void write_image(const std::string& path, const Image& image) {
  const Format format = format_of(path);
  check_image(path, image, format);
  const std::vector<unsigned char> bytes = codec().encode(path, image, format);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string encode_png(const std::string& path, const Image& image) {
  check_image(path, image, Format::png);
  const std::vector<unsigned char> bytes = codec().encode(path, image, Format::png);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void check_image_path(const std::string& path) {
  format_of(path);
  AtomicFile{path};
}

}  // namespace lkao::image
