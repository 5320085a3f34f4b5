// An infinite AO radius in the pass: rays beyond all occluders, and masks that are the CPU's.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/in_furnished_room.h"
#include "gpu/rounding.h"
#include "lkao/lkao.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::unbounded_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(32, 24);
constexpr int kHeight = lkao::tests::unless_sanitized(24, 18);
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class UnboundedPass : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  // In how many rays the pass and the CPU differ on a mesh, as a camera sees it; each within rounding.
  std::uint64_t difference_from_cpu(PassOnMesh& pass, const Mesh& mesh, const Camera& camera,
                                    const SamplePattern& pattern, const RayOptions& options) {
    const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
    pass.draw(g_buffer.by_positions(), camera, options);
    const std::vector<Receiver> receivers = g_buffer.receivers();
    const std::vector<std::uint64_t> masks = pass.read_masks(), expected = cpu_masks(mesh, receivers, pattern, options);
    EXPECT_GT(count_bits(expected), 1000u) << "the scene has too little occlusion to tell anything";
    EXPECT_EQ(count_unexplained(mesh.view(), masks, expected, receivers, pattern, options), 0u);
    const std::uint64_t count = count_differences(masks, expected);
    RecordProperty("differing_rays_" + std::to_string(record_count_++),
                   std::to_string(count) + " of " + std::to_string(masks.size() * 64));
    return count;
  }

  std::uint64_t largest_difference(const SamplePattern& pattern) const {
    return std::uint64_t{kWidth} * kHeight * static_cast<std::uint64_t>(pattern.ray_count()) / 10000;
  }

  int record_count_ = 0;
};

TEST_F(UnboundedPass, HasTheCpusMasksInFloat) {
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 64});
  PassOnMesh pass = make_pass(mesh_, table);
  for (const bool two_sided : {true, false}) {
    const RayOptions options{.radius = kInfinity,
                             .sidedness = sidedness_of(two_sided),
                             .jitter = {.tilt = two_sided ? 0.0f : 0.1f},
                             .seed = 3};
    EXPECT_LE(difference_from_cpu(pass, mesh_, camera_, table.pattern(), options), largest_difference(table.pattern()));
  }
}

TEST_F(UnboundedPass, HasTheCpusMasksBitForBitInDouble) {
  for (const PlaneAddressing addressing : {PlaneAddressing::slices, PlaneAddressing::cube}) {
    const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 48, .addressing = addressing});
    PassOnMesh pass = make_pass(mesh_, table, {.precision = Precision::double_precision});
    // A frame may differ in its last bit, where two doubles round to float differently.
    EXPECT_LE(difference_from_cpu(pass, mesh_, camera_, table.pattern(), {.radius = kInfinity}), 1u);
  }
}

TEST_F(UnboundedPass, SeesTheSceneFromAfarInAnyUnitAndProjection) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  for (const float scale : {1e-10f, 1.0f, 1e9f}) {
    const glm::vec3 move(3.0f, -20.0f, 7.0f);
    Mesh mesh = mesh_;
    for (glm::vec3& position : mesh.positions) position = scale * (position + move);
    PassOnMesh pass = make_pass(mesh, table);
    for (const float eye_distance : {0.0f, 40.0f}) {
      const glm::vec3 eye = scale * (glm::vec3(0.3f, 1.9f, 3.4f + eye_distance) + move),
                      target = scale * (glm::vec3(0, 1.3f, -1) + move);
      const float width = 2.5f * scale, far = (eye_distance + 10) * scale;
      for (const glm::mat4& projection :
           {glm::perspective(eye_distance > 0 ? 0.09f : 1.2f, 4.0f / 3, 0.05f * scale, far),
            glm::ortho(-width, width, -0.75f * width, 0.75f * width, 0.05f * scale, far)}) {
        SCOPED_TRACE(testing::Message() << scale << ", from " << eye_distance << ", w " << projection[2][3]);
        const Camera camera{glm::lookAt(eye, target, glm::vec3(0, 1, 0)), projection, ClipDepth::minus_one_to_one};
        EXPECT_LE(difference_from_cpu(pass, mesh, camera, table.pattern(), {.radius = kInfinity}),
                  largest_difference(table.pattern()));
      }
    }
  }
}

