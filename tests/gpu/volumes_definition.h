// Ambient occlusion volumes by their definition: triangle by triangle, in double, with the paper's own formulas.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010, Eqs. 4 to 13.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/gl.h"
#include "support/meshes.h"

namespace lkao::gl::tests {

using lkao::tests::Mesh;

struct VolumeReceiver {
  glm::dvec3 origin{0}, normal{0, 0, 1}, up{0, 0, 1};  // unit normals: shading, geometric
};

struct VolumeDefinition {
  double delta = 1;
  bool is_two_sided = true;
  bool clamps_extensions = true;
  std::span<const float> opacities = {};  // none: 1

  // Before it is saturated.
  double occlusion(const Mesh& mesh, const VolumeReceiver& receiver) const;
};

// Eq. 4 for the receiver at its place, and the corners of a polygon that faces it; the part above both horizons.
double form_factor(const std::vector<glm::dvec3>& corners, const VolumeReceiver& receiver);

// Where the query has its rays start, for all pixels of a G-buffer; no normal where there is no receiver.
std::vector<VolumeReceiver> volume_receivers(const Mesh& mesh, const std::vector<Receiver>& receivers,
                                             const RayOptions& options);

}  // namespace lkao::gl::tests
