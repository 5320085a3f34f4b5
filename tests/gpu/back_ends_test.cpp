// Whatever way a pass takes, the masks are the same.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "gpu/in_furnished_room.h"
#include "gpu/masks/logic_op_check.h"
#include "gpu/masks/mask_pass_state.h"
#include "gpu/mesh/geometry_check.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::back_ends_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(48, 32);
constexpr int kHeight = lkao::tests::unless_sanitized(36, 24);

using BackEnds = InFurnishedRoom<kWidth, kHeight>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST_F(BackEnds, AllCombinationsGiveTheSameMasks) {
  for (const PlaneMasks masks : {PlaneMasks::nearest, PlaneMasks::must_may}) {
    const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 48, .masks = masks});
    std::vector<std::uint64_t> first[2];
    for (const GeometryBackEnd geometry : {GeometryBackEnd::vertex_pulling, GeometryBackEnd::geometry_shader}) {
      for (const Accumulator accumulator : {Accumulator::logic_op, Accumulator::ssbo}) {
        PassOnMesh pass = make_pass(mesh_, table, {.geometry = geometry, .accumulator = accumulator});
        EXPECT_EQ(pass.geometry(), geometry);
        EXPECT_EQ(pass.accumulator(), accumulator);
        for (const bool two_sided : {false, true}) {
          const auto result = draw(pass, {.radius = 0.8f, .sidedness = sidedness_of(two_sided)});
          if (first[two_sided].empty()) first[two_sided] = result;
          EXPECT_EQ(count_differences(result, first[two_sided]), 0u);
        }
      }
    }
    EXPECT_GT(count_bits(first[0]), 8u * kWidth * kHeight);
    EXPECT_GT(count_bits(first[1]), count_bits(first[0])) << "two-sided triangles block more";
  }
}

TEST_F(BackEnds, ShapesOnlyBoundTheInfluence) {
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 48, .masks = PlaneMasks::nearest});
  for (const GeometryBackEnd geometry : {GeometryBackEnd::vertex_pulling, GeometryBackEnd::geometry_shader}) {
    PassOnMesh pass = make_pass(mesh_, table, {.geometry = geometry, .count_fragments = true});
    for (const bool two_sided : {false, true}) {
      for (const float radius : {0.02f, 0.3f, 1.5f}) {
        SCOPED_TRACE(testing::Message() << "two-sided " << two_sided << ", radius " << radius);
        const auto prisms =
            draw(pass, {.radius = radius, .sidedness = sidedness_of(two_sided)}, {.billboard_threshold = 0});
        const auto prism_fragments = pass.read_fragment_counts();
        const auto mixed = draw(pass, {.radius = radius, .sidedness = sidedness_of(two_sided)});
        const auto billboards =
            draw(pass, {.radius = radius, .sidedness = sidedness_of(two_sided)}, {.billboard_threshold = kInfinity});
        const auto billboard_fragments = pass.read_fragment_counts();
        EXPECT_EQ(count_differences(prisms, mixed), 0u);
        EXPECT_EQ(count_differences(prisms, billboards), 0u);
        EXPECT_NE(prism_fragments.drawn, billboard_fragments.drawn) << "the threshold changes nothing";
        EXPECT_EQ(prism_fragments.masks, billboard_fragments.masks);
      }
    }
  }
}

TEST_F(BackEnds, ShapesMayHaveMarginsAsLargeAsTheRadius) {
  // A far corner and a large surface offset: rounding may take as much as the radius. Small triangles near the eye.
  Mesh mesh = lkao::tests::random_soup(300, 0.1f, 3);
  for (glm::vec3& position : mesh.positions) position = 0.3f * position + glm::vec3(0.25f, 1.85f, 3.1f);
  const auto first = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{1000, 0, 0}, {1000, 1, 0}, {1000, 0, 1}});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  const GBufferPass g_buffer(mesh, camera_, kWidth, kHeight);
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 48, .masks = PlaneMasks::nearest});
  PassOnMesh pass = make_pass(mesh, table);
  std::vector<std::uint64_t> masks[2];
  for (const bool two_sided : {false, true}) {
    for (const float threshold : {0.0f, kInfinity}) {
      pass.draw(g_buffer.by_positions(), camera_,
                {.radius = 0.1f, .sidedness = sidedness_of(two_sided), .surface_offset = 1000.0f},
                {.billboard_threshold = threshold});
      masks[threshold > 0] = pass.read_masks();
    }
    EXPECT_GT(count_bits(masks[0]), kWidth * kHeight / 12u);
    EXPECT_EQ(count_differences(masks[0], masks[1]), 0u) << "two-sided " << two_sided;
  }
}