// All of this is decided by the fragments: no shape may lose one.
TEST_F(UnboundedPass, IsTheSameForAllShapesAndBackEnds) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  std::vector<std::uint64_t> expected;
  for (const GeometryBackEnd geometry : {GeometryBackEnd::vertex_pulling, GeometryBackEnd::geometry_shader}) {
    for (const Accumulator accumulator : {Accumulator::logic_op, Accumulator::ssbo}) {
      PassOnMesh pass = make_pass(mesh_, table, {.geometry = geometry, .accumulator = accumulator});
      for (const float threshold : {0.0f, kInfinity}) {
        const auto masks = draw(pass, {.radius = kInfinity}, {.billboard_threshold = threshold});
        if (expected.empty()) expected = masks;
        EXPECT_EQ(masks, expected) << "threshold " << threshold;
      }
    }
  }
}

TEST_F(UnboundedPass, NearestMasksAreNearTheExactOnes) {
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 128, .masks = PlaneMasks::nearest});
  PassOnMesh pass = make_pass(mesh_, table);
  const RayOptions options{.radius = kInfinity};
  const auto expected = cpu_masks(mesh_, g_buffer_->receivers(), table.pattern(), options);
  const std::uint64_t difference_count = count_differences(draw(pass, options), expected);
  EXPECT_LE(static_cast<double>(difference_count), 0.02 * kWidth * kHeight * 128);
  RecordProperty("differing_rays", std::to_string(difference_count));
}

TEST_F(UnboundedPass, KeepsRangesOfLevels) {
  const std::vector<glm::vec2> ranges = {{0, 0.3f}, {0.3f, 1.5f}, {1.5f, kInfinity}};
  Mesh all;
  std::vector<glm::vec2> triangle_ranges;
  std::vector<OccluderLevel> levels;
  for (const glm::vec2& range : ranges) {
    Mesh level = mesh_;
    for (glm::vec3& position : level.positions) position += 0.02f * static_cast<float>(levels.size());
    level.triangles.resize(level.triangles.size() - 90 * levels.size());
    const auto first = static_cast<unsigned>(all.positions.size());
    all.positions.insert(all.positions.end(), level.positions.begin(), level.positions.end());
    for (const glm::uvec3& t : level.triangles) all.triangles.push_back(t + first);
    triangle_ranges.insert(triangle_ranges.end(), level.triangles.size(), range);
    levels.push_back({OccluderBvh(level.view()), range.x, range.y});
  }
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass({.precision = Precision::double_precision});
  pass.occluders = Occluders(all.positions, all.triangles, triangle_ranges);
  pass.set_table(table);
  const RayOptions options{.radius = kInfinity};
  std::vector<std::uint64_t> expected(std::size_t{kWidth} * kHeight);
  AmbientOcclusion(levels, table.pattern(), options).query(g_buffer_->receivers(), {.mask_words = expected});
  EXPECT_LE(count_differences(draw(pass, options), expected), 1u);
}

TEST_F(UnboundedPass, FollowsAMeshThatMovesAndForgetsTheLastFrame) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  const std::vector<std::uint64_t> finite = draw(pass, {.radius = 0.8f}), unbounded = draw(pass, {.radius = kInfinity});
  EXPECT_NE(finite, unbounded);
  Mesh wide = mesh_;
  for (glm::vec3& position : wide.positions) position *= 1000.0f;
  pass.occluders.update_positions(wide.positions);
  draw(pass, {.radius = kInfinity});
  pass.occluders.update_positions(mesh_.positions);
  EXPECT_EQ(draw(pass, {.radius = kInfinity}), unbounded);
  EXPECT_EQ(draw(pass, {.radius = 0.8f}), finite);
}

TEST_F(UnboundedPass, NeedsNeitherOccludersNorReceivers) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh empty = make_pass({}, table), pass = make_pass(mesh_, table);
  EXPECT_EQ(count_bits(draw(empty, {.radius = kInfinity})), 0u);
  const Camera away{glm::lookAt(glm::vec3(0, 0, 100), glm::vec3(0, 0, 200), glm::vec3(0, 1, 0)), camera_.projection};
  const GBufferPass sky(mesh_, away, kWidth, kHeight);
  pass.draw(sky.by_depth(), away, {.radius = kInfinity});
  EXPECT_EQ(count_bits(pass.read_masks()), 0u);
}

TEST_F(UnboundedPass, RefusesTablesOfRaysOfSeveralLengths) {
  const PlaneMaskTable table(SamplePattern::standard(64).with_falloff(Falloff::linear()), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  EXPECT_THROW(draw(pass, {.radius = kInfinity}), std::invalid_argument);
  EXPECT_NO_THROW(draw(pass, {.radius = 1e6f}));
}

}  // namespace
}  // namespace lkao::gl::tests::unbounded_test
