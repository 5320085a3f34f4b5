#include <cctype>
#include <cmath>
#include <cstdint>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fmt/format.h>

#include "image/atomic_file.h"
#include "image/image.h"
#include "image/one_line.h"

namespace lkao::image {
namespace {

enum class Format { exr, png };

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
}

Format format_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".exr") return Format::exr;
  if (ending == ".png") return Format::png;
  if (ending.empty()) fail(path, "the file name has no ending; images are written as .exr or .png");
  fail(path, fmt::format("images of type '{}' are not supported; use .exr or .png", ending));
}

void check_image(const std::string& path, const Image& image, Format format) {
  const int channel_count = image.channel_count();
  if (image.width <= 0 || image.height <= 0 || channel_count == 0) fail(path, "the image is empty");
  const std::size_t value_count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                                  static_cast<std::size_t>(channel_count);
  if (image.pixels.size() != value_count) {
    fail(path,
         "the image has " + std::to_string(image.pixels.size()) + " values instead of " + std::to_string(value_count));
  }
  const std::set<std::string> names(image.channels.begin(), image.channels.end());
  if (names.size() != image.channels.size()) fail(path, "two channels have the same name");
  if (names.contains("")) fail(path, "a channel has no name");
  if (format == Format::png && channel_count > 4) {
    fail(path, fmt::format("PNG holds at most 4 channels, the image has {}", channel_count));
  }
}

std::uint8_t to_8_bits(float value) {
  if (std::isnan(value)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
}

OIIO::ImageSpec make_spec(const Image& image, Format format) {
  const OIIO::TypeDesc type = format == Format::exr ? OIIO::TypeFloat : OIIO::TypeUInt8;
  OIIO::ImageSpec spec(image.width, image.height, image.channel_count(), type);
  if (format == Format::exr) {
    spec.channelnames = image.channels;
    spec.alpha_channel = -1;  // whatever a channel is called, its values are data
    spec.z_channel = -1;
    spec.attribute("compression", "zip");
  } else {
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);  // values as they are
  }
  return spec;
}

bool write_pixels(OIIO::ImageOutput& output, const Image& image, Format format) {
  if (format == Format::exr) return output.write_image(OIIO::TypeFloat, image.pixels.data());
  std::vector<std::uint8_t> bytes(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), bytes.begin(), to_8_bits);
  return output.write_image(OIIO::TypeUInt8, bytes.data());
}

// The whole file, in memory: OpenImageIO does not report every fault of a disk.
std::vector<unsigned char> encode(const std::string& path, const Image& image, Format format) {
  const char* const name = format == Format::exr ? "out.exr" : "out.png";
  const auto output = OIIO::ImageOutput::create(name);
  if (!output) fail(path, one_line(OIIO::geterror()));
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output->set_ioproxy(&memory) || !output->open(name, make_spec(image, format)) ||
      !write_pixels(*output, image, format) || !output->close()) {
    fail(path, one_line(output->geterror()));
  }
  return bytes;
}

}  // namespace

void write_image(const std::string& path, const Image& image) {
  const Format format = format_of(path);
  check_image(path, image, format);
  const std::vector<unsigned char> bytes = encode(path, image, format);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void check_image_path(const std::string& path) {
  format_of(path);
  AtomicFile{path};
}

}  // namespace lkao::image
