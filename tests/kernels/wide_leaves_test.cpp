// Large triangles that nearly all rays might meet and few do: one ray at an edge, or one that just reaches the plane.
// Whatever leaves out triangles or groups of rays for all rays at once must keep that one.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "aimed_patterns.h"
#include "needles.h"
#include "ray_counts.h"
#include "same_bits.h"

namespace lkao::tests {
namespace {

class WideLeaves : public testing::TestWithParam<int> {
 protected:
  // Patterns over all of the hemisphere and narrow ones, with rays of one length and of several.
  std::vector<SamplePattern> patterns() const {
    const SamplePattern& standard = SamplePattern::standard(GetParam());
    return {standard, standard.with_falloff(Falloff::linear()), beam(GetParam(), 0.4f), beam(GetParam(), 0.02f)};
  }
  Receiver receiver() {
    const bool along_axis = random_.next_below(2) == 0;
    return {.position = random_.next_below(2) == 0 ? glm::vec3(0) : random_point(random_, 1),
            .normal = along_axis ? random_axis(random_) : random_direction(random_)};
  }
  std::size_t any_ray() { return random_.next_below(static_cast<std::uint64_t>(GetParam())); }
  void add_triangle(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {glm::vec3(a), glm::vec3(b), glm::vec3(c)});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  // In the plane at `height` along the unit vector `normal` from the origin, around the point over `ray`; on average
  // `size` large.
  void add_in_plane(Mesh& mesh, const glm::dvec3& origin, const glm::dvec3& normal, double height,
                    const glm::dvec3& ray, double size) {
    const glm::dvec3 foot = height * normal, end = ray + (height - glm::dot(ray, normal)) * normal;
    const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(random_direction(random_))));
    const glm::dvec3 v = glm::cross(normal, u), middle = glm::mix(foot, end, random_.next_double());
    const double turn = 2 * random_.next_double();
    const auto corner = [&](double angle) {
      return origin + middle + size * (std::cos(turn + angle) * u + std::sin(turn + angle) * v);
    };
    add_triangle(mesh, corner(0), corner(2.1), corner(4.2));
  }

  lut::RandomStream random_{61};
};

INSTANTIATE_TEST_SUITE_P(Rays, WideLeaves, ray_counts({64, 192, 256, 1024}), testing::PrintToStringParamName());

// The edge passes two rays, from near to far; the triangle lies to one side of it.
TEST_P(WideLeaves, KeepRaysAtEdges) {
  std::uint64_t blocked_count = 0;
  for (const SamplePattern& pattern : patterns()) {
    for (int repetition = 0; repetition < 60; ++repetition) {
      const Receiver asked = receiver();
      const RayOptions options{.radius = 1.5f, .surface_offset = 0};
      const ReceiverRays rays = AmbientOcclusion(OccluderBvh(TriangleMesh{}), pattern, options).rays(asked, 0);
      Mesh mesh;
      for (int i = 0; i < 1 + repetition % 4; ++i) {
        const glm::dvec3 origin(rays.origin), one(rays.ray(static_cast<int>(any_ray()))),
            other(rays.ray(static_cast<int>(any_ray())));
        const glm::dvec3 a = origin + (0.02 + 0.9 * random_.next_double()) * one;
        const glm::dvec3 b = origin + (0.02 + 0.9 * random_.next_double()) * other;
        const glm::dvec3 along = glm::normalize(b - a + 1e-9 * one);
        // Nearly all of the rays on that side, or next to none.
        const double size = repetition % 3 == 0 ? 0.1 : 3;
        add_triangle(mesh, a - 0.5 * along, b + 0.5 * along,
                     0.5 * (a + b) + size * glm::dvec3(random_direction(random_)));
      }
      blocked_count += expect_same_bits(mesh, pattern, options, {asked});
    }
  }
  EXPECT_GT(blocked_count, 1000u);
}

// A plane in any direction, as far away as the farthest of all rays goes towards it, or a little nearer: seen from
// below the horizon too, where the lowest rays are the first to reach it.
TEST_P(WideLeaves, KeepRaysThatJustReachAPlane) {
  std::uint64_t blocked_count = 0;
  for (const SamplePattern& pattern : patterns()) {
    for (int repetition = 0; repetition < 100; ++repetition) {
      constexpr double kShares[] = {1, 1 - 1e-8, 1 - 1e-7, 1 - 1e-6, 1 - 1e-4};
      constexpr float kCut = 0.625f;  // a level's end, as a share of the radius
      const bool is_cut = repetition % 4 == 3;
      const Receiver asked = receiver();
      const RayOptions options{.radius = 1.5f, .surface_offset = 0};
      const ReceiverRays rays = AmbientOcclusion(OccluderBvh(TriangleMesh{}), pattern, options).rays(asked, 0);
      const auto counted = [&](int i) {
        const glm::dvec3 ray(rays.ray(i));
        const double length = glm::length(ray), end = kCut * options.radius;
        return is_cut && length > end ? end / length * ray : ray;
      };
      glm::dvec3 normal(random_direction(random_));
      // Along a ray, or anywhere.
      if (repetition % 3 == 0) normal = glm::normalize(glm::dvec3(rays.ray(static_cast<int>(any_ray()))));
      int farthest = 0;
      for (int i = 1; i < rays.ray_count; ++i) {
        if (glm::dot(counted(i), normal) > glm::dot(counted(farthest), normal)) farthest = i;
      }
      const double height = kShares[repetition % 5] * glm::dot(counted(farthest), normal);
      if (height < 1e-3) continue;
      Mesh mesh;
      for (int i = 0; i < 1 + repetition % 2; ++i) {
        add_in_plane(mesh, rays.origin, normal, height, counted(farthest), repetition % 7 == 0 ? 0.2 : 4);
      }
      if (is_cut) {
        const OccluderBvh occluders(mesh.view());
        blocked_count += expect_scalar_bits({{{occluders, 0, kCut * options.radius}}, pattern, options, {asked}});
      } else {
        blocked_count += expect_same_bits(mesh, pattern, options, {asked});
      }
    }
  }
  EXPECT_GT(blocked_count, 100u);
}

}  // namespace
}  // namespace lkao::tests
