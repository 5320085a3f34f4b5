// The recipes against Embree, ray by ray, as the programs that they stand for cast them.
#include "recipes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "scene/embree.h"
#include "support/meshes.h"

namespace lkao::recipes {
namespace {

using tests::Mesh;

// A floor with walls and clutter, all of its vertices with a normal that points up and somewhere.
struct Scene {
  Mesh mesh;
  std::vector<Hit> points;

  Scene() {
    tests::add_quad(mesh, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    tests::add_quad(mesh, {-2, 0, -2}, {4, 0, 0}, {0, 1.5f, 0});
    tests::add_quad(mesh, {-2, 0, -2}, {0, 2.5f, 0}, {0, 0, 4});
    tests::add_quad(mesh, {-1, 1.8f, -1}, {1.5f, 0, 0}, {0, 0, 1});
    const Mesh soup = tests::random_soup(60, 0.15f, 401);
    for (const glm::uvec3& t : soup.triangles) {
      mesh.triangles.push_back(t + glm::uvec3(static_cast<unsigned>(mesh.positions.size())));
    }
    for (const glm::vec3& p : soup.positions) mesh.positions.push_back(p + glm::vec3(0, 1.2f, 0));
    lut::RandomStream random(402);
    for (int i = 0; i < 150; ++i) {
      const glm::vec3 place = tests::random_point(random, 1.9f), lean = 0.2f * tests::random_direction(random);
      points.push_back({{place.x, 0.001f, place.z}, glm::normalize(glm::vec3(0, 1, 0) + lean)});
    }
  }
};

const Scene& scene() {
  static const Scene scene;
  return scene;
}

class Embree {
 public:
  explicit Embree(const Mesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    auto* const triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
  }

  bool is_blocked(const glm::vec3& from, const glm::vec3& towards) const {
    scene::embree::RayQuery query;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    RTCRay ray{from.x, from.y, from.z, 1e-4f, towards.x, towards.y, towards.z, 0, kInfinity, ~0u, 0, 0};
    find_blocked(scene_.get(), query, ray);
    return ray.tfar < 0;
  }

