#include "bake/least_squares.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "bake/meshes.h"
#include "scene/shapes.h"

namespace lkao::bake {
namespace {

// A flat square of 6 x 6 vertices.
Mesh flat_grid() {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) points.emplace_back(j, 0, i);
  }
  Mesh mesh;
  scene::add_grid(mesh, points, 6);
  return joined(mesh);
}

struct Fit {
  Mesh mesh;
  std::vector<float> values;  // of vertices
};

// To values of a function of position.
template <class Function>
Fit fit(Mesh mesh, const Function& function, double smoothness) {
  const CornerNormals normals(mesh, NormalSource::facet);
  const Places places = make_places(normals, Per::vertex);
  const FaceSamples samples = sample_faces(normals);
  std::vector<float> occlusion;
  for (const Receiver& receiver : samples.receivers)
    occlusion.push_back(static_cast<float>(function(receiver.position)));
  const std::vector<float> values = least_squares_values(mesh, places, samples, occlusion, {.smoothness = smoothness});
  Fit result{mesh, {}};
  result.values = split_vertices(result.mesh, places, values);
  return result;
}

TEST(LeastSquares, MeetsALinearSignalExactly) {
  const auto signal = [](const glm::vec3& p) { return 0.1f + 0.05f * p.x + 0.1f * p.z; };
  for (const double smoothness : {0.0, 0.1, 10.0}) {
    const Fit found = fit(flat_grid(), signal, smoothness);
    ASSERT_EQ(found.values.size(), 36u);
    for (std::size_t i = 0; i < 36; ++i) EXPECT_NEAR(found.values[i], signal(found.mesh.positions[i]), 1e-4) << i;
  }
}

TEST(LeastSquares, KeepsConstantsToTheBit) {
  for (const float value : {0.0f, 1.0f}) {
    const Fit found = fit(
        split_room(), [value](const glm::vec3&) { return value; }, 0.1);
    for (const float vertex : found.values) EXPECT_EQ(vertex, value);
  }
}

// The normal equations, seen from outside: no vertex can move and bring the values nearer to the samples.
TEST(LeastSquares, IsTheBestFit) {
  const auto signal = [](const glm::vec3& p) { return 0.5f + 0.3f * std::sin(2 * p.x) * std::cos(p.z); };
  const Fit found = fit(flat_grid(), signal, 0);
  const CornerNormals normals(found.mesh, NormalSource::facet);
  const FaceSamples samples = sample_faces(normals);
  const auto error_of = [&](const std::vector<float>& values) {
    double sum = 0;
    for (std::size_t t = 0; t < found.mesh.triangles.size(); ++t) {
      const glm::uvec3& corners = found.mesh.triangles[t];
      for (std::uint32_t i = samples.firsts[t]; i < samples.firsts[t + 1]; ++i) {
        double value = 0;
        for (int k = 0; k < 3; ++k) value += samples.weights[i][k] * static_cast<double>(values[corners[k]]);
        sum += std::pow(value - static_cast<double>(signal(samples.receivers[i].position)), 2);
      }
    }
    return sum;
  };
  const double least = error_of(found.values);
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    for (const float step : {-0.01f, 0.01f}) {
      std::vector<float> moved = found.values;
      moved[i] += step;
      EXPECT_GT(error_of(moved), least) << i;
    }
  }
}

TEST(LeastSquares, SmoothnessBendsLess) {
  const auto noise = [](const glm::vec3& p) { return 0.5f + 0.4f * std::sin(37 * p.x + 11 * p.z); };
  const auto bend_of = [](const Fit& found) {
    double sum = 0;
    for (std::size_t i = 7; i < 29; ++i) {
      if (i % 6 == 0 || i % 6 == 5) continue;
      sum += std::abs(found.values[i - 1] - 2 * found.values[i] + found.values[i + 1]);
    }
    return sum;
  };
  const double rough = bend_of(fit(flat_grid(), noise, 0)), smooth = bend_of(fit(flat_grid(), noise, 0.1));
  EXPECT_LT(smooth, 0.7 * rough);
  EXPECT_LT(bend_of(fit(flat_grid(), noise, 100)), 0.1 * rough);
}

TEST(LeastSquares, PlacesWithoutSamplesHaveNoValue) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (const float value : fit(
                               mesh, [none](const glm::vec3&) { return none; }, 0.1)
                               .values)
    EXPECT_TRUE(std::isnan(value));
}

}  // namespace
}  // namespace lkao::bake
