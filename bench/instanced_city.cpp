#include "bench/instanced_city.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "scene/shapes.h"

namespace lkao::bench {
namespace {

using scene::Mesh;
using scene::Random;

constexpr int kTowerCount = 8, kTreeCount = 9, kBallCount = 2;
constexpr int kGround = kTowerCount + kTreeCount + kBallCount;  // the last mesh
constexpr double kStreet = 7;                                   // from one place to the next

// Four fronts of windows, each set back into its wall, around the vertical axis; one wide and one high.
Mesh make_tower(int number) {
  const int columns = 5 + number % 3, rows = 20 + 2 * (number / 3);
  std::vector<double> us, vs;
  for (int i = 0; i < columns; ++i) {
    for (const double share : {0.0, 0.2, 0.25, 0.75, 0.8}) us.push_back((i + share) / columns - 0.5);
  }
  us.push_back(0.5);
  for (int i = 0; i < rows; ++i) {
    for (const double share : {0.0, 0.2, 0.8}) vs.push_back((i + share) / rows);
  }
  vs.push_back(1);
  Mesh mesh;
  for (int front = 0; front < 4; ++front) {
    const glm::dvec2 turn = scene::unit_circle(0.25 * front);
    const auto place = [&](double u, double v, double height) {
      const double x = 0.5 + height, z = -u;
      return glm::dvec3(turn.x * x + turn.y * z, v, -turn.y * x + turn.x * z);
    };
    const auto height_at = [](std::size_t column, std::size_t row) {
      if (row % 3 != 1) return 0.0;
      return column % 5 == 2 ? -0.05 : column % 5 == 1 || column % 5 == 3 ? -0.02 : 0.0;
    };
    scene::add_relief(mesh, us, vs, height_at, place);
  }
  scene::add_quad(mesh, {-0.5, 1, 0.5}, {0.5, 1, 0.5}, {0.5, 1, -0.5}, {-0.5, 1, -0.5});
  return mesh;
}

// A trunk, and leaves in a crown around (0, 0.65, 0).
Mesh make_tree(int number) {
  Random random(static_cast<std::uint64_t>(100 + number));
  Mesh mesh;
  const glm::dvec2 trunk[] = {{0.05, 0}, {0.035, 0.3}, {0.02, 0.8}, {0, 0.85}};
  scene::add_revolved(mesh, {0, 0, 0}, trunk, 24);
  for (int leaf = 0; leaf < 5000; ++leaf) {
    const glm::dvec3 out = random.unit_vector(), along = random.unit_vector();
    const glm::dvec3 center = glm::dvec3(0, 0.65, 0) + glm::dvec3(0.3, 0.35, 0.3) * std::cbrt(random.uniform()) * out;
    const glm::dvec3 across = 0.014 * glm::normalize(glm::cross(out, along)), down = 0.022 * along;
    scene::add_quad(mesh, center - across - down, center + across - down, center + across + down,
                    center - across + down);
  }
  return mesh;
}

Mesh make_mesh(int number) {
  if (number < kTowerCount) return make_tower(number);
  if (number < kTowerCount + kTreeCount) return make_tree(number);
  Mesh mesh;
  if (number < kGround) {
    scene::add_sphere(mesh, {0, 0.5, 0}, 0.5, 96 + 8 * (number % 2), 64);
    return mesh;
  }
  std::vector<glm::dvec3> points;
  for (int row = 0; row <= 64; ++row) {
    for (int column = 0; column <= 64; ++column) points.emplace_back(column / 64.0 - 0.5, 0, 0.5 - row / 64.0);
  }
  scene::add_grid(mesh, points, 65);
  return mesh;
}

// Turned about the vertical axis, stretched before.
glm::mat4x3 stand(double turns, const glm::dvec3& scale, const glm::dvec3& place) {
  const glm::dvec2 turn = scene::unit_circle(turns);
  return {glm::vec3(scale.x * turn.x, 0, -scale.x * turn.y), glm::vec3(0, scale.y, 0),
          glm::vec3(scale.z * turn.y, 0, scale.z * turn.x), glm::vec3(place)};
}

OccluderInstance make_instance(Random& random, const glm::dvec3& place) {
  const double kind = random.uniform();
  const double turns = random.uniform();
  if (kind < 0.4) {
    const double width = random.uniform(3.5, 5), height = 3 + 17 * std::pow(random.uniform(), 3);
    const double upright = 0.25 * std::floor(4 * turns) + 0.01 * random.uniform();
    const auto mesh = static_cast<std::uint32_t>(random.below(kTowerCount));
    return {mesh, stand(upright, {width, height, random.uniform(3.5, 5)}, place)};
  }
  const glm::dvec3 aside = place + glm::dvec3(random.uniform(-2, 2), 0, random.uniform(-2, 2));
  if (kind < 0.85) {
    const double width = random.uniform(3, 6);
    const auto mesh = static_cast<std::uint32_t>(kTowerCount + random.below(kTreeCount));
    return {mesh, stand(turns, {width, random.uniform(3, 6), width}, aside)};
  }
  const auto mesh = static_cast<std::uint32_t>(kTowerCount + kTreeCount + random.below(kBallCount));
  return {mesh, stand(turns, glm::dvec3(random.uniform(0.5, 2)), aside)};
}

}  // namespace

InstancedCity make_city(std::size_t instance_count) {
  InstancedCity city;
  for (int i = 0; i <= kGround; ++i) city.meshes.push_back(make_mesh(i));
  const std::size_t placed_count = std::max<std::size_t>(instance_count, 2) - 1;
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(placed_count))));
  const double half = 0.5 * static_cast<double>(side - 1);
  Random random(1);
  for (std::size_t i = 0; i < placed_count; ++i) {
    const auto column = static_cast<double>(i % side), row = static_cast<double>(i / side);
    city.instances.push_back(make_instance(random, kStreet * glm::dvec3(column - half, 0, row - half)));
  }
  const double width = kStreet * (static_cast<double>(side) + 2);
  city.instances.push_back({kGround, stand(0, glm::dvec3(width), {0, 0, 0})});
  for (const OccluderInstance& instance : city.instances) {
    city.triangle_count += city.meshes[instance.mesh].triangles.size();
  }
  city.camera = {.eye = {0, 14, 0}, .target = {40, 2, 30}, .up = {0, 1, 0}, .fov = 60};
  return city;
}

std::vector<InstanceMove> stir(const InstancedCity& city, float distance, std::uint64_t seed) {
  Random random(seed);
  std::vector<InstanceMove> moves;
  for (std::uint32_t i = 0; i + 1 < city.instances.size(); ++i) {
    const glm::mat4x3& old = city.instances[i].to_world;
    const double far{distance};
    const glm::dvec3 place = glm::dvec3(old[3]) + glm::dvec3(random.uniform(-far, far), 0, random.uniform(-far, far));
    const glm::dvec3 scale(glm::length(old[0]), glm::length(old[1]), glm::length(old[2]));
    moves.push_back({i, stand(random.uniform(), scale, place)});
  }
  return moves;
}

}  // namespace lkao::bench
