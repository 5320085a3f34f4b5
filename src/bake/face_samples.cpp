#include "bake/face_samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "bake/surface_receiver.h"
#include "lut/random.h"
#include "scene/facet.h"

namespace lkao::bake {
namespace {

using scene::Facet;

std::vector<double> areas_of(const scene::Mesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) areas.push_back(Facet(mesh, triangle).area());
  return areas;
}

int row_count(double area, double mean_area, const SampleDensity& density) {
  const double rows = std::round(std::sqrt(density.per_triangle * area / mean_area));
  return static_cast<int>(
      std::clamp(rows, static_cast<double>(density.least_rows), static_cast<double>(density.most_rows)));
}

// Evenly over the triangle that the unit square folds to.
glm::dvec3 weights_at(double u, double v) {
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return {1 - u - v, u, v};
}

// Calls `take(weights)` in each of rows x rows equal parts.
template <class Take>
void for_each_part(int rows, lut::RandomStream* random, const Take& take) {
  const auto in_part = [&] {
    return random != nullptr ? weights_at(random->next_double(), random->next_double()) : glm::dvec3(1.0 / 3);
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; i + j < rows; ++j) {
      const glm::dvec3 up = in_part();
      take(glm::dvec3(rows - 1 - i - j + up.x, i + up.y, j + up.z) / static_cast<double>(rows));
      if (i + j + 1 == rows) continue;
      const glm::dvec3 down = in_part();  // upside down between its neighbours
      take(glm::dvec3(rows - 1 - i - j - down.x, i + 1 - down.y, j + 1 - down.z) / static_cast<double>(rows));
    }
  }
}

}  // namespace

FaceSamples sample_faces(const scene::CornerNormals& normals, const SampleDensity& density) {
  const scene::Mesh& mesh = normals.mesh();
  const std::vector<double> areas = areas_of(mesh);
  double sum = 0;
  for (const double area : areas) sum += area;
  const double mean_area = sum / static_cast<double>(std::max<std::size_t>(areas.size(), 1));

  lut::RandomStream random(density.seed);
  FaceSamples samples;
  samples.firsts.reserve(mesh.triangles.size() + 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    samples.firsts.push_back(static_cast<std::uint32_t>(samples.receivers.size()));
    const Facet facet(mesh, mesh.triangles[t]);
    const scene::TriangleNormals of_triangle = normals.of(t);
    const glm::vec3 geometric_normal(of_triangle.facet);
    const std::array<glm::vec3, 3>& corners = of_triangle.corners;
    const auto mix = [](const glm::dvec3& w, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
      return w.x * glm::dvec3(a) + w.y * glm::dvec3(b) + w.z * glm::dvec3(c);
    };
    const int rows = row_count(areas[t], mean_area, density);
    for_each_part(rows, density.seed != 0 ? &random : nullptr, [&](const glm::dvec3& weights) {
      samples.weights.push_back(weights);
      samples.receivers.push_back({.position = glm::vec3(mix(weights, facet.a, facet.b, facet.c)),
                                   .normal = glm::vec3(mix(weights, corners[0], corners[1], corners[2])),
                                   .geometric_normal = geometric_normal,
                                   .excluded_instance = object_of(mesh, t)});
    });
    if (samples.receivers.size() > std::numeric_limits<std::uint32_t>::max()) {
      throw std::length_error("sample_faces: more than 2^32 - 1 samples");
    }
  }
  samples.firsts.push_back(static_cast<std::uint32_t>(samples.receivers.size()));
  return samples;
}

std::vector<float> average_on_faces(const FaceSamples& samples, std::span<const float> occlusion) {
  std::vector<float> values;
  values.reserve(samples.firsts.size() - 1);
  for (std::size_t t = 0; t + 1 < samples.firsts.size(); ++t) {
    double sum = 0;
    int count = 0;
    for (std::uint32_t i = samples.firsts[t]; i < samples.firsts[t + 1]; ++i) {
      if (std::isnan(occlusion[i])) continue;
      sum += static_cast<double>(occlusion[i]);
      ++count;
    }
    values.push_back(count > 0 ? static_cast<float>(sum / count) : std::numeric_limits<float>::quiet_NaN());
  }
  return values;
}

}  // namespace lkao::bake
