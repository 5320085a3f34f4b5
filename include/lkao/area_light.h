// Lights that have a size.
#pragma once

#include <variant>

#include <glm/vec3.hpp>

#include "lkao/requirements.h"

namespace lkao {

// A flat disc, seen from both sides. What counts of it is area: each part of the disc as much as any other of the same
// area, from wherever it is seen.
struct DiscLight {
  glm::vec3 position{0};  // of the centre, in world space
  glm::vec3 normal{0};    // of any length but 0
  float radius = 0;       // in the unit of the positions
};

// A sphere. What counts of it is solid angle, as the receiver sees it: of the cap that faces it, or, from within, of
// the whole inside.
struct SphereLight {
  glm::vec3 position{0};
  float radius = 0;
};

using AreaLight = std::variant<DiscLight, SphereLight>;

}  // namespace lkao
