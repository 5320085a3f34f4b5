#include "scene/formats/gltf/container.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
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
  Container container{.json = without_padding(first.content), .binary = {}, .is_glb = true};
  while (rest.size() >= kChunkHeaderSize && !container.binary) {
    const std::string_view before = rest;
    const Chunk chunk = take_chunk(rest);
    if (chunk.type == kBinaryChunk) {
      container.binary = chunk.content;
    } else {
      container.others.push_back(before.substr(0, before.size() - rest.size()));
    }
  }
  if (!rest.empty()) container.others.push_back(rest);
  return container;
}

void append_uint32(std::string& bytes, std::size_t number) {
  const auto value = static_cast<std::uint32_t>(number);
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void append_chunk(std::string& bytes, std::string_view type, std::string_view content, char padding) {
  const std::size_t missing = (4 - content.size() % 4) % 4;
  append_uint32(bytes, content.size() + missing);
  bytes.append(type).append(content).append(missing, padding);
}

}  // namespace

std::string make_glb(std::string_view json, std::optional<std::string_view> binary,
                     const std::vector<std::string_view>& others) {
  constexpr std::size_t kPadding = 3;  // at most, of each chunk
  std::size_t size = kHeaderSize + 2 * (kChunkHeaderSize + kPadding) + json.size() + (binary ? binary->size() : 0);
  for (const std::string_view chunk : others) size += chunk.size();
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw std::runtime_error(fmt::format("a GLB has less than 4 GiB; it would have {} bytes", size));
  }
  std::string bytes;
  bytes.reserve(size);
  bytes.append("glTF");
  append_uint32(bytes, 2);
  append_uint32(bytes, 0);  // the length, once it is known
  append_chunk(bytes, kJsonChunk, json, ' ');
  if (binary) append_chunk(bytes, kBinaryChunk, *binary, '\0');
  for (const std::string_view chunk : others) bytes.append(chunk);
  std::string length;
  append_uint32(length, bytes.size());
  return bytes.replace(8, 4, length);
}

Container open_container(std::string_view bytes) {
  if (bytes.starts_with("glTF")) return open_glb(bytes);
  return {.json = without_byte_order_mark(bytes), .binary = {}};
}

}  // namespace lkao::scene::gltf
