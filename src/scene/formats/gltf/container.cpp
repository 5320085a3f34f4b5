#include "scene/formats/gltf/container.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include "scene/formats/gltf/load_number.h"
#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

constexpr std::size_t kHeaderSize = 12;  // magic, version, length of the file
constexpr std::size_t kChunkHeaderSize = 8;
constexpr std::string_view kJsonChunk = "JSON";
constexpr std::string_view kBinaryChunk("BIN\0", 4);

std::uint32_t load_uint32(std::string_view bytes, std::size_t offset) {
  return load_number<std::uint32_t>(bytes.data() + offset);
}

struct Chunk {
  std::string_view type;
  std::string_view content;
};

// Takes the first chunk off. Old writers do not pad chunks to four bytes: the next begins where the length says.
Chunk take_chunk(std::string_view& bytes) {
  const std::size_t size = load_uint32(bytes, 0);
  const std::string_view type = bytes.substr(4, 4);
  bytes.remove_prefix(kChunkHeaderSize);
  if (size > bytes.size()) {
    throw std::runtime_error(
        fmt::format("malformed GLB: a chunk of {} bytes exceeds the file, which has {} more", size, bytes.size()));
  }
  const Chunk chunk{type, bytes.substr(0, size)};
  bytes.remove_prefix(size);
  return chunk;
}

// Some writers fill the chunk up with zeros, which JSON does not know.
std::string_view without_padding(std::string_view json) {
  while (json.ends_with('\0')) json.remove_suffix(1);
  return json;
}

Container open_glb(std::string_view bytes) {
  if (bytes.size() < kHeaderSize + kChunkHeaderSize) throw std::runtime_error("truncated GLB: there is no header");
  const std::uint32_t version = load_uint32(bytes, 4);
  if (version != 2) throw std::runtime_error(fmt::format("GLB version {} is not supported, only 2", version));
  const std::size_t length = load_uint32(bytes, 8);
  if (bytes.size() < length) throw std::runtime_error(fmt::format("truncated: {} of {} bytes", bytes.size(), length));
  if (length < kHeaderSize + kChunkHeaderSize) {
    throw std::runtime_error(fmt::format("malformed GLB: it says that it has {} bytes", length));
  }
  std::string_view rest = bytes.substr(kHeaderSize, length - kHeaderSize);
  const Chunk first = take_chunk(rest);
  if (first.type != kJsonChunk) throw std::runtime_error("malformed GLB: its first chunk is not JSON");
  Container container{without_padding(first.content), {}};
  while (rest.size() >= kChunkHeaderSize && !container.binary) {
    const Chunk chunk = take_chunk(rest);
    if (chunk.type == kBinaryChunk) container.binary = chunk.content;
  }
  return container;
}

}  // namespace

Container open_container(std::string_view bytes) {
  if (bytes.starts_with("glTF")) return open_glb(bytes);
  return {without_byte_order_mark(bytes), {}};
}

}  // namespace lkao::scene::gltf
