#include "scene/atrium_furniture.h"

#include <utility>

namespace lkao::scene {

namespace {

// The same profile with rounder corners: every corner cut twice (Chaikin's scheme); the ends stay.
std::vector<glm::dvec2> rounded(std::vector<glm::dvec2> profile) {
  for (int step = 0; step < 2; ++step) {
    std::vector<glm::dvec2> finer = {profile.front()};
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      if (i > 0) finer.push_back(0.75 * profile[i] + 0.25 * profile[i + 1]);
      if (i + 2 < profile.size()) finer.push_back(0.25 * profile[i] + 0.75 * profile[i + 1]);
    }
    finer.push_back(profile.back());
    profile = std::move(finer);
  }
  return profile;
}

void add_bench(Mesh& mesh, double x, double z) {
  add_box(mesh, {x - 0.9, 0.4, z - 0.24}, {x + 0.9, 0.5, z + 0.24});
  for (double leg : {-0.62, 0.62}) {
    add_box(mesh, {x + leg - 0.09, -kAtriumSink, z - 0.17}, {x + leg + 0.09, 0.41, z + 0.17});
  }
}

// A round basin in the middle of the nave: a step, a bowl with water-smooth bottom, a stem with a cup.
void add_basin(Mesh& mesh) {
  const glm::dvec3 base(-1.9, 0, 0);
  std::vector<glm::dvec2> step = {{1.75, -kAtriumSink}, {1.75, 0.1}, {1.7, 0.14}, {1.0, 0.14}};
  add_revolved(mesh, base, step, 96);
  std::vector<glm::dvec2> bowl = {{1.38, 0.12}, {1.38, 0.2}, {1.3, 0.24}, {1.3, 0.5}, {1.36, 0.55}};
  add_bulge(bowl, 1.38, 0.56, 0.68, 8);
  bowl.insert(bowl.end(), {{1.2, 0.68}, {1.17, 0.64}, {1.15, 0.32}, {1.08, 0.27}, {0, 0.27}});
  add_revolved(mesh, base, bowl, 96);
  std::vector<glm::dvec2> stem = {{0.34, 0.25}, {0.34, 0.36}, {0.2, 0.42}, {0.12, 0.6}, {0.1, 0.8}};
  add_bulge(stem, 0.1, 0.82, 0.92, 6);
  stem.insert(stem.end(), {{0.11, 0.98},
                           {0.22, 1.04},
                           {0.46, 1.12},
                           {0.6, 1.22},
                           {0.62, 1.27},
                           {0.58, 1.27},
                           {0.42, 1.17},
                           {0.2, 1.11},
                           {0, 1.1}});
  add_revolved(mesh, base, stem, 64);
  add_sphere(mesh, base + glm::dvec3(0, 1.2, 0), 0.14, 32, 20);
}

}  // namespace

void add_bulge(std::vector<glm::dvec2>& profile, double inner_radius, double low, double high, int step_count) {
  const double r = 0.5 * (high - low);
  for (int i = 0; i <= step_count; ++i) {
    const glm::dvec2 p = unit_circle(0.5 * i / step_count - 0.25);
    profile.emplace_back(inner_radius + r * p.x, low + r + r * p.y);
  }
}

void add_urn(Mesh& mesh, const glm::dvec3& base, double scale) {
  constexpr double kProfile[][2] = {{0, 0},       {0.2, 0},     {0.2, 0.05},  {0.12, 0.08}, {0.07, 0.14}, {0.08, 0.2},
                                    {0.16, 0.25}, {0.27, 0.36}, {0.32, 0.5},  {0.31, 0.62}, {0.25, 0.74}, {0.17, 0.8},
                                    {0.15, 0.86}, {0.2, 0.92},  {0.22, 0.95}, {0.19, 0.95}, {0.13, 0.88}, {0.13, 0.8},
                                    {0.2, 0.72},  {0.26, 0.6},  {0.25, 0.45}, {0.14, 0.34}, {0, 0.3}};
  std::vector<glm::dvec2> profile;
  for (const auto& p : kProfile) profile.emplace_back(scale * p[0], scale * p[1]);
  add_revolved(mesh, base - glm::dvec3(0, kAtriumSink, 0), rounded(profile), 40);
}

void add_pedestal(Mesh& mesh, const glm::dvec3& base, double half, double height) {
  add_box(mesh, base - glm::dvec3(half + 0.08, kAtriumSink, half + 0.08),
          base + glm::dvec3(half + 0.08, 0.12, half + 0.08));
  add_box(mesh, base + glm::dvec3(-half, 0.1, -half), base + glm::dvec3(half, height - 0.1, half));
  add_box(mesh, base + glm::dvec3(-half - 0.06, height - 0.12, -half - 0.06),
          base + glm::dvec3(half + 0.06, height, half + 0.06));
}

void add_atrium_furniture(Mesh& mesh) {
  add_basin(mesh);
  for (double z : {-6.3, 6.3}) {
    for (int bay = 1; bay < 6; bay += 2) add_bench(mesh, -15 + (bay + 0.5) * 3.75, z);
  }
  for (double z : {-2.35, 2.35}) {
    add_pedestal(mesh, {11.2, 0, z}, 0.3, 1.0);
    add_sphere(mesh, {11.2, 1.4, z}, 0.42, 56, 36);
    add_pedestal(mesh, {-6.0, 0, z * 1.1}, 0.28, 0.75);
    add_urn(mesh, {-6.0, 0.75, z * 1.1}, 0.95);
  }
  // Balls that somebody left on the floor.
  add_sphere(mesh, {-8.3, 0.34, -0.75}, 0.36, 48, 32);
  add_sphere(mesh, {-7.75, 0.2, -0.35}, 0.22, 40, 26);
  add_sphere(mesh, {-8.05, 0.12, 0.02}, 0.14, 32, 20);
}

}  // namespace lkao::scene
