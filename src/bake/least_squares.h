// Values of places that come nearest to samples all over the triangles.
//
// Based on: L. Kavan, A. W. Bargteil, P.-P. Sloan, "Least Squares Vertex Baking", EGSR 2011.
#pragma once

#include <span>
#include <vector>

#include "bake/face_samples.h"
#include "bake/places.h"

namespace lkao::bake {

struct LeastSquaresOptions {
  // Of the term that keeps slopes from changing over smooth edges; 0: none. The default costs some 2 % of the error
  // that is left at 0; ten times as much would cost more than the fit gains.
  double smoothness = 0.01;
};

// Minimises the integral over the surface of (interpolated values - occlusion)^2, and the smoothness. Values are in
// [0, 1]; NaN where a place has no sample. `occlusion` is one a sample; NaN among them counts for nothing.
std::vector<float> least_squares_values(const scene::Mesh& mesh, const Places& places, const FaceSamples& samples,
                                        std::span<const float> occlusion, const LeastSquaresOptions& options = {});

}  // namespace lkao::bake
