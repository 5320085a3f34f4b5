// Levels of detail in the pass: each triangle has a range of distances, and masks are those of the CPU's query.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <glm/vec2.hpp>

#include "gpu/in_furnished_room.h"
#include "lkao/lkao.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::levels_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(48, 32), kHeight = lkao::tests::unless_sanitized(36, 24);
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const std::vector<glm::vec2> kRanges = {{0, 0.3f}, {0.3f, 0.9f}, {0.9f, 1.0f}, {1.0f, kInfinity}};

// Several meshes, and a range of distances for each.
struct Levels {
  Mesh mesh;  // all of them
  std::vector<glm::vec2> ranges;
  std::vector<OccluderLevel> levels;

  void add(const Mesh& level, const glm::vec2& range) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), level.positions.begin(), level.positions.end());
    for (const glm::uvec3& t : level.triangles) mesh.triangles.push_back(t + first);
    ranges.insert(ranges.end(), level.triangles.size(), range);
    levels.push_back({OccluderBvh(level.view()), range.x, range.y});
  }

  std::vector<std::uint64_t> cpu_masks(const std::vector<Receiver>& receivers, const SamplePattern& pattern,
                                       const RayOptions& options) const {
    std::vector<std::uint64_t> masks(receivers.size() * static_cast<std::size_t>(pattern.word_count()));
    AmbientOcclusion(levels, pattern, options).query(receivers, {.mask_words = masks});
    return masks;
  }
};

PassOnMesh make_pass(const Levels& levels, const PlaneMaskTable& table, const MaskPassSetup& setup = {}) {
  PassOnMesh pass(setup);
  pass.occluders = Occluders(levels.mesh.positions, levels.mesh.triangles, levels.ranges);
  pass.set_table(table);
  return pass;
}

class LevelsInThePass : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  // The room near by; farther away without more and more of its triangles, or with others.
  Levels different_levels() const {
    Levels levels;
    for (std::size_t i = 0; i < kRanges.size(); ++i) {
      Mesh level = mesh_;
      level.triangles.resize(level.triangles.size() - 90 * i);
      for (glm::vec3& position : level.positions) position += 0.02f * static_cast<float>(i);
      levels.add(level, kRanges[i]);
    }
    return levels;
  }

  std::size_t ray_count(const SamplePattern& pattern) const {
    return std::size_t{kWidth} * kHeight * static_cast<std::size_t>(pattern.ray_count());
  }
};

TEST_F(LevelsInThePass, AreTheCpusBitForBitInDouble) {
  const Levels levels = different_levels();
  for (const Falloff& falloff : {Falloff::constant(), Falloff::linear()}) {
    const PlaneMaskTable table(SamplePattern::standard(128).with_falloff(falloff), {.resolution = 48});
    PassOnMesh pass = make_pass(levels, table, {.precision = Precision::double_precision});
    for (const float radius : {0.25f, 0.95f, 2.5f}) {
      const RayOptions options{.radius = radius, .seed = 5};
      const auto expected = levels.cpu_masks(g_buffer_->receivers(), table.pattern(), options);
      // A frame may differ in its last bit, where two doubles round to float differently.
      EXPECT_LE(count_differences(draw(pass, options), expected), 1u) << falloff.name() << ", radius " << radius;
      EXPECT_GT(count_bits(expected), 1000u);
    }
  }
}

// Where rays begin to count later, each range begins no earlier; whole rays and those of ranges.
TEST_F(LevelsInThePass, CountFromAMinDistanceOn) {
  Levels one;
  one.add(mesh_, {0, kInfinity});
  for (const Falloff& falloff : {Falloff::constant(), Falloff::linear()}) {
    const PlaneMaskTable table(SamplePattern::standard(100).with_falloff(falloff), {.resolution = 48});
    for (const bool has_ranges : {false, true}) {
      const Levels levels = has_ranges ? different_levels() : one;
      PassOnMesh pass = make_pass(levels, table, {.precision = Precision::double_precision});
      if (!has_ranges) pass.occluders = Occluders(one.mesh.positions, one.mesh.triangles);
      for (const float min_distance : {0.05f, 0.5f, 0.95f}) {
        const RayOptions options{.radius = 2.5f, .seed = 5, .min_distance = min_distance};
        const auto expected = levels.cpu_masks(g_buffer_->receivers(), table.pattern(), options);
        EXPECT_LE(count_differences(draw(pass, options), expected), 1u) << falloff.name() << ", " << min_distance;
        EXPECT_GT(count_bits(expected), 1000u);
      }
    }
  }
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(one, table);
  EXPECT_THROW(draw(pass, {.radius = 1, .min_distance = 1}), std::invalid_argument);
}

