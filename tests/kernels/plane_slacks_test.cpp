// Rays that end, begin or pass within the rounding of a triangle's planes: there single precision must leave the
// decision to the definition, from whichever side the rounding errors come.
//
// Patterns are made for one triangle: all of their rays end in its plane, pass its edge or begin in its plane, as
// nearly as floats can say. Each question is asked with all rays, which meet the triangle together, and with few of
// them, which kernels may take one by one.
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "aimed_patterns.h"
#include "needles.h"
#include "same_bits.h"

namespace lkao::tests {
namespace {

constexpr int kRayCount = 256;
constexpr double kLowest = 0.15;  // of the sines of elevations: low directions are not held so exactly

struct Place {
  float radius = 1;
  glm::vec3 position{0};
};

double share(lut::RandomStream& random, double low, double high) { return low + (high - low) * random.next_double(); }

// Directions within the plane of a normal other than z, by their angles from the one that points highest.
struct Tangents {
  explicit Tangents(const glm::dvec3& normal)
      : u(glm::normalize(glm::dvec3(0, 0, 1) - normal.z * normal)), v(glm::cross(normal, u)) {}
  glm::dvec3 at(double turn) const { return std::cos(turn) * u + std::sin(turn) * v; }
  glm::dvec3 u, v;
};

// A triangle in the pattern's space, as the receiver sees it.
struct LocalTriangle {
  glm::dvec3 corners[3];
};

class PlaneSlacks : public testing::Test {
 protected:
  // The triangle where it lies in the world, corners rounded to floats.
  Mesh placed(const std::vector<LocalTriangle>& triangles, const AmbientOcclusion& ao, const Receiver& receiver) {
    const ReceiverRays rays = ao.rays(receiver, 0);
    const glm::dmat3 frame(rays.frame);
    Mesh mesh;
    for (const LocalTriangle& triangle : triangles) {
      const auto first = static_cast<unsigned>(mesh.positions.size());
      for (const glm::dvec3& corner : triangle.corners) {
        mesh.positions.emplace_back(glm::dvec3(rays.origin) +
                                    static_cast<double>(ao.options().radius) * (frame * corner));
      }
      mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
  }

  // The rays against the triangles. Counts what was asked and what was blocked.
  void ask(const std::vector<PatternRay>& rays, const std::vector<LocalTriangle>& triangles, const Place& place = {},
           Sidedness sidedness = Sidedness::two_sided) {
    const RayOptions options{
        .radius = place.radius, .sidedness = sidedness, .jitter = {.rotation = 0}, .surface_offset = 0};
    // An axis keeps the rays as the pattern has them.
    const bool along_axis = random_.next_below(2) == 0;
    const Receiver receiver{.position = place.position,
                            .normal = along_axis ? random_axis(random_) : random_direction(random_)};
    for (const auto& some : {rays, thinned(rays)}) {
      const SamplePattern pattern = pattern_of(some);
      const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern, options);
      const Mesh mesh = placed(triangles, nothing, receiver);
      blocked_count_ += expect_same_bits(mesh, pattern, options, {receiver});
    }
    ray_count_ += rays.size() + rays.size() / 21;
  }

  // Floats that are as good as random decide: neither all rays nor none.
  void expect_some_blocked() const {
    EXPECT_GT(blocked_count_, ray_count_ / 10);
    EXPECT_LT(blocked_count_, ray_count_ * 19 / 20);
  }

  // A normal, a plane `height` away, and rays that end in it, up to 1 long, no nearer to its foot than `nearest`.
  std::vector<PatternRay> rays_ending_in_plane(const glm::dvec3& normal, double height, double nearest) {
    const Tangents tangents(normal);
    std::vector<PatternRay> rays;
    while (rays.size() < kRayCount) {
      const double away = std::sqrt(1 - height * height) * std::sqrt(share(random_, nearest, 1));
      const PatternRay ray = height * normal + away * tangents.at(share(random_, 0, 2 * std::numbers::pi));
      if (ray.z > kLowest * glm::length(ray) && glm::length(ray) <= 1) rays.push_back(ray);
    }
    return rays;
  }

  // In the plane, over nearly all that such rays reach. Its first corner lies `nearest` to the foot, on the lower side.
  LocalTriangle triangle_in_plane(const glm::dvec3& normal, double height, double nearest) {
    const Tangents tangents(normal);
    const double turn = share(random_, -0.3, 0.3);
    const auto corner = [&](double distance, double angle) {
      return height * normal + distance * tangents.at(turn + angle);
    };
    return {corner(nearest, std::numbers::pi), corner(20, 1.4), corner(20, -1.4)};
  }

