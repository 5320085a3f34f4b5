// Triangles with holes.
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/brute_force.h"
#include "support/instances.h"
#include "support/kernel_choice.h"
#include "support/receivers.h"
#include "support/sanitized.h"

namespace lkao {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::Mesh;

class CutOutTriangles : public tests::OnEveryKernel {
 protected:
  AmbientOcclusion ask(const OccluderScene& scene, const RayOptions& options, int ray_count = 128) const {
    return AmbientOcclusion(scene, SamplePattern::standard(ray_count), options, GetParam().kernel);
  }
};

INSTANTIATE_TEST_SUITE_P(Kernels, CutOutTriangles, testing::ValuesIn(tests::all_kernels()), tests::name_of_choice);

std::vector<float> opacities(std::size_t count, float first, float others) {
  std::vector<float> values(count, others);
  for (std::size_t i = 0; i < count; i += 2) values[i] = first;
  return values;
}

// A wide wall over receivers on the floor: half the rays that meet it go through.
TEST_P(CutOutTriangles, BlockTheirShareOfRays) {
  Mesh wall;
  tests::add_quad(wall, {-1000, -1000, 0.1f}, {2000, 0, 0}, {0, 2000, 0});
  const CutOuts holes{.opacities = {0.3f, 0.3f}};
  const AmbientOcclusion ao = ask(OccluderBvh(wall.view(), {.cut_outs = holes}), {.radius = 1e4f});
  double sum = 0;
  constexpr int kCount = 400;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    sum += double{ao.query({.position = {0.01f * static_cast<float>(i), 0, 0}, .normal = {0, 0, 1}}, i).occlusion};
  }
  // The standard error is 0.002.
  EXPECT_NEAR(sum / kCount, 0.3, 0.008);
}

TEST_P(CutOutTriangles, HaveTheSameHolesOnEveryKernel) {
  const Mesh mesh = tests::random_soup(400, 0.4f, 11);
  const OccluderBvh occluders(mesh.view(), {.cut_outs = {.opacities = opacities(400, 0.5f, 1)}});
  const OccluderScene scene(
      {occluders}, std::vector<OccluderInstance>{{}, {0, tests::transform(glm::mat3(-0.7f), {0.3f, 0.2f, 0})}});
  const RayOptions options{.radius = 0.8f, .seed = 5, .min_distance = 0.02f};
  const std::vector<Receiver> receivers = tests::random_receivers(40, 1, 12);
  for (const OccluderScene& some : {OccluderScene(occluders), scene}) {
    const AmbientOcclusion ao = ask(some, options), definition(some, ao.pattern(), options, Kernel::scalar);
    for (std::uint64_t i = 0; i < receivers.size(); ++i) {
      ASSERT_EQ(ao.blocked(receivers[i], i), definition.blocked(receivers[i], i)) << i;
    }
  }
}

TEST_P(CutOutTriangles, AreWholeAtOpacityOneAndGoneAtZero) {
  const Mesh mesh = tests::random_soup(300, 0.4f, 13);
  Mesh odd = mesh;
  odd.triangles.clear();
  for (std::size_t i = 1; i < mesh.triangles.size(); i += 2) odd.triangles.push_back(mesh.triangles[i]);
  const RayOptions options{.radius = 0.8f, .surface_offset = 0};
  const AmbientOcclusion plain = ask(OccluderBvh(mesh.view()), options), half = ask(OccluderBvh(odd.view()), options),
                         ones = ask(OccluderBvh(mesh.view(), {.cut_outs = {std::vector<float>(300, 1)}}), options),
                         zeros = ask(OccluderBvh(mesh.view(), {.cut_outs = {opacities(300, 0, 1)}}), options);
  const std::vector<Receiver> receivers = tests::random_receivers(40, 1, 14);
  for (std::uint64_t i = 0; i < receivers.size(); ++i) {
    ASSERT_EQ(ones.blocked(receivers[i], i), plain.blocked(receivers[i], i)) << i;
    ASSERT_EQ(zeros.blocked(receivers[i], i), half.blocked(receivers[i], i)) << i;
  }
}

