// What rays meet first on a mesh, through its holes.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include <glm/vec3.hpp>

#include "scene/embree.h"
#include "scene/mesh.h"

namespace lkao::scene {

struct SurfaceHit {
  std::uint32_t triangle;
  glm::dvec3 weights;  // of its corners; at least 0, and they add up to 1
};

class FirstHits {
 public:
  // Builds in parallel; the mesh may go afterwards. Throws std::runtime_error with one line where Embree fails.
  explicit FirstHits(const Mesh& mesh);

  // Between `near` and `far`, in lengths of the direction; none where nothing is met. From any thread. Triangles
  // without a plane are not there.
  std::optional<SurfaceHit> cast(const glm::dvec3& origin, const glm::dvec3& direction, double near = 0,
                                 double far = std::numeric_limits<double>::infinity()) const;

 private:
  embree::Device device_;
  embree::Scene scene_;
  std::shared_ptr<const Holes> holes_;
};

}  // namespace lkao::scene
