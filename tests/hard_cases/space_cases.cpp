// Scenes of awkward sizes in awkward places, and boxes and rays along the axes.
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hard_case.h"

namespace lkao::tests {
namespace {

// A closed sphere, a box that cuts it, and loose triangles around both.
Mesh sphere_and_soup() {
  Mesh mesh = random_soup(500, 0.3f, 1);
  const auto append = [&](const Mesh& part) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const glm::uvec3& t : part.triangles) mesh.triangles.push_back(t + first);
  };
  append(closed_sphere(24, 12));
  Mesh box = closed_box();
  for (glm::vec3& p : box.positions) p = 0.5f * p + glm::vec3(0.4f, 0.3f, 0.2f);
  append(box);
  return mesh;
}

HardCase scaled(float scale) {
  HardCase made{sphere_and_soup(), usual_pattern()};
  for (glm::vec3& p : made.mesh.positions) p *= scale;
  add_usual_groups(made, 64, 2);
  return made;
}

// The scene is 20 across; a float has steps of 1/16 at an offset of 1e6, which leaves coarse shapes with coincident
// corners, flat parts and zero areas.
HardCase moved(float offset) {
  HardCase made{sphere_and_soup(), usual_pattern()};
  for (glm::vec3& p : made.mesh.positions) p = 10.0f * p + offset * glm::vec3(1, -0.7f, 0.3f);
  add_usual_groups(made, 64, 3);
  return made;
}

HardCase radii() {
  HardCase made{sphere_and_soup(), usual_pattern()};
  add_usual_groups(made, 40, 4, {1e-4f, 1e-3f, 1e-2f, 0.1f, 1, 10, 1e3f, 1e6f});
  return made;
}

// Rays without end, of one length: tables know no others.
HardCase endless() {
  HardCase made{sphere_and_soup(), SamplePattern::standard(128)};
  add_usual_groups(made, 64, 11, {std::numeric_limits<float>::infinity()});
  return made;
}

// A pattern that has rays for a scene at any distance: as many within a tenth of an angle as within it.
SamplePattern telescope_pattern() {
  std::vector<glm::vec2> points;
  std::vector<float> lengths(128, 1.0f);
  for (int i = 0; i < 128; ++i) {
    const float away = 0.9f * std::pow(10.0f, -6.0f * static_cast<float>(i) / 127), turn = 2.4f * static_cast<float>(i);
    points.emplace_back(away * std::cos(turn), away * std::sin(turn));
  }
  return SamplePattern::from_disk(points, lengths);
}

// Receivers up to a million times as far away as the scene is large, looking at it; with rays that end within it,
// behind it, or nowhere.
HardCase far_outside() {
  HardCase made{sphere_and_soup(), telescope_pattern()};
  lut::RandomStream random(12);
  for (const float distance : {2.0f, 10.0f, 1e3f, 1e6f}) {
    for (const float radius : {distance, 3 * distance, std::numeric_limits<float>::infinity()}) {
      made.groups.push_back({{.radius = radius, .surface_offset = 0}});
      for (int i = 0; i < 16; ++i) {
        const glm::vec3 from = random_direction(random);
        const glm::vec3 target = random_point(random, 0.5f);
        made.groups.back().receivers.push_back({.position = target + distance * from, .normal = -from});
      }
    }
  }
  return made;
}