  // Neither so high nor so low that rays near its plane or along it would be low.
  glm::dvec3 random_normal() {
    const double z = share(random_, 0.3, 0.9), turn = share(random_, 0, 2 * std::numbers::pi);
    const double across = std::sqrt(1 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
  }

  lut::RandomStream random_{31};
  std::uint64_t ray_count_ = 0;
  std::uint64_t blocked_count_ = 0;
};

constexpr double kHeights[] = {0.95, 0.5, 0.1, 1e-2, 1e-3, 1e-4};

// The corner that distances are measured from lies near the foot of the plane, and so near to the receiver where the
// plane is low: only the lengths of the rays are then left to be granted rounding.
TEST_F(PlaneSlacks, OfRaysThatEndInAPlane) {
  for (const double height : kHeights) {
    for (int repetition = 0; repetition < 25; ++repetition) {
      const glm::dvec3 normal = random_normal();
      const LocalTriangle triangle = triangle_in_plane(normal, height, 0.3 * height);
      ask(rays_ending_in_plane(normal, height, repetition % 2 == 0 ? 0 : 0.8), {triangle});
    }
  }
  expect_some_blocked();
}

TEST_F(PlaneSlacks, OfRaysThatEndInAPlaneAnywhere) {
  for (const double height : kHeights) {
    for (const float scale : {1e-8f, 1e-2f, 1e5f, 1e10f}) {
      for (const float away : {0.0f, 1.0f, 30.0f, 1e4f}) {
        const glm::dvec3 normal = random_normal();
        const LocalTriangle triangle = triangle_in_plane(normal, height, 1);
        ask(rays_ending_in_plane(normal, height, 0), {triangle}, {scale, random_direction(random_) * away * scale},
            away == 1 ? Sidedness::one_sided : Sidedness::two_sided);
      }
    }
  }
  EXPECT_GT(blocked_count_, ray_count_ / 20);
}

// Triangles small and far away, one around the end of each ray.
TEST_F(PlaneSlacks, OfRaysThatEndInPlanesOfTheirOwn) {
  for (const float size : {3e-2f, 1e-3f, 1e-5f}) {
    for (const float away : {0.0f, 10.0f}) {
      const RayOptions options{.radius = 1, .jitter = {.rotation = 0}, .surface_offset = 0};
      const SamplePattern& pattern = SamplePattern::standard(1024);
      const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern, options);
      const Receiver receiver{.position = random_direction(random_) * away, .normal = random_direction(random_)};
      const ReceiverRays rays = nothing.rays(receiver, 0);
      Mesh mesh;
      for (int i = 0; i < rays.ray_count; ++i) {
        add_needles(mesh, rays.origin + rays.ray(i), size, i % 2 == 0 ? Touch::inside : Touch::edge, random_);
      }
      blocked_count_ += expect_same_bits(mesh, pattern, options, {receiver});
      ray_count_ += 1024;
    }
  }
  EXPECT_GT(blocked_count_, ray_count_ / 4);
}

// Of the distances of a level, one side counts: all rays meet the plane there, at the same distance.
TEST_F(PlaneSlacks, OfPartsThatBeginOrEndInAPlane) {
  for (const double height : {0.5, 0.1, 1e-2, 1e-3}) {
    for (int repetition = 0; repetition < 40; ++repetition) {
      const glm::dvec3 normal = random_normal();
      const Tangents tangents(normal);
      const double distance = share(random_, height, 0.9), away = std::sqrt(distance * distance - height * height);
      std::vector<PatternRay> rays;
      while (rays.size() < kRayCount) {
        const PatternRay hit = height * normal + away * tangents.at(share(random_, 0, 2 * std::numbers::pi));
        if (hit.z > kLowest * distance) rays.push_back(share(random_, 1, 1 / distance) * hit);
      }
      const float limit = static_cast<float>(distance) * 2;
      const RayOptions options{.radius = 2, .jitter = {.rotation = 0}, .surface_offset = 0};
      const Receiver receiver{.normal = random_direction(random_)};
      for (const auto& some : {rays, thinned(rays)}) {
        const SamplePattern pattern = pattern_of(some);
        const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern, options);
        const OccluderBvh occluders(
            placed({triangle_in_plane(normal, height, 0.3 * height)}, nothing, receiver).view());
        blocked_count_ += expect_scalar_bits({{{occluders, limit}}, pattern, options, {receiver}});
        blocked_count_ += expect_scalar_bits({{{occluders, 0, limit}}, pattern, options, {receiver}});
        const std::vector<OccluderLevel> both = {{occluders, 0, limit}, {occluders, limit}};
        EXPECT_GT(expect_scalar_bits({both, pattern, options, {receiver}}), 0u);
      }
      ray_count_ += 2 * (rays.size() + rays.size() / 21);
    }
  }
  expect_some_blocked();
}

// Edges from large and near to tiny and far away, with rays through them that go on behind.
TEST_F(PlaneSlacks, OfRaysThroughAnEdge) {
  for (const double size : {1.0, 0.1, 1e-2, 1e-3, 1e-4}) {
    for (int repetition = 0; repetition < 40; ++repetition) {
      const glm::dvec3 middle = share(random_, 0.05, 0.45) * random_normal();
      const auto corner = [&] {
        const glm::dvec3 p = middle + size * glm::length(middle) * glm::dvec3(random_direction(random_));
        return glm::dvec3(p.x, p.y, std::max(p.z, kLowest * glm::length(p)));
      };
      const glm::dvec3 a = corner(), b = corner();
      std::vector<PatternRay> rays;
      while (rays.size() < kRayCount) {
        const glm::dvec3 point = glm::mix(a, b, share(random_, 0, 1));
        rays.push_back(point * share(random_, 1, 1 / glm::length(point)));
      }
      // Alone, and with a neighbour across the edge.
      const LocalTriangle one{a, b, corner()};
      ask(rays, {one}, {1, repetition % 2 == 0 ? glm::vec3(0) : random_point(random_, 1)});
      ask(rays, {one, {b, a, corner()}});
    }
  }
  expect_some_blocked();
}

// A ray in doubt about one triangle must not ask another that is excluded.
TEST_F(PlaneSlacks, AskNoExcludedTriangle) {
  for (int repetition = 0; repetition < 40; ++repetition) {
    const glm::dvec3 normal = random_normal();
    const double height = 0.3;
    const std::vector<PatternRay> all = rays_ending_in_plane(normal, height, 0);
    for (const auto& rays : {all, thinned(all)}) {
      const RayOptions options{.radius = 1, .jitter = {.rotation = 0}, .surface_offset = 0};
      const SamplePattern pattern = pattern_of(rays);
      const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern, options);
      const Receiver receiver{.normal = random_direction(random_), .excluded_primitive = 1};
      // The second is nearer: it would block all rays.
      const Mesh mesh = placed({triangle_in_plane(normal, height, 0.1), triangle_in_plane(normal, 0.9 * height, 0.1)},
                               nothing, receiver);
      blocked_count_ += expect_same_bits(mesh, pattern, options, {receiver});
      ray_count_ += rays.size();
    }
  }
  EXPECT_LT(blocked_count_, ray_count_ * 3 / 4);
}

