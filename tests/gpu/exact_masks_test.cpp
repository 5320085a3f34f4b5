// With a must/may table the pass gives the CPU's masks: at the same receivers, for all rays but those within rounding.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "gpu/in_furnished_room.h"
#include "gpu/rounding.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::exact_masks_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(96, 48);
constexpr int kHeight = lkao::tests::unless_sanitized(72, 36);
constexpr double kLargestShare = 1e-4;

class ExactMasks : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  // Few differences from the CPU, and each explained.
  void expect_close(const std::vector<std::uint64_t>& masks, const std::vector<Receiver>& receivers,
                    const SamplePattern& pattern, const RayOptions& options) {
    const std::vector<std::uint64_t> expected = cpu_masks(mesh_, receivers, pattern, options);
    const std::uint64_t difference_count = count_differences(masks, expected), bit_count = count_bits(expected);
    const std::size_t ray_count = receivers.size() * static_cast<std::size_t>(pattern.ray_count());
    ASSERT_GT(bit_count, ray_count / 64 * 3) << "the scene has too little occlusion to tell anything";
    EXPECT_LE(static_cast<double>(difference_count), 1 + kLargestShare * static_cast<double>(ray_count));
    EXPECT_EQ(count_unexplained(mesh_.view(), masks, expected, receivers, pattern, options), 0u)
        << "of " << difference_count;
    RecordProperty("differing_rays_" + std::to_string(record_count_++),
                   std::to_string(difference_count) + " of " + std::to_string(ray_count));
  }

  int record_count_ = 0;
};

TEST_F(ExactMasks, AreTheCpusInFloat) {
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 64});
  PassOnMesh pass = make_pass(mesh_, table);
  for (const bool two_sided : {true, false}) {
    for (const float radius : {0.15f, 0.8f, 3.0f}) {
      SCOPED_TRACE(testing::Message() << "two-sided " << two_sided << ", radius " << radius);
      const RayOptions options{.radius = radius, .sidedness = sidedness_of(two_sided), .seed = 3};
      const std::vector<std::uint64_t> masks = draw(pass, options);
      if (radius < 0.5f) {
        // Too few rays are blocked for expect_close.
        const auto expected = cpu_masks(mesh_, g_buffer_->receivers(), table.pattern(), options);
        EXPECT_LE(count_differences(masks, expected), 25u);
        EXPECT_GT(count_bits(expected), 1000u);
        continue;
      }
      expect_close(masks, g_buffer_->receivers(), table.pattern(), options);
    }
  }
}

TEST_F(ExactMasks, AreTheCpusBitForBitInDouble) {
  for (const PlaneAddressing addressing : {PlaneAddressing::slices, PlaneAddressing::cube}) {
    const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 48, .addressing = addressing});
    PassOnMesh pass = make_pass(mesh_, table, {.precision = Precision::double_precision});
    const RayOptions options{.radius = 1.0f, .seed = 11};
    pass.draw(g_buffer_->by_positions(), camera_, options);
    const auto expected = cpu_masks(mesh_, g_buffer_->receivers(), table.pattern(), options);
    // A frame may differ in its last bit, where two doubles round to float differently.
    const std::uint64_t difference_count = count_differences(pass.read_masks(), expected);
    EXPECT_LE(difference_count, 1u);
    RecordProperty("differing_rays_in_double", std::to_string(difference_count));
  }
}

TEST_F(ExactMasks, FollowFalloffTiltAndGeometricNormals) {
  std::vector<Receiver> receivers = g_buffer_->receivers();
  std::vector<glm::vec4> bumpy;
  lut::RandomStream random(9);
  for (Receiver& receiver : receivers) {
    receiver.geometric_normal = receiver.normal;
    const float length = glm::length(receiver.normal);
    if (length > 0) receiver.normal += 0.9f * length * lkao::tests::random_direction(random);
    bumpy.emplace_back(receiver.normal, 0.0f);
  }
  const Texture shading_normals = make_image(GL_RGBA32F, kWidth, kHeight, &bumpy[0].x);
  GBuffer textures = g_buffer_->by_positions();
  textures.geometric_normals = textures.normals;
  textures.normals = shading_normals.name();

  const PlaneMaskTable table(SamplePattern::standard(128).with_falloff(Falloff::linear()), {.resolution = 64});
  PassOnMesh pass = make_pass(mesh_, table);
  const RayOptions options{.radius = 2.5f, .jitter = {0.25f, 0.1f}, .seed = 0x123456789abcdefu};
  pass.draw(textures, camera_, options);
  expect_close(pass.read_masks(), receivers, table.pattern(), options);
}

