#include "scene/ply_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace lkao::scene {

namespace {

static_assert(std::endian::native == std::endian::little, "records are written as they lie in memory");

// Bytes of one record after another; one write for many records.
class RecordBuffer {
 public:
  explicit RecordBuffer(std::ostream& out) : out_(out) {}
  ~RecordBuffer() { flush(); }

  template <typename T>
  void put(const T& value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    bytes_.append(bytes, sizeof(T));
    if (bytes_.size() >= kFlushSize) flush();
  }

 private:
  static constexpr std::size_t kFlushSize = 1 << 16;

  void flush() {
    out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    bytes_.clear();
  }

  std::ostream& out_;
  std::string bytes_;
};

// 8-bit sRGB grey of a visibility in [0, 1]; black where there is none (NaN).
std::uint8_t grey_of(float visibility) {
  if (!(visibility > 0)) return 0;
  const double linear = std::min(static_cast<double>(visibility), 1.0);
  const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

void write_header(std::ostream& out, const Mesh& mesh, const char* more_of_a_vertex) {
  out << fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), more_of_a_vertex, mesh.triangles.size());
}

void put_position(RecordBuffer& buffer, const glm::vec3& position) {
  for (int axis = 0; axis < 3; ++axis) buffer.put(position[axis]);
}

void put_faces(RecordBuffer& buffer, const Mesh& mesh) {
  for (const glm::uvec3& triangle : mesh.triangles) {
    buffer.put(std::uint8_t{3});
    for (int corner = 0; corner < 3; ++corner) buffer.put(triangle[corner]);
  }
}

}  // namespace

void write_ply(std::ostream& out, const Mesh& mesh) {
  write_header(out, mesh, "");
  RecordBuffer buffer(out);
  for (const glm::vec3& position : mesh.positions) put_position(buffer, position);
  put_faces(buffer, mesh);
}

void write_ply(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion) {
  if (occlusion.size() != mesh.positions.size()) {
    throw std::invalid_argument(fmt::format("write_ply: occlusion has {} entries, the mesh has {} vertices",
                                            occlusion.size(), mesh.positions.size()));
  }
  write_header(out, mesh, "property float occlusion\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n");
  RecordBuffer buffer(out);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    put_position(buffer, mesh.positions[i]);
    buffer.put(occlusion[i]);
    const std::uint8_t grey = grey_of(1.0f - occlusion[i]);
    for (int channel = 0; channel < 3; ++channel) buffer.put(grey);
  }
  put_faces(buffer, mesh);
}

}  // namespace lkao::scene
