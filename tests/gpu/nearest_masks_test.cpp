// With a nearest-cell table the pass gives the paper's approximate masks: what the CPU's look-ups give for each
// triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "bvh/ray_triangle.h"
#include "bvh/table_lookup.h"
#include "bvh/triangle_culls.h"
#include "gpu/cpu_rays.h"
#include "gpu/in_furnished_room.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::nearest_masks_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(96, 32);
constexpr int kHeight = lkao::tests::unless_sanitized(72, 24);

double distance_to_segment(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  return glm::length(a + std::clamp(-glm::dot(a, along) / glm::dot(along, along), 0.0, 1.0) * along);
}

// Distance of the origin from a triangle.
double distance_to(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
  const bool is_over = glm::dot(glm::cross(b - a, n), a) >= 0 && glm::dot(glm::cross(c - b, n), b) >= 0 &&
                       glm::dot(glm::cross(a - c, n), c) >= 0;
  if (is_over) return std::fabs(glm::dot(a, n));
  return std::min({distance_to_segment(a, b), distance_to_segment(b, c), distance_to_segment(c, a)});
}

class NearestMasks : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  // Every triangle's look-ups, where the receiver is within its reach.
  static OcclusionMask look_up_all(const Mesh& mesh, const PlaneMaskTable& table, const ReceiverRays& rays,
                                   float radius, Sidedness sidedness) {
    const bvh::TableLookup lookup(table, rays.frame, radius);
    const bvh::Node no_node = bvh::Node::empty();
    const bvh::Query query{{&no_node, 1}, rays, rays.cast, radius, sidedness, kNoPrimitive};
    OcclusionMask blocked;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      const glm::dvec3 origin(rays.origin);
      if (distance_to(glm::dvec3(a) - origin, glm::dvec3(b) - origin, glm::dvec3(c) - origin) > 1.0001 * radius)
        continue;
      if (bvh::is_culled(a, b, c, query)) continue;
      const bvh::TriangleTest test(a, b, c, rays.origin, radius, sidedness);
      if (!test.can_block()) continue;
      bvh::MaskBounds bounds{rays.cast, rays.cast};
      for (int edge = 0; edge < 3; ++edge) lookup.keep_beyond_edge(test.edge(edge), bounds);
      lookup.keep_beyond(test.normal(), test.distance(), bounds);
      blocked = blocked | bounds.must;
    }
    return blocked;
  }

  static std::vector<std::uint64_t> look_up_all(const Mesh& mesh, const PlaneMaskTable& table,
                                                const std::vector<PixelReceiver>& receivers,
                                                const RayOptions& options) {
    const query::PatternLanes lanes(table.pattern());
    std::vector<std::uint64_t> masks;
    for (const PixelReceiver& receiver : receivers) {
      OcclusionMask mask;
      if (receiver.is_valid) {
        mask = look_up_all(mesh, table, rays_of(receiver, lanes, options.radius), options.radius, options.sidedness);
      }
      masks.insert(masks.end(), mask.words, mask.words + table.pattern().word_count());
    }
    return masks;
  }
};

TEST_F(NearestMasks, AreTheCpusLookUps) {
  for (const PlaneAddressing addressing : {PlaneAddressing::slices, PlaneAddressing::cube}) {
    const PlaneMaskTable table(SamplePattern::standard(128), {64, addressing, PlaneMasks::nearest});
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
      PassOnMesh pass = make_pass(mesh_, table, {.precision = precision});
      const bool two_sided = addressing == PlaneAddressing::slices;
      const RayOptions options{.radius = 0.8f, .sidedness = sidedness_of(two_sided), .seed = 5};
      const auto masks = draw(pass, options);
      const auto expected = look_up_all(mesh_, table, pass.read_receivers(), options);
      // Where a plane lies on the border of two cells, rounding decides between them.
      const double share = share_of_equal_pixels(masks, expected, table.pattern().word_count());
      EXPECT_GE(share, precision == Precision::double_precision ? 0.9998 : 0.995);
      EXPECT_LE(count_differences(masks, expected), masks.size() * 64 / 10000);
      RecordProperty(precision == Precision::double_precision ? "equal_in_double" : "equal_in_float",
                     std::to_string(share));
    }
  }
}

TEST_F(NearestMasks, AreNearTheExactOnes) {
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 128, .masks = PlaneMasks::nearest});
  PassOnMesh pass = make_pass(mesh_, table);
  const RayOptions options{.radius = 0.8f};
  const auto masks = draw(pass, options);
  const auto exact = cpu_masks(mesh_, g_buffer_->receivers(), table.pattern(), options);
  double error = 0;
  std::size_t same_count = 0;
  for (std::size_t i = 0; i < masks.size(); i += 2) {
    const double seen = static_cast<double>(count_bits({masks[i], masks[i + 1]})) / 128;
    const double expected = static_cast<double>(count_bits({exact[i], exact[i + 1]})) / 128;
    error += std::fabs(seen - expected);
    same_count += std::lround(seen * 255) == std::lround(expected * 255);
  }
  const double pixel_count = static_cast<double>(masks.size()) / 2;
  // The paper (Sec. 6): most pixels are correct at 8 bits, and the mean error is about that of quantisation.
  EXPECT_GT(static_cast<double>(same_count) / pixel_count, 0.6);
  EXPECT_LT(error / pixel_count, 1.0 / 255);
  RecordProperty("same_at_8_bits", std::to_string(static_cast<double>(same_count) / pixel_count));
  RecordProperty("mean_error", std::to_string(error / pixel_count));

  // The CPU's query by the same table also drops nodes by nearest cells: alike, not the same.
  std::vector<std::uint64_t> query_masks(masks.size());
  AmbientOcclusion(OccluderBvh(mesh_.view()), table, options)
      .query(g_buffer_->receivers(), {.mask_words = query_masks});
  const auto difference = static_cast<double>(count_differences(masks, query_masks));
  EXPECT_LT(difference / static_cast<double>(masks.size() * 64), 2e-3);
  RecordProperty("unlike_the_query", std::to_string(difference / static_cast<double>(masks.size() * 64)));
}

}  // namespace
}  // namespace lkao::gl::tests::nearest_masks_test
