#include "scene/formats/file_mesh.h"

#include "scene/formats/polygons.h"

namespace lkao::scene {

namespace {

void add_fan(std::vector<glm::uvec3>& triangles, std::span<const std::uint32_t> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
}

// The corners that a fan was made from.
void corners_of(const FileMesh::Fan& fan, const std::vector<glm::uvec3>& triangles,
                std::vector<std::uint32_t>& corners) {
  const glm::uvec3* const triangle = triangles.data() + fan.first_triangle;
  corners.assign({triangle->x, triangle->y});
  for (std::size_t i = 2; i < fan.corner_count; ++i) corners.push_back(triangle[i - 2].z);
}

void replace(const FileMesh::Fan& fan, std::vector<glm::uvec3>& triangles, std::span<const glm::uvec3> cut,
             const std::vector<std::uint32_t>& corners) {
  for (std::size_t i = 0; i < cut.size(); ++i) {
    triangles[fan.first_triangle + i] = {corners[cut[i].x], corners[cut[i].y], corners[cut[i].z]};
  }
}

}  // namespace

void FileMesh::add_polygon(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> corner_normals,
                           std::span<const std::uint32_t> corner_uvs) {
  if (corners.size() > 3) fans.push_back({triangles.size(), corners.size()});
  add_fan(triangles, corners);
  add_fan(normal_corners, corner_normals);
  add_fan(uv_corners, corner_uvs);
}

void cut_polygons(FileMesh& mesh) {
  PolygonCutter cutter;
  std::vector<std::uint32_t> corners, others;
  std::vector<glm::dvec3> positions;
  for (const FileMesh::Fan& fan : mesh.fans) {
    corners_of(fan, mesh.triangles, corners);
    positions.clear();
    for (const std::uint32_t corner : corners) positions.push_back(mesh.positions[corner]);
    const std::span<const glm::uvec3> cut = cutter.cut(positions);
    replace(fan, mesh.triangles, cut, corners);
    for (std::vector<glm::uvec3>* const of_corners : {&mesh.normal_corners, &mesh.uv_corners}) {
      if (of_corners->empty()) continue;
      corners_of(fan, *of_corners, others);
      replace(fan, *of_corners, cut, others);
    }
  }
  mesh.fans.clear();
}

}  // namespace lkao::scene
