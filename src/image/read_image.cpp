#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "image/codec.h"
#include "image/image.h"
#include "image/png_check.h"

namespace lkao::image {
namespace {

[[noreturn]] void fail_to_read(const std::string& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("cannot read '{}': {}", path, reason));
}

void check_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail_to_read(path, "there is no such file");
  if (std::filesystem::is_directory(path, error)) fail_to_read(path, "is a directory");
  const std::string damage = find_png_damage(path);
  if (!damage.empty()) fail_to_read(path, damage);
}

}  // namespace

Image read_image(const std::string& path) {
  check_file(path);
  return codec().read(path);
}

Image decode_image(const std::string& path, std::string_view bytes) {
  const std::string damage = find_png_damage_in(bytes);
  if (!damage.empty()) fail_to_read(path, damage);
  return codec().decode(path, bytes);
}

}  // namespace lkao::image