// The corner that is left when all beyond half the way to the others is cut off is a triangle of its own.
TEST_P(CutOutTriangles, AskTheirFilterAtTheRightPlace) {
  const Mesh mesh = tests::random_soup(200, 0.6f, 15);
  Mesh corners;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const auto first = static_cast<unsigned>(corners.positions.size());
    corners.positions.insert(corners.positions.end(), {a, 0.5f * (a + b), a + 0.25f * (c - a)});
    corners.triangles.emplace_back(first, first + 1, first + 2);
  }
  const auto blocks = [](std::uint32_t, std::uint32_t, float u, float v) { return u / 0.5f + v / 0.25f <= 1; };
  const OccluderBvh filtered(mesh.view(), {.cut_outs = {.blocks = blocks}}), cut(corners.view());
  const std::vector<Receiver> receivers = tests::random_receivers(60, 1, 16);
  for (const float mirror : {1.0f, -1.0f}) {
    const auto in_place = [mirror](const OccluderBvh& of) {
      return OccluderScene({of}, std::vector<OccluderInstance>{
                                     {0, tests::transform(glm::mat3({mirror, 0, 0}, {0, 1, 0.2f}, {0, 0, 1}), {})}});
    };
    const RayOptions options{.radius = 1, .surface_offset = 0};
    const AmbientOcclusion a = ask(in_place(filtered), options), b = ask(in_place(cut), options);
    int blocked_count = 0, mismatched_count = 0;
    for (std::uint64_t i = 0; i < receivers.size(); ++i) {
      const OcclusionMask with_filter = a.blocked(receivers[i], i), as_mesh = b.blocked(receivers[i], i);
      blocked_count += as_mesh.count();
      mismatched_count += ((with_filter & ~as_mesh) | (as_mesh & ~with_filter)).count();
    }
    EXPECT_GT(blocked_count, 500);
    // Rounding of the corners.
    EXPECT_LE(mismatched_count, 1);
  }
}

// With opacities, only triangles below 1 are asked about; and the instance is the right one.
TEST_P(CutOutTriangles, AskTheirFilterOnlyWhereTheyHaveHoles) {
  const Mesh mesh = tests::random_soup(300, 0.4f, 17);
  const auto blocks = [](std::uint32_t instance, std::uint32_t primitive, float, float) {
    EXPECT_EQ(primitive % 2, 0u);
    return instance == 1;
  };
  const OccluderBvh filtered(mesh.view(), {.cut_outs = {opacities(300, 0.5f, 1), blocks}});
  const OccluderBvh plain(mesh.view()), half(mesh.view(), {.cut_outs = {opacities(300, 0, 1)}});
  const std::vector<OccluderInstance> instances{{0, glm::mat4x3(1)}, {1, tests::transform(glm::mat3(1), {5, 0, 0})}};
  std::vector<OccluderInstance> of_one = instances;
  of_one[1].mesh = 0;
  const RayOptions options{.radius = 0.8f};
  const AmbientOcclusion ao = ask(OccluderScene({filtered}, of_one), options),
                         expected = ask(OccluderScene({half, plain}, instances), options);
  std::vector<Receiver> receivers = tests::random_receivers(60, 1, 18);
  for (std::uint64_t i = 0; i < receivers.size(); ++i) {
    if (i % 2 == 1) receivers[i].position.x += 5;
    ASSERT_EQ(ao.blocked(receivers[i], i), expected.blocked(receivers[i], i)) << i;
  }
}

// Fields of 8 x 16, there and not there in turn; and a survey that is right to the last float, with fields of the
// opposite kind side by side: a ray that is taken for one next door gets the wrong answer.
bool is_dark(std::uint32_t primitive, float u, float v) {
  return (static_cast<int>(8 * u) + static_cast<int>(16 * v) + static_cast<int>(primitive)) % 2 != 0;
}

CutOutPart survey_fields(std::uint32_t primitive, float u0, float v0, float size) {
  if (size > 1.0f / 16) return CutOutPart::mixed;
  return is_dark(primitive, u0, v0) ? CutOutPart::opaque : CutOutPart::clear;
}

