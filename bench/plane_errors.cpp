#include "bench/plane_errors.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "bvh/table_lookup.h"
#include "lut/random.h"

namespace lkao::bench {
namespace {

using bvh::MaskBounds;

// Evenly over the sphere.
glm::dvec3 random_normal(lut::RandomStream& random) {
  const double z = 2 * random.next_double() - 1, turn = 2 * std::numbers::pi * random.next_double();
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(turn), radius * std::sin(turn), z};
}

// Evenly within the half ball above the receiver's horizon.
glm::vec3 random_center(lut::RandomStream& random) {
  glm::dvec3 center = random_normal(random) * std::cbrt(random.next_double());
  center.z = std::fabs(center.z);
  return center;
}

// Every size from `low` to `high` equally often, in terms of factors.
float random_size(lut::RandomStream& random, double low, double high) {
  return static_cast<float>(low * std::pow(high / low, random.next_double()));
}

// Adds up what look-ups get wrong and leave open.
class ErrorSum {
 public:
  void add(const MaskBounds& bounds, const OcclusionMask& exact) {
    wrong_ += ((exact & ~bounds.may) | (bounds.must & ~exact)).count();
    in_doubt_ += (bounds.may & ~bounds.must).count();
    ++count_;
  }
  RayErrors mean() const {
    const auto count = static_cast<double>(count_);
    return {static_cast<double>(wrong_) / count, static_cast<double>(in_doubt_) / count};
  }

 private:
  std::int64_t wrong_ = 0, in_doubt_ = 0, count_ = 0;
};

OcclusionMask all_rays(int word_count) {
  OcclusionMask mask;
  for (int i = 0; i < word_count; ++i) mask.words[i] = ~std::uint64_t{0};
  return mask;
}

}  // namespace

PlaneSamples::PlaneSamples(SamplePattern pattern, int count, std::uint64_t seed) : pattern_(std::move(pattern)) {
  for (std::size_t i = 0; i < pattern_.directions().size(); ++i) {
    ends_.push_back(pattern_.directions()[i] * pattern_.lengths()[i]);
  }
  lut::RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    add_plane(edges_, random_normal(random), 0);
    const glm::dvec3 normal = random_normal(random);
    add_plane(planes_, normal, random.next_double());
    // From one cell's width to twice the radius: the sizes that are neither lost between rays nor mere planes.
    const glm::vec3 center = random_center(random),
                    offsets[3] = {random_normal(random), random_normal(random), random_normal(random)};
    add_triangle(center, random_size(random, 0.02, 2), offsets);
  }
}

void PlaneSamples::add_plane(std::vector<Plane>& planes, const glm::dvec3& normal, double distance) const {
  Plane plane{normal, distance, {}};
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (glm::dot(normal, glm::dvec3(ends_[i])) >= distance) plane.beyond.set(static_cast<int>(i));
  }
  planes.push_back(plane);
}

void PlaneSamples::add_triangle(const glm::vec3& center, float size, const glm::vec3 (&offsets)[3]) {
  const bvh::TriangleTest test(center + size * offsets[0], center + size * offsets[1], center + size * offsets[2],
                               glm::vec3(0), 1, Sidedness::two_sided);
  if (!test.can_block()) return;
  Triangle triangle{test, {}};
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (test.blocks(ends_[i])) triangle.blocked.set(static_cast<int>(i));
  }
  triangles_.push_back(triangle);
}

PlaneErrors PlaneSamples::errors(const PlaneMaskTable& table) const {
  const bvh::TableLookup lookup(table, glm::mat3(1), 1);
  const OcclusionMask all = all_rays(pattern_.word_count());
  ErrorSum edge, plane, triangle;
  for (const Plane& sample : edges_) {
    MaskBounds bounds{all, all};
    lookup.keep_beyond_edge(sample.normal, bounds);
    edge.add(bounds, sample.beyond);
  }
  for (const Plane& sample : planes_) {
    MaskBounds bounds{all, all};
    lookup.keep_beyond(sample.normal, sample.distance, bounds);
    plane.add(bounds, sample.beyond);
  }
  for (const Triangle& sample : triangles_) {
    MaskBounds bounds{all, all};
    for (int i = 0; i < 3; ++i) lookup.keep_beyond_edge(sample.test.edge(i), bounds);
    lookup.keep_beyond(sample.test.normal(), sample.test.distance(), bounds);
    triangle.add(bounds, sample.blocked);
  }
  return {edge.mean(), plane.mean(), triangle.mean()};
}

}  // namespace lkao::bench
