#include "bvh/packed_mesh.h"

#include "lut/mesh_views.h"

namespace lkao::bvh {
namespace {

template <typename View, typename Value>
void copy(const View& from, std::vector<Value>& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i];
}

}  // namespace

glm::vec3 PackedMesh::host_corner(std::uint32_t primitive, int which) const {
  return host->positions[static_cast<std::size_t>(host->triangles.index(primitive, which))];
}

PackedMesh pack(const TriangleMesh& mesh, MeshStorage storage) {
  lut::check_indices(mesh.triangles, mesh.positions.size());
  PackedMesh packed;
  if (storage == MeshStorage::refer) {
    packed.host = mesh;
  } else {
    copy(mesh.positions, packed.positions);
    copy(mesh.triangles, packed.triangles);
  }
  packed.origin = mesh.positions.origin();
  return packed;
}

PackedMesh moved(const PackedMesh& mesh, const PositionView& positions) {
  PackedMesh result;
  if (mesh.host) {
    result.host = TriangleMesh{positions, mesh.host->triangles};
  } else {
    copy(positions, result.positions);
    result.triangles = mesh.triangles;
  }
  result.origin = positions.origin();
  return result;
}

}  // namespace lkao::bvh