TEST_P(CutOutTriangles, AreTheSameWithASurvey) {
  lut::RandomStream random(23);
  std::atomic<int> asked_count = 0;
  const auto blocks = [&](std::uint32_t, std::uint32_t primitive, float u, float v) {
    ++asked_count;
    return is_dark(primitive, u, v);
  };
  // Large ones near by, small ones, and some far from where they count, which floats put elsewhere.
  const glm::mat4x3 far = tests::random_transform(random, glm::vec3(1, -2, 0.5f), {500, -300, 400});
  const struct {
    float size;
    glm::mat4x3 to_world;
  } cases[] = {{0.5f, glm::mat4x3(1)}, {0.05f, glm::mat4x3(1)}, {0.5f, far}};
  for (const auto& [size, to_world] : cases) {
    const Mesh mesh = tests::random_soup(600, size, 24);
    const auto scene_of = [&, place = to_world](const CutOuts& cut_outs) {
      return OccluderScene({OccluderBvh(mesh.view(), {.cut_outs = cut_outs})},
                           std::vector<OccluderInstance>{{0, place}});
    };
    const RayOptions options{.radius = 2, .surface_offset = 0, .min_distance = size < 0.1f ? 0.0f : 0.1f};
    const AmbientOcclusion ao = ask(scene_of({.blocks = blocks, .survey = survey_fields}), options, 512),
                           definition(scene_of({.blocks = blocks}), ao.pattern(), options, Kernel::scalar);
    std::vector<Receiver> receivers = tests::random_receivers(tests::unless_sanitized(30, 5), 1, 25);
    for (Receiver& receiver : receivers) receiver.position = tests::placed(to_world, receiver.position);
    int blocked_count = 0, asked_with_survey = 0;
    for (std::uint64_t i = 0; i < receivers.size(); ++i) {
      asked_count = 0;
      const OcclusionMask blocked = ao.blocked(receivers[i], i);
      asked_with_survey += asked_count;
      ASSERT_EQ(blocked, definition.blocked(receivers[i], i)) << size << ": " << i;
      blocked_count += blocked.count();
    }
    EXPECT_GT(blocked_count, tests::unless_sanitized(100, 20)) << size;
    EXPECT_LT(asked_with_survey, blocked_count / 10) << size;
  }
}

// Few rays of each receiver meet an instance there, which neighbours take together where meshes have no holes.
TEST_P(CutOutTriangles, HaveThemInABatchSeenFromAfar) {
  lut::RandomStream random(31);
  const auto blocks = [](std::uint32_t, std::uint32_t primitive, float u, float v) { return is_dark(primitive, u, v); };
  const Mesh mesh = tests::random_soup(60, 0.9f, 32);
  const OccluderBvh thinned(mesh.view(), {.cut_outs = {.opacities = opacities(60, 0.5f, 1)}}),
      filtered(mesh.view(), {.cut_outs = {.blocks = blocks, .survey = survey_fields}}), whole(mesh.view());
  std::vector<OccluderInstance> instances;
  for (std::uint32_t i = 0; i < 24; ++i) {
    const glm::vec3 place = 4.0f * tests::random_point(random, 1);
    instances.push_back(
        {i % 3, tests::random_transform(random, glm::vec3(i % 2 == 0 ? 0.4f : -0.4f, 0.4f, 0.5f), place)});
  }
  const AmbientOcclusion ao = ask(OccluderScene({thinned, filtered, whole}, instances), {.radius = 6}, 64);
  const std::vector<Receiver> receivers = tests::random_receivers(tests::unless_sanitized(70, 20), 0.5f, 33);
  std::vector<std::uint64_t> masks(receivers.size());
  const QueryReport report = ao.query(receivers, {.mask_words = masks});
  EXPECT_GT(report.blocked_ray_count, 100u);
  for (std::uint64_t i = 0; i < receivers.size(); ++i) {
    ASSERT_EQ(masks[i], ao.blocked(receivers[i], i).words[0]) << "receiver " << i;
  }
}

TEST_P(CutOutTriangles, LetTheirFilterThrow) {
  const Mesh mesh = tests::closed_box();
  const auto blocks = [](std::uint32_t, std::uint32_t, float, float) -> bool { throw std::length_error("no texture"); };
  const AmbientOcclusion ao = ask(OccluderBvh(mesh.view(), {.cut_outs = {.blocks = blocks}}), {.radius = 5});
  const std::vector<Receiver> receivers(100, {.normal = {0, 0, 1}});
  std::vector<float> occlusion(receivers.size());
  EXPECT_THROW(ao.query(receivers[0], 0), std::length_error);
  EXPECT_THROW(ao.query(receivers, {.occlusion = occlusion}), std::length_error);
}

