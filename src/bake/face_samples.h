// Receivers spread evenly over triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/receiver.h"
#include "scene/corner_normals.h"

namespace lkao::bake {

// Triangle t has samples [firsts[t], firsts[t + 1]), each for the same area.
struct FaceSamples {
  std::vector<std::uint32_t> firsts;
  std::vector<glm::dvec3> weights;  // of the triangle's corners at a sample; they add up to 1
  std::vector<Receiver> receivers;
};

// How many.
struct SampleDensity {
  double per_triangle = 4;  // on average, by area
  int least_rows = 2;       // a triangle is cut into rows x rows equal parts, a sample in each
  int most_rows = 16;
  // Samples lie at random in their parts, by this seed; 0: in their middles.
  std::uint64_t seed = 0;
};

// Triangles must be usable. At least 4 a triangle: 3 values of corners take no fewer, and the mean over 4 equal parts
// is right wherever occlusion changes evenly. Throws std::length_error for more than 2^32 - 1 in all.
FaceSamples sample_faces(const scene::CornerNormals& normals, const SampleDensity& density = {});

// The mean of each triangle's samples; NaN among them counts for nothing, and of nothing else the mean is NaN.
std::vector<float> average_on_faces(const FaceSamples& samples, std::span<const float> occlusion);

}  // namespace lkao::bake
