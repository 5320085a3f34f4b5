// --light: an area light in the file's coordinates.
#pragma once

#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "cli/report.h"
#include "lkao/area_light.h"

namespace lkao::cli {

struct LightOption {
  glm::dvec3 position{0};
  float radius = 0;
  std::optional<glm::vec3> normal;  // of a disc; none: a sphere
};

// "x,y,z,radius" or "x,y,z,radius,nx,ny,nz". Throws std::invalid_argument saying what it expected and what it got.
LightOption parse_light(const std::string& text);

// In the coordinates of a mesh with this origin.
AreaLight area_light(const LightOption& option, const glm::dvec3& origin);

// In the file's coordinates.
Json light_json(const LightOption& option);

}  // namespace lkao::cli
