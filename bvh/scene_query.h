// What a query of a scene asks of its instances.
#pragma once

#include <cstdint>

#include "bvh/query.h"
#include "bvh/scene_layout.h"

namespace lkao::bvh {

inline bool may_block(const SceneLayout& scene, const Query& query, std::uint32_t instance) {
  return (scene.placements[instance].groups & query.groups) != 0;
}

// Makes the query of a plain scene one of its mesh. False where that may block nothing.
inline bool ask_mesh(const SceneLayout& scene, Query& query) {
  if (query.excluded_instance != 0) query.excluded_primitive = kNoPrimitive;
  return may_block(scene, query, 0);
}

// The same query of an instance's mesh, about the rays `open`, which are still in the world.
inline Query query_of_instance(const SceneLayout& scene, const Query& query, std::uint32_t instance,
                               const OcclusionMask& open) {
  const Placement& placement = scene.placements[instance];
  return {.roots = scene.mesh_of(placement).roots(),
          .rays = query.rays,
          .open = open,
          .radius = query.radius,
          .sidedness = query.sidedness,
          .excluded_primitive = instance == query.excluded_instance ? query.excluded_primitive : kNoPrimitive,
          .parts = query.parts,
          .instance = instance,
          .key = query.key,
          .placement = &placement};
}

}  // namespace lkao::bvh