TEST_F(LevelsInThePass, AreTheCpusInFloat) {
  const Levels levels = different_levels();
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 64});
  for (const bool two_sided : {true, false}) {
    PassOnMesh pass = make_pass(levels, table);
    const RayOptions options{.radius = 2.5f, .sidedness = sidedness_of(two_sided)};
    const auto expected = levels.cpu_masks(g_buffer_->receivers(), table.pattern(), options);
    const std::uint64_t difference_count = count_differences(draw(pass, options), expected);
    EXPECT_LE(static_cast<double>(difference_count), 1e-4 * static_cast<double>(ray_count(table.pattern())));
    RecordProperty(two_sided ? "two_sided" : "one_sided", std::to_string(difference_count));
  }
}

// Nearest cells find r_min by a look-up as well, the paper's.
TEST_F(LevelsInThePass, AreNearTheCpusByNearestCells) {
  const Levels levels = different_levels();
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 128, .masks = PlaneMasks::nearest});
  PassOnMesh pass = make_pass(levels, table);
  const RayOptions options{.radius = 2.5f};
  const auto expected = levels.cpu_masks(g_buffer_->receivers(), table.pattern(), options);
  const std::uint64_t difference_count = count_differences(draw(pass, options), expected);
  EXPECT_LE(static_cast<double>(difference_count), 0.02 * static_cast<double>(ray_count(table.pattern())));
  RecordProperty("differing_rays", std::to_string(difference_count));
}

// Neither a seam nor a double count where one range ends and the next begins.
TEST_F(LevelsInThePass, OfTheSameTrianglesAreTheMasksOfNone) {
  Levels levels;
  for (const glm::vec2& range : kRanges) levels.add(mesh_, range);
  for (const Falloff& falloff : {Falloff::constant(), Falloff::linear()}) {
    const PlaneMaskTable table(SamplePattern::standard(128).with_falloff(falloff), {.resolution = 48});
    const MaskPassSetup setup{.precision = Precision::double_precision};
    PassOnMesh whole = lkao::gl::tests::make_pass(mesh_, table, setup), parts = make_pass(levels, table, setup);
    const RayOptions options{.radius = 2.5f};
    EXPECT_EQ(draw(parts, options), draw(whole, options)) << falloff.name();
  }
}

// All of this is decided by the fragments: no shape may lose one.
TEST_F(LevelsInThePass, AreTheSameForAllShapesAndBackEnds) {
  const Levels levels = different_levels();
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  std::vector<std::uint64_t> expected;
  for (const GeometryBackEnd geometry : {GeometryBackEnd::vertex_pulling, GeometryBackEnd::geometry_shader}) {
    for (const Accumulator accumulator : {Accumulator::logic_op, Accumulator::ssbo}) {
      PassOnMesh pass = make_pass(levels, table, {.geometry = geometry, .accumulator = accumulator});
      for (const float threshold : {0.0f, 0.2f, kInfinity}) {
        const auto masks = draw(pass, {.radius = 1.5f}, {.billboard_threshold = threshold});
        if (expected.empty()) expected = masks;
        EXPECT_EQ(masks, expected) << "threshold " << threshold;
      }
    }
  }
}

TEST_F(LevelsInThePass, RefuseWhatIsNoRange) {
  PassOnMesh pass;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const glm::vec2& range : {glm::vec2(1, 1), {2, 1}, {-1, 1}, {nan, 1}, {0, nan}}) {
    std::vector<glm::vec2> ranges(mesh_.triangles.size(), {0, 1});
    ranges[3] = range;
    EXPECT_THROW(pass.occluders = Occluders(mesh_.positions, mesh_.triangles, ranges), std::invalid_argument);
  }
  const std::vector<glm::vec2> too_few(mesh_.triangles.size() - 1, {0, 1});
  EXPECT_THROW(pass.occluders = Occluders(mesh_.positions, mesh_.triangles, too_few), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::gl::tests::levels_test