TEST_F(ExactMasks, OfUniformDirectionsAreTheCpusToo) {
  const PlaneMaskTable table(SamplePattern::standard(100, Weighting::uniform), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  const RayOptions options{.radius = 1.0f, .jitter = {.rotation = 1}};
  const std::vector<std::uint64_t> masks = draw(pass, options);
  expect_close(masks, g_buffer_->receivers(), table.pattern(), options);
}

TEST_F(ExactMasks, HaveFrom1To1024Rays) {
  const int width = lkao::tests::unless_sanitized(32, 24), height = lkao::tests::unless_sanitized(24, 18);
  const GBufferPass g_buffer(mesh_, camera_, width, height);
  for (const int ray_count : {1, 16, 64, 100, 129, 192, 511, 1024}) {
    SCOPED_TRACE(ray_count);
    const PlaneMaskTable table(SamplePattern::standard(ray_count), {.resolution = 32});
    for (const Accumulator accumulator : {Accumulator::logic_op, Accumulator::ssbo}) {
      PassOnMesh pass = make_pass(mesh_, table, {.accumulator = accumulator});
      const RayOptions options{.radius = 1.0f};
      pass.draw(g_buffer.by_positions(), camera_, options);
      expect_close(pass.read_masks(), g_buffer.receivers(), table.pattern(), options);
    }
  }
}

TEST_F(ExactMasks, StandOnTrianglesThatOverlapByThousands) {
  // All in one place, and all of them around the camera.
  mesh_ = lkao::tests::random_soup(4000, 0.4f, 17);
  for (glm::vec3& position : mesh_.positions) position = position * 0.5f + glm::vec3(0, 1.5f, 1.5f);
  lkao::tests::add_quad(mesh_, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
  const int width = 48, height = 36;
  const GBufferPass g_buffer(mesh_, camera_, width, height);
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table, {.count_fragments = true});
  const RayOptions options{.radius = 0.5f};
  pass.draw(g_buffer.by_positions(), camera_, options);
  EXPECT_GT(pass.read_fragment_counts().masks, 50u * width * height);
  expect_close(pass.read_masks(), g_buffer.receivers(), table.pattern(), options);
}

TEST_F(ExactMasks, IgnoreTrianglesThatBlockNothing) {
  const GBufferPass g_buffer(mesh_, camera_, 64, 48);
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  const RayOptions options{.radius = 1.0f};
  pass.draw(g_buffer.by_positions(), camera_, options);
  const std::vector<std::uint64_t> expected = pass.read_masks();

  Mesh with_bad = mesh_;
  const auto first = static_cast<unsigned>(mesh_.positions.size());
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  with_bad.positions.insert(
      with_bad.positions.end(),
      {{0, 1, 0}, {0, 1, 0}, {1, 1, 1}, {nan, 0, 0}, {0, infinity, 0}, {1e30f, 0, 0}, {-1, 1, -1}});
  for (const glm::uvec3& t : {glm::uvec3(0, 1, 2), {0, 2, 3}, {0, 2, 4}, {0, 2, 5}, {0, 2, 6}}) {
    with_bad.triangles.push_back(t + first);
  }
  pass.occluders = Occluders(with_bad.positions, with_bad.triangles);
  pass.draw(g_buffer.by_positions(), camera_, options);
  EXPECT_EQ(pass.read_masks(), expected);
}

}  // namespace
}  // namespace lkao::gl::tests::exact_masks_test
