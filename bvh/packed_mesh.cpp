#include "bvh/packed_mesh.h"

#include <cstddef>

#include "lut/mesh_views.h"

namespace lkao::bvh {
namespace {

template <typename View, typename Value>
void copy(const View& from, std::vector<Value>& to) {
  to.resize(from.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i];
}

}  // namespace

PackedMesh pack(const TriangleMesh& mesh) {
  lut::check_indices(mesh.triangles, mesh.positions.size());
  PackedMesh packed;
  copy(mesh.positions, packed.positions);
  copy(mesh.triangles, packed.triangles);
  packed.origin = mesh.positions.origin();
  return packed;
}

}  // namespace lkao::bvh
