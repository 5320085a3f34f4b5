// Triangles of awkward shapes, and awkward company of triangles.
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hard_case.h"

namespace lkao::tests {
namespace {

void add_triangle(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto first = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

// Needles (two corners close together), caps (one corner next to the middle of the longest edge), and some near the
// origin along an axis, where floats can hold any thickness.
HardCase slivers(float aspect, std::uint64_t seed) {
  HardCase made{{}, usual_pattern()};
  lut::RandomStream random(seed);
  for (int i = 0; i < 1200; ++i) {
    glm::vec3 start = random_point(random, 1), end = random_point(random, 1);
    glm::vec3 off = glm::cross(end - start, random_direction(random)) / aspect;
    if (i % 3 == 2) {
      start = random_point(random, 1) * glm::vec3(1, 1 / aspect, 1 / aspect);
      end = random_point(random, 1) * glm::vec3(1, 1 / aspect, 1 / aspect);
      off = random_point(random, 1) * glm::vec3(0, 1 / aspect, 1 / aspect);
    }
    add_triangle(made.mesh, start, end, (i % 3 == 0 ? end : 0.5f * (start + end)) + off);
  }
  add_usual_groups(made, 48, seed);
  return made;
}

// Triangles with equal corners, with corners on one line, and with an area that only the last bit of a coordinate
// makes, in the company of good ones.
HardCase zero_areas() {
  HardCase made{random_soup(600, 0.3f, 11), usual_pattern()};
  lut::RandomStream random(12);
  for (int i = 0; i < 900; ++i) {
    // Steps of 1/1024: sums and differences of these are exact.
    const glm::vec3 start = glm::round(random_point(random, 512)) / 1024.0f;
    const glm::vec3 step = glm::round(random_point(random, 100)) / 1024.0f;
    glm::vec3 third = start + step * static_cast<float>(random.next_below(4));
    if (i % 3 == 1) third.x = std::nextafter(third.x, 2.0f);
    add_triangle(made.mesh, start, start + step, i % 3 == 2 ? start + step : third);
  }
  add_usual_groups(made, 64, 13);
  return made;
}

// Corners on a grid of eighths, so that receivers, planes, edges and ends of rays coincide.
HardCase on_a_grid() {
  HardCase made{random_soup(1500, 0.4f, 21), axis_pattern()};
  for (glm::vec3& p : made.mesh.positions) p = glm::round(p * 8.0f) / 8.0f;
  lut::RandomStream random(22);
  for (float radius : {0.25f, 1.0f, 16.0f}) {
    made.groups.push_back({{.radius = radius, .jitter = {.rotation = 0}, .surface_offset = 0}});
    for (int i = 0; i < 200; ++i) {
      glm::vec3 axis(0);
      axis[i % 3] = i % 2 == 0 ? 1.0f : -1.0f;
      made.groups.back().receivers.push_back(
          {.position = glm::round(random_point(random, 1) * 8.0f) / 8.0f, .normal = axis});
    }
  }
  add_usual_groups(made, 48, 23);
  return made;
}

// A sheet of 24 x 24 quads, tilted against the axes, with corners off the plane by `bend`: 0 leaves the rounding of
// floats.
HardCase sheet(float bend, std::uint64_t seed) {
  HardCase made{{}, usual_pattern()};
  constexpr unsigned kSide = 24;
  lut::RandomStream random(seed);
  const glm::quat tilt = random_rotation(random);
  for (unsigned i = 0; i <= kSide; ++i) {
    for (unsigned j = 0; j <= kSide; ++j) {
      made.mesh.positions.push_back(
          tilt * glm::vec3(static_cast<float>(i) / kSide, static_cast<float>(j) / kSide, uniform(random, -bend, bend)));
    }
  }
  for (unsigned i = 0; i < kSide; ++i) {
    for (unsigned j = 0; j < kSide; ++j) {
      const unsigned first = i * (kSide + 1) + j;
      made.mesh.triangles.emplace_back(first, first + kSide + 1, first + 1);
      made.mesh.triangles.emplace_back(first + 1, first + kSide + 1, first + kSide + 2);
    }
  }
  add_usual_groups(made, 64, seed);
  // Receivers hardly above the sheet, whose rays graze it.
  made.groups.push_back({{.radius = 0.5f, .jitter = {.rotation = 0}, .surface_offset = 0}});
  for (int i = 0; i < 64; ++i) {
    const float height = std::pow(10.0f, uniform(random, -8, -2));
    const glm::vec3 across = random_point(random, 1), place = 0.5f + 0.5f * random_point(random, 1);
    made.groups.back().receivers.push_back({.position = tilt * glm::vec3(place.x, place.y, height),
                                            .normal = tilt * glm::vec3(across.x, 1, 0.2f * across.z)});
  }
  return made;
}

// Every triangle three times, once with its corners turned and once from behind.
HardCase coincident() {
  HardCase made{random_soup(500, 0.4f, 31), usual_pattern()};
  for (int i = 0; i < 500; ++i) {
    const glm::uvec3 t = made.mesh.triangles[static_cast<std::size_t>(i)];
    made.mesh.triangles.emplace_back(t.y, t.z, t.x);
    made.mesh.triangles.emplace_back(t.x, t.z, t.y);
  }
  add_usual_groups(made, 64, 32);
  return made;
}

// Triangles as large as the scene, all through each other; some through each other's corners.
HardCase interpenetrating() {
  HardCase made{random_soup(400, 1.5f, 41), usual_pattern()};
  lut::RandomStream random(42);
  for (int i = 0; i < 400; ++i) {
    const glm::vec3& through = made.mesh.positions[random.next_below(1200)];
    const glm::vec3 u = random_direction(random), v = random_direction(random);
    add_triangle(made.mesh, through + u, through - u + 0.5f * v, through - v);
  }
  add_usual_groups(made, 64, 43);
  return made;
}

// 5000 triangles around one corner; `height` 0 makes a disk.
HardCase fan(float height, std::uint64_t seed) {
  HardCase made{{}, usual_pattern()};
  constexpr unsigned kCount = 5000;
  const glm::vec3 hub(0.1f, height, -0.2f);
  made.mesh.positions.push_back(hub);
  for (unsigned i = 0; i < kCount; ++i) {
    const double turn = 2 * std::numbers::pi * i / kCount;
    made.mesh.positions.emplace_back(std::cos(turn), 0, -std::sin(turn));
    made.mesh.triangles.emplace_back(0, i + 1, (i + 1) % kCount + 1);
  }
  add_usual_groups(made, 32, seed);
  // At the hub, and with a ray through it.
  lut::RandomStream random(seed);
  for (int i = 0; i < 24; ++i) {
    ReceiverGroup& group = made.groups[1];
    aim(group, made.pattern, hub, random_direction(random), i, i % 2 == 0 ? 1.0f : 0.7f);
    group.receivers.push_back({.position = hub, .normal = random_direction(random)});
  }
  return made;
}

HardCase not_finite() {
  HardCase made{random_soup(1000, 0.3f, 51), usual_pattern()};
  lut::RandomStream random(52);
  constexpr float kBad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()};
  for (int i = 0; i < 300; ++i) {
    glm::vec3& corner = made.mesh.positions[random.next_below(made.mesh.positions.size())];
    corner[static_cast<int>(random.next_below(3))] = kBad[i % 3];
  }
  add_usual_groups(made, 48, 53);
  return made;
}

}  // namespace

std::vector<NamedCase> triangle_cases() {
  return {
      {"SliversOfAspect1e2", [] { return slivers(1e2f, 2); }},
      {"SliversOfAspect1e3", [] { return slivers(1e3f, 3); }},
      {"SliversOfAspect1e4", [] { return slivers(1e4f, 4); }},
      {"SliversOfAspect1e5", [] { return slivers(1e5f, 5); }},
      {"SliversOfAspect1e6", [] { return slivers(1e6f, 6); }},
      {"SliversOfAspect1e7", [] { return slivers(1e7f, 7); }},
      {"NeedlesAndZeroAreas", zero_areas},
      {"FacesEdgesAndCornersOfAGrid", on_a_grid},
      {"CoplanarNeighbours", [] { return sheet(0, 61); }},
      {"NeighboursBentBy1em6", [] { return sheet(1e-6f, 62); }},
      {"NeighboursBentBy1em3", [] { return sheet(1e-3f, 63); }},
      {"CoincidentFaces", coincident},
      {"InterpenetratingFaces", interpenetrating},
      {"FlatFanOf5000", [] { return fan(0, 71); }},
      {"ConeOf5000", [] { return fan(0.4f, 72); }},
      {"NaNAndInfinity", not_finite},
  };
}

}  // namespace lkao::tests
