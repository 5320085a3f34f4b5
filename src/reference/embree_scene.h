// A triangle mesh inside Embree, and the filter that adds what Embree does not know: sides, excluded primitives and
// holes.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/ambient_occlusion.h"
#include "scene/embree.h"
#include "scene/holes.h"

namespace lkao::reference {

class EmbreeScene {
 public:
  // `device_config` as of rtcNewDevice, such as "isa=avx2"; null for Embree's defaults. `holes` of the mesh, or null.
  // Errors as EmbreeReference says.
  EmbreeScene(const TriangleMesh& mesh, bool robust, const char* device_config = nullptr,
              std::shared_ptr<const scene::Holes> holes = nullptr);

  // For the rays of any receiver that excludes no primitive, two-sided, without holes: Embree at its full speed.
  RTCScene plain() const { return plain_.get(); }
  // For FilteredRays. Built at the first call, from any thread.
  RTCScene filtered() const;

  // Number in the mesh of Embree's triangle.
  std::uint32_t primitive(unsigned embree_primitive) const { return primitives_[embree_primitive]; }
  bool has_holes() const { return holes_ != nullptr; }
  // Whether the ray from there, which meets Embree's triangle, is blocked, as the definition of rays has the place.
  bool blocks(unsigned embree_primitive, const glm::vec3& origin, const glm::vec3& ray) const;
  // True where the front of Embree's triangle faces the point, decided in double precision.
  bool faces(unsigned embree_primitive, const glm::vec3& point) const;

 private:
  void add_triangles(const TriangleMesh& mesh);
  scene::embree::Scene build(unsigned flags) const;

  scene::embree::Device device_;
  scene::embree::Geometry geometry_;
  std::shared_ptr<const scene::Holes> holes_;
  std::vector<std::uint32_t> primitives_;
  // Of Embree's triangles, in Embree's own buffers.
  const glm::vec3* positions_ = nullptr;
  const glm::uvec3* triangles_ = nullptr;
  unsigned flags_;
  scene::embree::Scene plain_;
  mutable std::once_flag filtered_once_;
  mutable scene::embree::Scene filtered_;
};

// What casts the rays of one receiver with an excluded primitive, or among one-sided occluders or such with holes.
struct FilteredRays {
  FilteredRays(const EmbreeScene& embree_scene, const glm::vec3& ray_origin, std::uint32_t excluded,
               Sidedness occluder_sidedness);

  scene::embree::RayQuery query;  // first: Embree hands its address to the filter
  const EmbreeScene* scene;
  glm::vec3 origin;
  std::uint32_t excluded_primitive;
  Sidedness sidedness;
};

}  // namespace lkao::reference