 private:
  scene::embree::Device device_;
  scene::embree::Scene scene_;
};

using Random = std::mt19937;

float uniform(Random& random) { return std::uniform_real_distribution<float>(0, 1)(random); }

// Any direction of the sphere, turned over where it points down, as libigl and aobaker choose it.
glm::vec3 even_direction(const glm::vec3& normal, Random& random) {
  const float z = 2 * uniform(random) - 1, turn = 2 * std::numbers::pi_v<float> * uniform(random);
  const float radius = std::sqrt(1 - z * z);
  const glm::vec3 direction(radius * std::cos(turn), radius * std::sin(turn), z);
  return glm::dot(direction, normal) < 0 ? -direction : direction;
}

// The normal and any direction of the sphere, added, are cosine-weighted, as hdEmbree's are.
glm::vec3 cosine_direction(const glm::vec3& normal, Random& random) {
  const glm::vec3 sum = normal + even_direction(normal, random) * (uniform(random) < 0.5f ? 1.0f : -1.0f);
  return glm::length(sum) > 1e-6f ? glm::normalize(sum) : normal;
}

using Directions = glm::vec3 (*)(const glm::vec3&, Random&);

// The loop of those programs.
std::vector<double> ray_by_ray(const std::vector<Hit>& points, Directions direction, int ray_count, unsigned seed) {
  static const Embree embree(scene().mesh);
  Random random(seed);
  std::vector<double> occlusion;
  for (const Hit& point : points) {
    int hit_count = 0;
    for (int i = 0; i < ray_count; ++i) {
      hit_count += embree.is_blocked(point.position, direction(point.normal, random));
    }
    occlusion.push_back(static_cast<double>(hit_count) / ray_count);
  }
  return occlusion;
}

struct Errors {
  double mean, rms;
};

Errors errors_of(const std::vector<double>& answers, const std::vector<double>& truth) {
  double sum = 0, sum2 = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += answers[i] - truth[i];
    sum2 += (answers[i] - truth[i]) * (answers[i] - truth[i]);
  }
  const auto count = static_cast<double>(truth.size());
  return {sum / count, std::sqrt(sum2 / count)};
}

constexpr int kManyRays = 10'000;

const std::vector<double>& truth(Directions direction) {
  static const std::vector<double> even = ray_by_ray(scene().points, even_direction, kManyRays, 1),
                                   cosine = ray_by_ray(scene().points, cosine_direction, kManyRays, 2);
  return direction == even_direction ? even : cosine;
}

// Less noise than so many rays of the program's own.
void expect_less_noise(const std::vector<double>& answers, Directions direction, int ray_count) {
  ASSERT_EQ(answers.size(), scene().points.size());
  const std::vector<double> own = ray_by_ray(scene().points, direction, ray_count, 3);
  EXPECT_LT(errors_of(answers, truth(direction)).rms, errors_of(own, truth(direction)).rms);
}

// And no bias beyond what chance gives the mean over all points.
void expect_like(const std::vector<double>& answers, Directions direction, int ray_count) {
  expect_less_noise(answers, direction, ray_count);
  double variance = 0;
  for (const double p : truth(direction)) variance += p * (1 - p) / static_cast<double>(answers.size());
  const double by_chance = std::sqrt(variance / static_cast<double>(answers.size()) / ray_count);
  EXPECT_LT(std::abs(errors_of(answers, truth(direction)).mean), 3 * by_chance + 1e-3);
}

template <class Number>
std::vector<Number> flat(const std::vector<glm::vec3>& points) {
  std::vector<Number> numbers;
  for (const glm::vec3& p : points) numbers.insert(numbers.end(), {Number{p.x}, Number{p.y}, Number{p.z}});
  return numbers;
}

template <class Number>
std::vector<Number> flat(const std::vector<Hit>& points, glm::vec3 Hit::*of) {
  std::vector<glm::vec3> chosen;
  for (const Hit& point : points) chosen.push_back(point.*of);
  return flat<Number>(chosen);
}

// What the others tell apart, or they would pass with the wrong directions.
TEST(Recipes, WeightingsAreFarApart) {
  EXPECT_GT(std::abs(errors_of(truth(even_direction), truth(cosine_direction)).mean), 0.03);
}

TEST(Recipes, LibiglLikeIsItsLoop) {
  const Mesh& mesh = scene().mesh;
  std::vector<int> triangles;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) triangles.push_back(static_cast<int>(t[corner]));
  }
  std::vector<double> vertices = flat<double>(mesh.positions), points = flat<double>(scene().points, &Hit::position);
  const std::vector<double> normals = flat<double>(scene().points, &Hit::normal);
  for (const int n : {10, 100, 500})
    expect_like(libigl_like(vertices, triangles, points, normals, n), even_direction, n);
  // Doubles keep their digits far from zero.
  for (std::vector<double>* numbers : {&vertices, &points}) {
    for (double& number : *numbers) number += 1e6;
  }
  expect_like(libigl_like(vertices, triangles, points, normals, 100), even_direction, 100);
  EXPECT_EQ(libigl_like(vertices, triangles, points, normals, 5000).size(), scene().points.size());
}

TEST(Recipes, AobakerLikeIsItsLoop) {
  // Its vertices are its points: loose ones that no triangle uses.
  std::vector<glm::vec3> positions = scene().mesh.positions, normals(positions.size(), glm::vec3(0, 1, 0));
  for (const Hit& point : scene().points) positions.push_back(point.position), normals.push_back(point.normal);
  std::vector<std::uint32_t> indices;
  for (const glm::uvec3& t : scene().mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
  for (const int nsamples : {50, 200}) {
    const std::vector<float> brightness = aobaker_like(flat<float>(positions), flat<float>(normals), indices, nsamples);
    ASSERT_EQ(brightness.size(), positions.size());
    std::vector<double> occlusion;
    for (std::size_t i = scene().mesh.positions.size(); i < brightness.size(); ++i) {
      occlusion.push_back(1 - static_cast<double>(brightness[i]));
    }
    expect_like(occlusion, even_direction, nsamples);
  }
}

TEST(Recipes, HdembreeLikeIsItsLoop) {
  const Mesh& mesh = scene().mesh;
  constexpr int kPassCount = 20;
  std::vector<double> mean(scene().points.size());
  for (int pass = 0; pass < kPassCount; ++pass) {
    std::vector<double> occlusion;
    for (const float v : hdembree_like(mesh.positions, mesh.triangles, scene().points, pass))
      occlusion.push_back(1 - v);
    // All points of a pass have one pattern, and what error its elevations make.
    expect_less_noise(occlusion, cosine_direction, 16);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += occlusion[i] / kPassCount;
  }
  // The mean of the passes converges.
  expect_like(mean, cosine_direction, 16 * kPassCount);
}

}  // namespace
}  // namespace lkao::recipes
