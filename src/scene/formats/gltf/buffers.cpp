#include "scene/formats/gltf/buffers.h"

#include <stdexcept>

#include <fmt/format.h>

#include "scene/formats/gltf/meshopt.h"
#include "scene/formats/gltf/uri.h"
#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

FileBytes read_buffer(const std::string& path, const std::string& uri) {
  try {
    return read_regular_file(path);
  } catch (const std::runtime_error& fault) {
    throw std::runtime_error(fmt::format("its buffer {}: {}", in_quotes(uri), fault.what()));
  }
}

}  // namespace

Buffers::Buffers(Value root, std::optional<std::string_view> binary, std::string path, std::size_t file_size)
    : root_(std::move(root)), binary_(binary), path_(std::move(path)), byte_count_(file_size) {}

BufferView Buffers::view(const Value& index) {
  const Value view = item_of_list(root_, "bufferViews", index);
  const std::size_t stride = count_or(view, "byteStride", 0);
  std::optional<Value> compression = view.extension("EXT_meshopt_compression");
  if (!compression) compression = view.extension("KHR_meshopt_compression");
  if (!compression) return {view.place(), slice(view), stride};
  const auto [entry, is_new] = decompressed_.try_emplace(index.count());
  if (is_new) entry->second = decode_meshopt(*compression, slice(*compression));
  return {view.place(), entry->second, stride};
}

std::string_view Buffers::slice(const Value& place) {
  const Value index = place.at("buffer");
  item_of_list(root_, "buffers", index);
  const std::string_view bytes = buffer(index.count());
  const std::size_t offset = count_or(place, "byteOffset", 0);
  const std::size_t size = place.at("byteLength").count();
  if (offset > bytes.size() || size > bytes.size() - offset) {
    throw std::runtime_error(
        fmt::format("{}: {} bytes at {} go beyond its buffer of {}", place.place(), size, offset, bytes.size()));
  }
  return bytes.substr(offset, size);
}

std::string_view Buffers::buffer(std::size_t number) {
  const Value buffer = root_.at("buffers").element(number);
  const std::string_view bytes = content_of(buffer, number);
  const std::size_t size = buffer.at("byteLength").count();
  if (bytes.size() < size) {
    const std::optional<Value> uri = buffer.find("uri");
    throw std::runtime_error(fmt::format("its buffer {} is truncated: {} of {} bytes",
                                         uri && !is_data_uri(uri->text()) ? in_quotes(uri->text()) : buffer.place(),
                                         bytes.size(), size));
  }
  return bytes.substr(0, size);
}

std::string_view Buffers::content_of(const Value& buffer, std::size_t number) {
  const std::optional<Value> uri = buffer.find("uri");
  if (!uri) {
    if (number == 0 && binary_) return *binary_;
    throw std::runtime_error(fmt::format("{} has no uri, and there is no chunk for it", buffer.place()));
  }
  if (is_data_uri(uri->text())) {
    const auto [entry, is_new] = data_.try_emplace(number);
    if (is_new) entry->second = decode_data_uri(uri->text());
    return entry->second;
  }
  const std::string path = resolve_uri(path_, uri->text());
  const auto [entry, is_new] = files_.try_emplace(path);
  if (is_new) {
    entry->second = read_buffer(path, uri->text());
    byte_count_ += entry->second.size;
  }
  return entry->second.view();
}

}  // namespace lkao::scene::gltf