// Receivers so near to a plane that rounding could put them on either side of it.
TEST_F(PlaneSlacks, OfReceiversNextToAPlane) {
  for (const float size : {1.0f, 1e-4f, 1e6f}) {
    for (int repetition = 0; repetition < 60; ++repetition) {
      const glm::vec3 normal = random_direction(random_);
      const Tangents tangents(normal);
      const glm::dvec3 middle = size * random_point(random_, repetition % 3 == 0 ? 0.0f : 1.0f);
      Mesh mesh;
      for (int i = 0; i < 3; ++i) {
        mesh.positions.emplace_back(middle + static_cast<double>(size) * tangents.at(2.1 * i + share(random_, 0, 1)));
      }
      mesh.triangles.emplace_back(0, 1, 2);
      std::vector<Receiver> receivers;
      for (int i = 0; i < 30; ++i) {
        const double height = size * std::pow(10.0, share(random_, -10, -5)) * (i % 2 == 0 ? 1 : -1);
        const glm::dvec3 across = 0.3 * size * glm::dvec3(random_point(random_, 1));
        const glm::dvec3 within = across - glm::dot(across, glm::dvec3(normal)) * glm::dvec3(normal);
        receivers.push_back({.position = middle + within + height * glm::dvec3(normal),
                             .normal = i % 3 == 0 ? random_direction(random_) : (i % 2 == 0 ? -normal : normal)});
      }
      for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
        const RayOptions options{.radius = 0.5f * size, .sidedness = sidedness, .surface_offset = 0};
        blocked_count_ += expect_same_bits(mesh, SamplePattern::standard(64), options, receivers);
        ray_count_ += 64 * receivers.size();
      }
    }
  }
  expect_some_blocked();
}

}  // namespace
}  // namespace lkao::tests
