// A city of instances: a few meshes of some ten thousand triangles each, in as many places as one likes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lkao/occluder_scene.h"
#include "scene/camera.h"
#include "scene/mesh.h"

namespace lkao::bench {

struct InstancedCity {
  std::vector<scene::Mesh> meshes;  // 20: towers, trees, balls and the ground
  std::vector<OccluderInstance> instances;
  scene::Camera camera;              // from a roof over many streets
  std::uint64_t triangle_count = 0;  // of all instances together
};

// The same on every machine.
InstancedCity make_city(std::size_t instance_count);

// Every one of the instances moved about, by no more than `distance` along the ground, and turned.
std::vector<InstanceMove> stir(const InstancedCity& city, float distance, std::uint64_t seed);

}  // namespace lkao::bench
