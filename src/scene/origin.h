// Positions far from zero: what is taken away from them so that floats hold them.
#pragma once

#include <span>

#include <glm/vec3.hpp>

namespace lkao::scene {

// Zero, unless the box around the finite positions lies farther from zero than 16 times its diagonal: then its centre,
// rounded to a power of ten that is not below the diagonal. A float less such an origin loses no more than three bits
// to a scene that stands at zero.
glm::dvec3 choose_origin(std::span<const glm::dvec3> positions);

}  // namespace lkao::scene
