#include "scene/formats/file_bytes.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace lkao::scene {

namespace {

FileBytes read_whole(std::ifstream& in, std::size_t size) {
  FileBytes bytes{std::make_unique_for_overwrite<char[]>(size), 0};
  in.read(bytes.data.get(), static_cast<std::streamsize>(size));
  bytes.size = static_cast<std::size_t>(in.gcount());
  return bytes;
}

// Of a pipe or a device, which has no size.
FileBytes read_to_end(std::ifstream& in) {
  const std::string text(std::istreambuf_iterator<char>(in), {});
  FileBytes bytes{std::make_unique_for_overwrite<char[]>(text.size()), text.size()};
  std::copy(text.begin(), text.end(), bytes.data.get());
  return bytes;
}

}  // namespace

FileBytes read_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw std::runtime_error("no such file");
  if (std::filesystem::is_directory(status)) throw std::runtime_error("is a directory, not a mesh file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot be opened for reading");
  const std::uintmax_t size = std::filesystem::is_regular_file(status) ? std::filesystem::file_size(path, error) : 0;
  FileBytes bytes = size > 0 && !error ? read_whole(in, size) : read_to_end(in);
  if (in.bad()) throw std::runtime_error("cannot be read");
  return bytes;
}

FileBytes read_regular_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
    throw std::runtime_error("is no file");
  }
  return read_file(path);
}

}  // namespace lkao::scene
