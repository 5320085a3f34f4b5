// Occluders as a renderer has them: meshes, and instances of them anywhere in the world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/mesh_instance.h"
#include "lkao/occluder_bvh.h"
#include "lkao/progress.h"
#include "lkao/receiver.h"
#include "lkao/requirements.h"

namespace lkao {

namespace bvh {
struct SceneLayout;
}

// Where a mesh of a scene stands.
struct OccluderInstance {
  std::uint32_t mesh = 0;  // of the scene's meshes
  // To the world: affine, as of MeshInstance. It must be finite and invertible.
  glm::mat4x3 to_world{1};
  // The instance blocks rays of receivers that share a group with it (Receiver::occluder_groups). 0: it receives
  // occlusion, and blocks nothing.
  std::uint32_t groups = kAllGroups;
};

// An instance and its new place.
struct InstanceMove {
  std::uint32_t instance = 0;
  glm::mat4x3 to_world{1};
};

// Meshes, instances of them, and a hierarchy over the instances: two levels. A mesh's own hierarchy is there once,
// however often it stands in the world; an instance takes some 300 bytes. Copies share their storage; changing one that
// others share, queries among them, copies its instances first, so what was given to a query stays as it was.
//
// An instance blocks a ray where the mesh would whose corners are transformed in double precision and rounded once to
// float: then the definition of AmbientOcclusion holds, in the world. So a scene of instances gives the bits of the
// one large mesh that it stands for, a closed mesh stays closed under any transform, and one mesh with the identity is
// that mesh. The surface offset alone may differ, which goes by bounds(): here those of the instances' boxes.
//
// Transforms that stretch one direction some 4,000 times as much as another, and those beyond what floats hold, are
// answered by the scalar kernel, slowly.
//
// The const members may be called from any number of threads, the others as those of a std::vector.
class LKAO_API OccluderScene {
 public:
  // One mesh, where it is.
  OccluderScene(OccluderBvh mesh);  // NOLINT(google-explicit-constructor): a mesh is a scene

  // Builds the hierarchy over the instances in parallel, in the TBB arena of the caller: some 0.9 microseconds for each
  // on two cores. Meshes should be built with BuildOptions::keep_zero_area where they have triangles without area.
  // Throws std::invalid_argument, naming the instance, where a transform is not finite, not invertible or leads beyond
  // 1e18, or there is no such mesh; where the meshes have different origins; and where there are more than 2^31 - 1
  // instances. A scene without instances is valid and blocks nothing.
  OccluderScene(std::vector<OccluderBvh> meshes, std::span<const OccluderInstance> instances);

  // The same from a renderer's arrays, as an OpenGL pass takes them: builds one hierarchy for each pair of positions
  // and indices that is not yet there. Throws as OccluderBvh does too.
  explicit OccluderScene(std::span<const MeshInstance> instances, const BuildOptions& options = {},
                         const Progress& progress = {});

  std::size_t mesh_count() const;
  std::size_t instance_count() const;
  // Throw std::out_of_range where there is none of that number.
  const OccluderBvh& mesh(std::uint32_t mesh) const;
  OccluderInstance instance(std::uint32_t instance) const;

  // A box around all instances, some roundings larger than they are; of a scene that is one mesh where it is, the
  // mesh's own. Lower = +infinity, upper = -infinity where there is no occluder.
  const Bounds& bounds() const;
  // Of the meshes' positions (PositionView): transforms take positions less it to a world less it.
  const glm::dvec3& origin() const;
  // Of all instances together: as many as a flattened mesh would have.
  std::uint64_t occluder_count() const;
  // Of the meshes' hierarchies, with their copies of the meshes, the instances and the hierarchy over them.
  std::size_t memory_bytes() const;

  // Instances move: their boxes are found anew, and those of the nodes above; where the boxes of all nodes together
  // have grown to 1.5 times what they were, the hierarchy over the instances is built anew. So the order of moves may
  // change the time of queries, never their answers. Costs a pass over all instances' boxes, however few move: call it
  // once for all that move in a frame. Throws std::invalid_argument as the constructor does, and leaves the scene as it
  // was.
  void move(std::span<const InstanceMove> moves);
  // What an instance blocks from now on. Throws std::out_of_range where there is no such instance.
  void set_groups(std::uint32_t instance, std::uint32_t groups);
  // Another hierarchy in the place of a mesh, as one that was refitted to new positions. Throws std::out_of_range where
  // there is no such mesh, std::invalid_argument as the constructor does, and leaves the scene as it was.
  void set_mesh(std::uint32_t mesh, OccluderBvh occluders);

  // For the kernels of this library.
  const bvh::SceneLayout& layout() const { return *layout_; }

 private:
  bvh::SceneLayout& own_layout();

  std::shared_ptr<bvh::SceneLayout> layout_;
};

}  // namespace lkao