// Corners from 10^low to 10^high, in all directions.
HardCase mixed_magnitudes(float low, float high, const std::vector<float>& radii) {
  HardCase made{{}, usual_pattern()};
  lut::RandomStream random(5);
  for (unsigned i = 0; i < 1000; ++i) {
    for (int k = 0; k < 3; ++k) {
      const float distance = std::pow(10.0f, uniform(random, low, high));
      made.mesh.positions.push_back(distance * random_direction(random));
    }
    made.mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  add_usual_groups(made, 48, 6, radii);
  return made;
}

// Differences of these coordinates need more bits than a double has, and needles are 1e18 times as long as wide: the
// plane of such a one is where the last bit of a double puts it.
HardCase extreme_magnitudes() {
  HardCase made = mixed_magnitudes(-12, 6, {1e-16f, 1e-12f, 1e-8f, 1e-4f, 0.3f, 10});
  made.rounding_distance = 1e-7;
  return made;
}

// Boxes of a pile, face to face: receivers and rays in the planes of their faces, along their edges and
// through their corners.
HardCase stacked_boxes() {
  HardCase made{{}, axis_pattern()};
  for (int i = 0; i < 125; ++i) {
    const Mesh box = closed_box();
    const auto first = static_cast<unsigned>(made.mesh.positions.size());
    const glm::vec3 corner(i % 5, i / 5 % 5, i / 25);
    if ((i * 7) % 3 == 0) continue;
    for (const glm::vec3& p : box.positions) made.mesh.positions.push_back(corner + 0.5f * p);
    for (const glm::uvec3& t : box.triangles) made.mesh.triangles.push_back(t + first);
  }
  lut::RandomStream random(7);
  for (float radius : {0.5f, 2.0f, 8.0f}) {
    made.groups.push_back({{.radius = radius, .jitter = {.rotation = 0}, .surface_offset = 0}});
    for (int i = 0; i < 150; ++i) {
      glm::vec3 axis(0);
      axis[i % 3] = i % 2 == 0 ? 1.0f : -1.0f;
      // Centres of boxes, of faces and of edges, corners, and quarters.
      const float steps = i % 4 == 0 ? 4.0f : 2.0f;
      const glm::vec3 position = glm::vec3(2) + glm::round(random_point(random, 3) * steps) / steps;
      made.groups.back().receivers.push_back({.position = position, .normal = axis});
    }
  }
  return made;
}

// Flat squares across the axes, whose boxes have no thickness, one behind the other; with receivers in their planes and
// rays that stay there.
HardCase flat_squares() {
  HardCase made{{}, axis_pattern()};
  lut::RandomStream random(8);
  for (int i = 0; i < 600; ++i) {
    const glm::vec3 corner = glm::round(random_point(random, 16)) / 8.0f;
    glm::vec3 u(0), v(0);
    u[i % 3] = static_cast<float>(1 + random.next_below(8)) / 8;
    v[(i + 1) % 3] = (i % 2 == 0 ? 1.0f : -1.0f) * static_cast<float>(1 + random.next_below(8)) / 8;
    add_quad(made.mesh, corner, u, v);
  }
  for (float radius : {0.125f, 1.0f, 4.0f, 1e4f}) {
    made.groups.push_back({{.radius = radius, .jitter = {.rotation = 0}, .surface_offset = 0}});
    for (int i = 0; i < 120; ++i) {
      glm::vec3 axis(0);
      axis[i % 3] = i % 2 == 0 ? 1.0f : -1.0f;
      const float steps = i % 4 == 0 ? 32.0f : 8.0f;
      const glm::vec3 position = glm::round(random_point(random, 2) * steps) / steps;
      made.groups.back().receivers.push_back({.position = position, .normal = axis});
    }
  }
  add_usual_groups(made, 48, 9);
  return made;
}

// Inside a closed sphere with fans of slivers at its poles, rays aimed at its corners and edges, from all distances.
HardCase inside_a_sphere() {
  HardCase made{closed_sphere(64, 24), usual_pattern()};
  lut::RandomStream random(10);
  made.groups.push_back({{.radius = 4, .jitter = {.rotation = 0}, .surface_offset = 0}});
  ReceiverGroup& group = made.groups.back();
  while (group.receivers.size() < 300) {
    const glm::vec3& corner = made.mesh.positions[random.next_below(made.mesh.positions.size())];
    const glm::vec3& other = made.mesh.positions[random.next_below(made.mesh.positions.size())];
    const glm::vec3 target = group.receivers.size() % 2 == 0 ? corner : 0.5f * (corner + other);
    const auto ray = static_cast<int>(random.next_below(128));
    const float share = uniform(random, 0.01f, 0.4f);
    aim(group, made.pattern, target, random_direction(random), ray, share);
    if (glm::length(group.receivers.back().position) > 0.98f) group.receivers.pop_back();
  }
  return made;
}

}  // namespace

std::vector<NamedCase> space_cases() {
  return {
      {"ScaleOf1em6", [] { return scaled(1e-6f); }},
      {"ScaleOf1", [] { return scaled(1); }},
      {"ScaleOf1e6", [] { return scaled(1e6f); }},
      {"OffsetOf1e2", [] { return moved(1e2f); }},
      {"OffsetOf1e4", [] { return moved(1e4f); }},
      {"OffsetOf1e6", [] { return moved(1e6f); }},
      {"RadiusFrom1em4To1e6", radii},
      {"RaysWithoutEnd", endless},
      {"ReceiversFarOutside", far_outside},
      {"MagnitudesFrom1em4To1e4",
       [] {
         return mixed_magnitudes(-4, 4, {1e-7f, 1e-4f, 0.3f, 10});
       }},
      {"MagnitudesFrom1em12To1e6", extreme_magnitudes},
      {"StackedBoxesAndAxisRays", stacked_boxes},
      {"FlatBoxesAndAxisRays", flat_squares},
      {"CornersOfAClosedSphere", inside_a_sphere},
  };
}

}  // namespace lkao::tests