TEST(CutOuts, DifferFromReceiverToReceiver) {
  Mesh wall;
  tests::add_quad(wall, {-100, -100, 0.1f}, {200, 0, 0}, {0, 200, 0});
  const OccluderBvh occluders(wall.view(), {.cut_outs = {{0.5f, 0.5f}}});
  const RayOptions options{.radius = 1e3f, .jitter = {.rotation = 0}, .seed = 1};
  const AmbientOcclusion ao(occluders, SamplePattern::standard(128), options);
  const Receiver receiver{.normal = {0, 0, 1}};
  EXPECT_EQ(ao.blocked(receiver, 3), ao.blocked(receiver, 3));
  EXPECT_NE(ao.blocked(receiver, 3), ao.blocked(receiver, 4));
  RayOptions other = options;
  other.seed = 2;
  EXPECT_NE(AmbientOcclusion(occluders, ao.pattern(), other).blocked(receiver, 3), ao.blocked(receiver, 3));
}

TEST(CutOuts, ByTableAreTheSame) {
  const Mesh mesh = tests::random_soup(400, 0.4f, 19);
  const OccluderBvh occluders(mesh.view(), {.cut_outs = {.opacities = opacities(400, 0.5f, 1)}});
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32, .masks = PlaneMasks::must_may});
  const RayOptions options{.radius = 0.8f};
  const AmbientOcclusion by_table(occluders, table, options), ao(occluders, table.pattern(), options);
  const std::vector<Receiver> receivers = tests::random_receivers(40, 1, 20);
  for (std::uint64_t i = 0; i < receivers.size(); ++i) {
    ASSERT_EQ(by_table.blocked(receivers[i], i), ao.blocked(receivers[i], i)) << i;
  }
}

TEST(CutOuts, StayAtRefits) {
  const Mesh mesh = tests::random_soup(200, 0.4f, 21);
  Mesh moved = mesh;
  for (glm::vec3& position : moved.positions) position = 1.1f * position + glm::vec3(0.1f, 0, 0);
  const BuildOptions options{.cut_outs = {.opacities = opacities(200, 0.5f, 1)}};
  const AmbientOcclusion refitted(OccluderBvh(mesh.view(), options).refitted(moved.positions),
                                  SamplePattern::standard(64), {.radius = 1}),
      built(OccluderBvh(moved.view(), options), SamplePattern::standard(64), {.radius = 1});
  const std::vector<Receiver> receivers = tests::random_receivers(40, 1, 22);
  for (std::uint64_t i = 0; i < receivers.size(); ++i) {
    ASSERT_EQ(refitted.blocked(receivers[i], i), built.blocked(receivers[i], i)) << i;
  }
}

TEST(CutOuts, OfWrongNumberOrRangeAreRefused) {
  const Mesh mesh = tests::closed_box();
  const auto built = [&](std::vector<float> values) {
    return [&mesh, values] { OccluderBvh(mesh.view(), {.cut_outs = {.opacities = values}}); };
  };
  using Wrong = std::invalid_argument;
  EXPECT_THAT(built(std::vector<float>(11, 1)),
              ThrowsMessage<Wrong>(HasSubstr("one for each of 12 triangles, not 11")));
  std::vector<float> values(12, 0.5f);
  values[7] = 1.5f;
  EXPECT_THAT(built(values), ThrowsMessage<Wrong>(HasSubstr("cut_outs.opacities[7] must be from 0 to 1, not 1.5")));
  EXPECT_THAT(
      [&] {
        OccluderBvh(mesh.view(), {.cut_outs = {.looks = {1, 2}}});
      },
      ThrowsMessage<Wrong>(HasSubstr("cut_outs.looks must be none or one for each of 12 triangles, not 2")));
  EXPECT_THAT([&] { OccluderBvh(mesh.view(), {.cut_outs = {.survey = survey_fields}}); },
              ThrowsMessage<Wrong>(HasSubstr("cut_outs.survey must be empty without cut_outs.blocks")));
  values[7] = std::nanf("");
  EXPECT_THAT(built(values), ThrowsMessage<Wrong>(HasSubstr("cut_outs.opacities[7]")));
}

}  // namespace
}  // namespace lkao