TEST_F(BackEnds, CullsSaveWorkAndChangeNothing) {
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 48, .masks = PlaneMasks::nearest});
  PassOnMesh pass = make_pass(mesh_, table, {.count_fragments = true});
  for (const bool two_sided : {false, true}) {
    Culls culls{false, false, false, false, false};
    const RayOptions options{.radius = 0.6f, .sidedness = sidedness_of(two_sided)};
    const auto expected = draw(pass, options, {.culls = culls});
    FragmentCounts before = pass.read_fragment_counts();
    EXPECT_EQ(before.survivors, before.drawn);
    // One more each time, in the paper's order.
    for (bool Culls::*cull :
         {&Culls::far_depth, &Culls::bounding_sphere, &Culls::facing, &Culls::plane_distance, &Culls::horizon}) {
      culls.*cull = true;
      const auto masks = draw(pass, options, {.culls = culls});
      // Nearest cells also see rays that the horizon cuts off; in exact masks there are none.
      const bool is_exact = !culls.horizon;
      EXPECT_LE(count_differences(masks, expected), is_exact ? 0u : count_bits(expected) / 100);
      const FragmentCounts counts = pass.read_fragment_counts();
      EXPECT_EQ(counts.drawn, before.drawn);
      const bool does_nothing = cull == &Culls::facing && two_sided;
      EXPECT_EQ(counts.survivors < before.survivors, !does_nothing);
      before = counts;
    }
    EXPECT_LT(3 * before.survivors, before.drawn) << "all five together cut the masks by several times";
  }
}

TEST_F(BackEnds, CullsChangeNoExactMask) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 48});
  PassOnMesh pass = make_pass(mesh_, table);
  for (const bool two_sided : {false, true}) {
    const auto with = draw(pass, {.radius = 0.6f, .sidedness = sidedness_of(two_sided)});
    const auto without = draw(pass, {.radius = 0.6f, .sidedness = sidedness_of(two_sided)},
                              {.culls = {false, false, false, false, false, false}});
    EXPECT_EQ(count_differences(with, without), 0u);
  }
}

TEST_F(BackEnds, DriverChecksPassHere) {
  const StateKeeper keeper(kDrawUse);
  EXPECT_TRUE(logic_op_works());
  EXPECT_TRUE(geometry_works(GeometryBackEnd::vertex_pulling));
  EXPECT_TRUE(geometry_works(GeometryBackEnd::geometry_shader));
  EXPECT_EQ(choose(Accumulator::automatic), Accumulator::logic_op);
  EXPECT_EQ(choose(Accumulator::ssbo), Accumulator::ssbo);
  EXPECT_EQ(choose(GeometryBackEnd::automatic), GeometryBackEnd::vertex_pulling);
}

TEST_F(BackEnds, MovingMeshesAreDrawnWhereTheyAre) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  const auto before = draw(pass, {.radius = 0.8f});
  Mesh moved = mesh_;
  for (std::size_t i = 24; i < moved.positions.size(); ++i) moved.positions[i] += glm::vec3(0.2f, 0.1f, 0.3f);
  pass.occluders.update_positions(moved.positions);
  const auto after = draw(pass, {.radius = 0.8f});
  EXPECT_GT(count_differences(before, after), kWidth * kHeight / 12u);
  PassOnMesh fresh = make_pass(moved, table);
  EXPECT_EQ(count_differences(draw(fresh, {.radius = 0.8f}), after), 0u);
  // By the GPU, and back.
  glNamedBufferSubData(pass.occluders.positions_buffer(), 0,
                       static_cast<GLsizeiptr>(mesh_.positions.size() * sizeof(glm::vec3)), mesh_.positions.data());
  EXPECT_EQ(count_differences(draw(pass, {.radius = 0.8f}), before), 0u);
}

}  // namespace
}  // namespace lkao::gl::tests::back_ends_test
