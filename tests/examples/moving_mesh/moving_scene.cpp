#include "moving_scene.h"

#include <cmath>
#include <numbers>

#include "scene/shapes.h"

namespace moving_mesh {
namespace {

constexpr double kBallRadius = 0.45;
constexpr double kBounceSeconds = 0.9;
constexpr double kBounceHeight = 1.2;
// Points of the cloth along its upper edge and down.
constexpr std::size_t kClothColumns = 28;
constexpr std::size_t kClothRows = 20;

// With corners of its own for each face, so that edges stay sharp when normals are averaged.
void add_block(lkao::scene::Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b) {
  using lkao::scene::add_quad;
  add_quad(mesh, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
  add_quad(mesh, {b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z});
  add_quad(mesh, {a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z});
  add_quad(mesh, {b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z});
  add_quad(mesh, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z});
  add_quad(mesh, {a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
}

// Hangs from a rod; what is lower swings more.
glm::dvec3 cloth_point(double across, double down, double seconds) {
  const double wave = std::sin(9 * across - 4 * seconds) + 0.5 * std::sin(5 * down + 17 * across - 6.5 * seconds);
  return {-2.3 + 2.1 * across, 2.5 - 2.2 * down, -1.2 + 0.22 * down * wave};
}

std::vector<glm::dvec3> cloth_points(double seconds) {
  std::vector<glm::dvec3> points;
  for (std::size_t row = 0; row < kClothRows; ++row) {
    for (std::size_t column = 0; column < kClothColumns; ++column) {
      points.push_back(cloth_point(static_cast<double>(column) / (kClothColumns - 1),
                                   static_cast<double>(row) / (kClothRows - 1), seconds));
    }
  }
  return points;
}

}  // namespace

MovingScene::MovingScene() {
  build_room();
  paint({0.8f, 0.78f, 0.74f});

  first_of_ball_ = mesh_.positions.size();
  lkao::scene::add_sphere(mesh_, {0, 0, 0}, kBallRadius, 32, 16);
  ball_.assign(mesh_.positions.begin() + static_cast<std::ptrdiff_t>(first_of_ball_), mesh_.positions.end());
  paint({0.8f, 0.3f, 0.2f});

  first_of_cloth_ = mesh_.positions.size();
  lkao::scene::add_grid(mesh_, cloth_points(0), kClothColumns);
  paint({0.3f, 0.45f, 0.7f});
  move_to(0);
}

void MovingScene::build_room() {
  using lkao::scene::add_quad;
  add_quad(mesh_, {-3, 0, 2}, {3, 0, 2}, {3, 0, -3}, {-3, 0, -3});
  add_quad(mesh_, {-3, 0, -3}, {3, 0, -3}, {3, 3.2, -3}, {-3, 3.2, -3});
  add_quad(mesh_, {-3, 0, 2}, {-3, 0, -3}, {-3, 3.2, -3}, {-3, 3.2, 2});
  add_quad(mesh_, {3, 0, -3}, {3, 0, 2}, {3, 3.2, 2}, {3, 3.2, -3});
  add_block(mesh_, {-2.4, 2.5, -1.23}, {-0.1, 2.56, -1.17});  // the rod
  for (int i = 0; i < 3; ++i) add_block(mesh_, {0.6 + 0.5 * i, -0.1, -3.1}, {3.1, 0.35 * (i + 1), -1.9 - 0.2 * i});
  add_block(mesh_, {-2.7, -0.1, -0.6}, {-1.9, 0.5, 0.2});
}

void MovingScene::move_to(double seconds) {
  move_ball(seconds);
  move_cloth(seconds);
}

void MovingScene::move_ball(double seconds) {
  const double share = std::fmod(seconds / kBounceSeconds, 1.0);
  const double turn = 2 * std::numbers::pi * seconds / (4 * kBounceSeconds);
  const glm::vec3 center(0.9 + 0.6 * std::cos(turn), kBallRadius + kBounceHeight * 4 * share * (1 - share),
                         -0.7 + 0.6 * std::sin(turn));
  for (std::size_t i = 0; i < ball_.size(); ++i) mesh_.positions[first_of_ball_ + i] = center + ball_[i];
}

void MovingScene::move_cloth(double seconds) {
  const std::vector<glm::dvec3> points = cloth_points(seconds);
  for (std::size_t i = 0; i < points.size(); ++i) mesh_.positions[first_of_cloth_ + i] = glm::vec3(points[i]);
}

}  // namespace moving_mesh
