#include "scene/formats/gltf/meshopt.h"

#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

struct Packing {
  std::string mode;
  std::string filter;
  std::size_t count;
  std::size_t stride;
};

[[noreturn]] void refuse(const Value& extension, const std::string& fault) {
  throw std::runtime_error(fmt::format("{}: {}", extension.place(), fault));
}

// What the decoders take for granted. Sizes are bounded by what the bytes can hold at best: a byte for a triangle or an
// index, two bits for sixteen equal bytes of vertices.
void check(const Packing& packing, const Value& extension, std::size_t compressed_size) {
  const auto [mode, filter, count, stride] = packing;
  const bool is_vertices = mode == "ATTRIBUTES";
  if (!is_vertices && mode != "TRIANGLES" && mode != "INDICES") {
    refuse(extension, fmt::format("unknown mode {}", in_quotes(mode)));
  }
  if (is_vertices ? stride == 0 || stride > 256 || stride % 4 != 0 : stride != 2 && stride != 4) {
    refuse(extension, fmt::format("{} of {} bytes each", mode, stride));
  }
  const std::size_t most = is_vertices         ? 64 * compressed_size / stride
                           : mode == "INDICES" ? compressed_size
                                               : 3 * compressed_size;
  if (count > most || (mode == "TRIANGLES" && count % 3 != 0)) {
    refuse(extension, fmt::format("{} {} do not fit into {} bytes", count, mode, compressed_size));
  }
  const bool fits = filter == "NONE" || (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                    (filter == "QUATERNION" && stride == 8) || filter == "EXPONENTIAL";
  if (!fits || (filter != "NONE" && !is_vertices)) {
    refuse(extension, fmt::format("unknown filter {} for {} of {} bytes each", in_quotes(filter), mode, stride));
  }
}

int unpack(const Packing& packing, std::string_view compressed, std::string& bytes) {
  const auto* const from = reinterpret_cast<const unsigned char*>(compressed.data());
  const auto [mode, filter, count, stride] = packing;
  if (mode == "TRIANGLES") return meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, compressed.size());
  if (mode == "INDICES") return meshopt_decodeIndexSequence(bytes.data(), count, stride, from, compressed.size());
  return meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, compressed.size());
}

void undo_filter(const Packing& packing, std::string& bytes) {
  if (packing.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), packing.count, packing.stride);
  if (packing.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), packing.count, packing.stride);
  if (packing.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), packing.count, packing.stride);
}

}  // namespace

std::string decode_meshopt(const Value& extension, std::string_view compressed) {
  const std::optional<Value> filter = extension.find("filter");
  const Packing packing{extension.at("mode").text(), filter ? filter->text() : "NONE", extension.at("count").count(),
                        extension.at("byteStride").count()};
  check(packing, extension, compressed.size());
  std::string bytes(packing.count * packing.stride, '\0');
  if (bytes.empty()) return bytes;
  if (unpack(packing, compressed, bytes) != 0) {
    // The low bits of the first byte are the version; this library knows vertices of version 0, indices up to 1.
    refuse(extension, "the compressed bytes are damaged, or of a version that is not known");
  }
  undo_filter(packing, bytes);
  return bytes;
}

}  // namespace lkao::scene::gltf
