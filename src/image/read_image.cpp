#include <filesystem>
#include <memory>
#include <stdexcept>

#include <OpenImageIO/imageio.h>

#include <fmt/format.h>

#include "image/image.h"
#include "image/one_line.h"
#include "image/png_check.h"

namespace lkao::image {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("cannot read '{}': {}", path, reason));
}

void check_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail(path, "there is no such file");
  if (std::filesystem::is_directory(path, error)) fail(path, "is a directory");
  const std::string damage = find_png_damage(path);
  if (!damage.empty()) fail(path, damage);
}

std::unique_ptr<OIIO::ImageInput> open(const std::string& path) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // values as they are in the file
  auto input = OIIO::ImageInput::open(path, &config);
  if (!input) fail(path, one_line(OIIO::geterror()));
  if (input->spec().deep) fail(path, "deep images are not supported");
  return input;
}

}  // namespace

Image read_image(const std::string& path) {
  check_file(path);
  const auto input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  Image image{spec.width, spec.height, spec.channelnames, {}};
  try {
    image.pixels.resize(static_cast<std::size_t>(spec.image_pixels()) * static_cast<std::size_t>(spec.nchannels));
  } catch (const std::exception&) {
    fail(path, fmt::format("an image of {} x {} pixels does not fit into memory", spec.width, spec.height));
  }
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, image.pixels.data()) || !input->close()) {
    fail(path, one_line(input->geterror()));
  }
  return image;
}

}  // namespace lkao::image
