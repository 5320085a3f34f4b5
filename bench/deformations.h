// Motions of meshes, from slight to violent: positions change, triangles do not.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "method/words.h"

namespace lkao::bench {

enum class Deformation { twist, bend, shake };

inline constexpr method::Word<Deformation> kDeformationWords[] = {
    {"twist", Deformation::twist}, {"bend", Deformation::bend}, {"shake", Deformation::shake}};

// How strong the study makes each.
std::span<const float> deformation_strengths(Deformation deformation);

// About the middle of the finite positions' bounds, along their longest side.
//
// twist: its ends are turned against each other by so many whole turns.
// bend: it becomes an arc, by so many whole turns.
// shake: each position is moved at random, by up to so many of the bounds' diagonals along each axis.
std::vector<glm::vec3> deform(std::span<const glm::vec3> positions, Deformation deformation, float strength);

}  // namespace lkao::bench
