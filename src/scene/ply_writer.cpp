#include "scene/ply_writer.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "scene/output_buffer.h"

namespace lkao::scene {

namespace {

static_assert(std::endian::native == std::endian::little, "records are written as they lie in memory");

// Lines of the header, one for each property of a vertex or a face.
std::string lines_of(const OcclusionProperties& properties) {
  std::string lines = "property float occlusion\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (properties.quality) lines += "property float quality\n";
  return lines;
}

void write_header(std::ostream& out, const Mesh& mesh, const std::string& more_of_a_vertex,
                  const std::string& more_of_a_face) {
  out << "ply\nformat binary_little_endian 1.0\n";
  const glm::dvec3& o = mesh.origin;
  if (o != glm::dvec3(0.0)) out << fmt::format("comment origin {:.17g} {:.17g} {:.17g}\n", o.x, o.y, o.z);
  out << fmt::format(
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
      "element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
      mesh.positions.size(), more_of_a_vertex, mesh.triangles.size(), more_of_a_face);
}

void put_position(OutputBuffer& buffer, const glm::vec3& position) {
  for (int axis = 0; axis < 3; ++axis) buffer.put(position[axis]);
}

void put_face(OutputBuffer& buffer, const glm::uvec3& triangle) {
  buffer.put(std::uint8_t{3});
  for (int corner = 0; corner < 3; ++corner) buffer.put(triangle[corner]);
}

void put_occlusion(OutputBuffer& buffer, float occlusion, const OcclusionProperties& properties) {
  buffer.put(occlusion);
  const auto grey = static_cast<std::uint8_t>(std::lround(255 * grey_of(occlusion, properties.coding)));
  for (int channel = 0; channel < 3; ++channel) buffer.put(grey);
  if (properties.quality) buffer.put(1.0f - occlusion);
}

void check_size(std::span<const float> occlusion, std::size_t count, const char* what) {
  if (occlusion.size() == count) return;
  throw std::invalid_argument(
      fmt::format("write_ply: occlusion has {} entries, the mesh has {} {}", occlusion.size(), count, what));
}

}  // namespace

void write_ply(std::ostream& out, const Mesh& mesh) {
  write_header(out, mesh, "", "");
  OutputBuffer buffer(out);
  for (const glm::vec3& position : mesh.positions) put_position(buffer, position);
  for (const glm::uvec3& triangle : mesh.triangles) put_face(buffer, triangle);
}

void write_ply(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion,
               const OcclusionProperties& properties) {
  check_size(occlusion, mesh.positions.size(), "vertices");
  write_header(out, mesh, lines_of(properties), "");
  OutputBuffer buffer(out);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    put_position(buffer, mesh.positions[i]);
    put_occlusion(buffer, occlusion[i], properties);
  }
  for (const glm::uvec3& triangle : mesh.triangles) put_face(buffer, triangle);
}

void write_ply_of_faces(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion,
                        const OcclusionProperties& properties) {
  check_size(occlusion, mesh.triangles.size(), "triangles");
  write_header(out, mesh, "", lines_of(properties));
  OutputBuffer buffer(out);
  for (const glm::vec3& position : mesh.positions) put_position(buffer, position);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    put_face(buffer, mesh.triangles[t]);
    put_occlusion(buffer, occlusion[t], properties);
  }
}

}  // namespace lkao::scene
