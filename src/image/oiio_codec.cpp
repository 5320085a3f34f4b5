// The shared object lkao_image_codec.so: see codec.h.
#include <cmath>
#include <cstdint>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fmt/format.h>

#include "image/codec.h"
#include "image/one_line.h"

namespace lkao::image {
namespace {

// --- Reading
// -----------------------------------------------------------------------------------------------------------

[[noreturn]] void fail_to_read(const std::string& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("cannot read '{}': {}", path, reason));
}

std::unique_ptr<OIIO::ImageInput> open(const std::string& path, const std::string& name,
                                       OIIO::Filesystem::IOProxy* memory) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // values as they are in the file
  if (memory != nullptr) config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &memory);
  auto input = OIIO::ImageInput::open(name, &config);
  if (!input) fail_to_read(path, one_line(OIIO::geterror()));
  if (input->spec().deep) fail_to_read(path, "deep images are not supported");
  return input;
}

// `path` is for messages.
Image read_from(const std::string& path, const std::string& name, OIIO::Filesystem::IOProxy* memory) {
  const auto input = open(path, name, memory);
  const OIIO::ImageSpec& spec = input->spec();
  Image image{spec.width, spec.height, spec.channelnames, {}};
  try {
    image.pixels.resize(static_cast<std::size_t>(spec.image_pixels()) * static_cast<std::size_t>(spec.nchannels));
  } catch (const std::exception&) {
    fail_to_read(path, fmt::format("an image of {} x {} pixels does not fit into memory", spec.width, spec.height));
  }
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, image.pixels.data()) || !input->close()) {
    fail_to_read(path, one_line(input->geterror()));
  }
  return image;
}

Image read(const std::string& path) { return read_from(path, path, nullptr); }

Image decode(const std::string& path, std::string_view bytes) {
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const bool is_webp = bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP");
  return read_from(path, is_webp ? "in.webp" : bytes.starts_with("\xff\xd8") ? "in.jpg" : "in.png", &memory);
}

// --- Writing
// -----------------------------------------------------------------------------------------------------------

[[noreturn]] void fail_to_write(const std::string& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
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
    spec.attribute("DateTime", "1970:01:01 00:00:00");  // instead of now: equal images are equal files
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
  if (!output) fail_to_write(path, one_line(OIIO::geterror()));
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output->set_ioproxy(&memory) || !output->open(name, make_spec(image, format)) ||
      !write_pixels(*output, image, format) || !output->close()) {
    fail_to_write(path, one_line(output->geterror()));
  }
  return bytes;
}

}  // namespace
}  // namespace lkao::image

extern "C" __attribute__((visibility("default"))) const lkao::image::Codec* lkao_image_codec() {
  static constexpr lkao::image::Codec codec{lkao::image::read, lkao::image::decode, lkao::image::encode};
  return &codec;
}
