#include "reference/embree_reference.h"

#include <cmath>

#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "meshes.h"

namespace lkao::reference {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Casting kBothCastings[] = {Casting::packets, Casting::single_rays};

RayOptions options_of(float radius, Sidedness sidedness = Sidedness::two_sided) {
  RayOptions options;
  options.radius = radius;
  options.sidedness = sidedness;
  return options;
}

// At the origin, looking up.
Receiver upright(std::uint32_t excluded_primitive = kNoPrimitive) {
  return {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, excluded_primitive};
}

AmbientOcclusion make_ao(const scene::Mesh& mesh, const RayOptions& options, int ray_count = 256) {
  return {OccluderBvh(mesh.view()), SamplePattern::standard(ray_count), options};
}

ReceiverOcclusion ask(const scene::Mesh& mesh, const RayOptions& options, const Receiver& receiver,
                      Casting casting = Casting::packets) {
  return EmbreeReference(mesh, {.casting = casting}).query(make_ao(mesh, options), receiver, 7);
}

TEST(EmbreeReference, NoTrianglesBlockNothing) {
  const ReceiverOcclusion result = ask({}, options_of(1), upright());
  EXPECT_EQ(result.occlusion, 0);
  EXPECT_FALSE(result.mask.any());
}

TEST(EmbreeReference, OpenPlaneBlocksNothing) {
  const scene::Mesh plane = ceiling(100, 0);
  for (const Casting casting : kBothCastings) {
    const ReceiverOcclusion result = ask(plane, options_of(50), upright(), casting);
    EXPECT_EQ(result.occlusion, 0);
    EXPECT_GT(result.bent_normal.z, 0.999f);
  }
}

TEST(EmbreeReference, ClosedBoxBlocksEverything) {
  const scene::Mesh box = closed_box(1);
  for (const Casting casting : kBothCastings) {
    const ReceiverOcclusion result = ask(box, options_of(10), {{0.3f, -0.2f, 0.1f}, {0, 3, 4}}, casting);
    EXPECT_EQ(result.occlusion, 1);
    EXPECT_EQ(result.mask.count(), 256);
    EXPECT_NEAR(glm::distance(result.bent_normal, {0, 0.6f, 0.8f}), 0, 1e-6);
  }
}

TEST(EmbreeReference, FootOfAWallSeesHalf) {
  scene::Mesh wall;
  add_quad(wall, {0.001f, -100, -100}, {0.001f, 100, -100}, {0.001f, 100, 100}, {0.001f, -100, 100});
  const ReceiverOcclusion result = ask(wall, options_of(10), upright());
  EXPECT_NEAR(result.occlusion, 0.5, 0.02);
  EXPECT_LT(result.bent_normal.x, -0.3f);
}

TEST(EmbreeReference, BlocksExactlyTheRaysThatReachACeiling) {
  const scene::Mesh mesh = ceiling(100, 0.75f);
  const AmbientOcclusion ao = make_ao(mesh, options_of(1), 1024);
  const ReceiverRays rays = ao.rays(upright(), 7);
  for (const Casting casting : kBothCastings) {
    const ReceiverOcclusion result = EmbreeReference(mesh, {.casting = casting}).query(ao, upright(), 7);
    int blocked_count = 0;
    for (int i = 0; i < rays.ray_count; ++i) {
      const double height = static_cast<double>(rays.origin.z) + static_cast<double>(rays.ray(i).z);
      if (std::abs(height - 0.75) < 1e-6) continue;  // within Embree's rounding
      EXPECT_EQ(result.mask.test(i), height > 0.75) << "ray " << i;
      blocked_count += height > 0.75 ? 1 : 0;
    }
    // z > 3/4 holds for 7/16 of cosine-weighted directions.
    EXPECT_NEAR(blocked_count / 1024.0, 7.0 / 16, 0.01);
  }
}

TEST(EmbreeReference, OneSidedTrianglesBlockReceiversInFrontOnly) {
  const scene::Mesh facing = ceiling(100, 1);
  scene::Mesh averted = facing;
  for (glm::uvec3& triangle : averted.triangles) std::swap(triangle.y, triangle.z);
  for (const Casting casting : kBothCastings) {
    const auto occlusion = [&](const scene::Mesh& mesh, Sidedness sidedness) {
      return ask(mesh, options_of(1.25f, sidedness), upright(), casting).occlusion;
    };
    const float expected = occlusion(facing, Sidedness::two_sided);
    EXPECT_GT(expected, 0.3f);
    EXPECT_EQ(occlusion(averted, Sidedness::two_sided), expected);
    EXPECT_EQ(occlusion(facing, Sidedness::one_sided), expected);
    EXPECT_EQ(occlusion(averted, Sidedness::one_sided), 0);
  }
}

TEST(EmbreeReference, OneSidedRaysGoOnBehindAnAvertedTriangle) {
  scene::Mesh mesh;
  const scene::Mesh facing = ceiling(100, 1);
  add_quad(mesh, {100, -100, 0.5f}, {100, 100, 0.5f}, {-100, 100, 0.5f}, {-100, -100, 0.5f});  // front upwards
  const RayOptions options = options_of(1.25f, Sidedness::one_sided);
  ASSERT_EQ(ask(mesh, options, upright()).occlusion, 0);
  scene::append(mesh, facing);
  EXPECT_EQ(ask(mesh, options, upright()).mask, ask(facing, options, upright()).mask);
}

TEST(EmbreeReference, ExcludedPrimitiveDoesNotBlock) {
  const scene::Mesh mesh = ceiling(100, 1);
  const RayOptions options = options_of(1.5f);
  for (const Casting casting : kBothCastings) {
    const OcclusionMask all = ask(mesh, options, upright(), casting).mask;
    const OcclusionMask without_0 = ask(mesh, options, upright(0), casting).mask;
    const OcclusionMask without_1 = ask(mesh, options, upright(1), casting).mask;
    EXPECT_EQ(ask(mesh, options, upright(2), casting).mask, all);
    EXPECT_EQ(without_0 | without_1, all);
    // The diagonal between the two runs over the receiver.
    EXPECT_NEAR(without_0.count(), all.count() / 2, 8);
    EXPECT_NEAR(without_1.count(), all.count() / 2, 8);
  }
}

TEST(EmbreeReference, BadTrianglesBlockNothingAndTakeNoNumbers) {
  scene::Mesh mesh;
  for (const float bad : {kNaN, kInfinity, -kInfinity}) {
    add_triangle(mesh, {bad, 0, 0.5f}, {1, 0, 0.5f}, {0, 1, 0.5f});
    add_triangle(mesh, {0, 0, 0.5f}, {1, bad, 0.5f}, {0, 1, bad});
  }
  add_triangle(mesh, {0, 0, 0.5f}, {0, 0, 0.5f}, {0, 0, 0.5f});    // a point
  add_triangle(mesh, {-1, 0, 0.5f}, {1, 0, 0.5f}, {1, 0, 0.5f});   // an edge
  add_triangle(mesh, {-1, -1, 0.5f}, {0, 0, 0.5f}, {2, 2, 0.5f});  // on a line
  EXPECT_EQ(ask(mesh, options_of(1.5f), upright()).occlusion, 0);

  const scene::Mesh good = ceiling(100, 1);
  scene::append(mesh, good);  // its triangles are 9 and 10 now
  const RayOptions options = options_of(1.5f);
  EXPECT_EQ(ask(mesh, options, upright()).mask, ask(good, options, upright()).mask);
  EXPECT_EQ(ask(mesh, options, upright(9)).mask, ask(good, options, upright(0)).mask);
  EXPECT_EQ(ask(mesh, options, upright(10)).mask, ask(good, options, upright(1)).mask);
  EXPECT_EQ(ask(mesh, options, upright(1)).mask, ask(good, options, upright()).mask);
}

TEST(EmbreeReference, RaysWithoutLengthAreNeverBlocked) {
  // The receiver lies in the middle of a triangle, and is not moved off it.
  scene::Mesh mesh;
  add_triangle(mesh, {-1, -1, 0}, {1, -1, 0}, {0, 2, 0});
  add_triangle(mesh, {0, -1, -1}, {0, 1, -1}, {0, 0, 2});
  std::vector<glm::vec2> points;
  for (const glm::vec2& point : SamplePattern::standard(64).disk()) points.push_back(point);
  const std::vector<float> lengths(points.size(), 0.0f);
  RayOptions options = options_of(1);
  options.surface_offset = 0;
  const AmbientOcclusion ao(OccluderBvh(mesh.view()), SamplePattern::from_disk(points, lengths), options);
  for (const Casting casting : kBothCastings) {
    const EmbreeReference reference(mesh, {.casting = casting});
    EXPECT_EQ(reference.query(ao, upright(), 0).occlusion, 0);
  }
}

TEST(EmbreeReference, InvalidReceiversAnswerNan) {
  const scene::Mesh box = closed_box(1);
  for (const Receiver& invalid : {Receiver{{kNaN, 0, 0}, {0, 0, 1}}, Receiver{{0, 0, 0}, {0, 0, 0}},
                                  Receiver{{0, 0, 0}, {0, kInfinity, 1}}, Receiver{{0, 0, 0}, {0, 0, 1}, {0, 0, -1}}}) {
    const ReceiverOcclusion result = ask(box, options_of(10), invalid);
    EXPECT_TRUE(std::isnan(result.occlusion));
    EXPECT_TRUE(std::isnan(result.bent_normal.x));
    EXPECT_FALSE(result.mask.any());
  }
}

TEST(EmbreeReference, IndexOutOfRangeIsNamed) {
  scene::Mesh mesh = ceiling(1, 1);
  mesh.triangles[1].y = 4;
  try {
    const EmbreeReference reference(mesh);
    FAIL() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "triangle 1 has index 4, but there are 4 positions");
  }
}

TEST(EmbreeReferenceBatch, AnswersAsSingleQueriesDo) {
  const scene::Mesh soup = random_soup(500, 0.2f, 1);
  std::vector<Receiver> receivers = random_receivers(300, 2);
  // All kinds among one another, so that the filtered scene is built in the middle of a parallel batch.
  for (std::size_t k = 0; k < receivers.size(); k += 3) receivers[k].excluded_primitive = static_cast<std::uint32_t>(k);
  receivers[17].normal = glm::vec3(0);
  const AmbientOcclusion ao = make_ao(soup, options_of(0.5f), 128);
  const EmbreeReference reference(soup);

  std::vector<float> occlusion(300);
  std::vector<glm::vec3> bent_normals(300);
  std::vector<std::uint64_t> mask_words(600);
  const QueryReport report = reference.query(ao, receivers, {occlusion, bent_normals, mask_words}, 40);

  std::uint64_t ray_count = 0;
  std::uint64_t blocked_count = 0;
  for (std::size_t k = 0; k < 300; ++k) {
    const ReceiverOcclusion expected = reference.query(ao, receivers[k], 40 + k);
    ray_count += static_cast<std::uint64_t>(ao.rays(receivers[k], 40 + k).cast.count());
    blocked_count += static_cast<std::uint64_t>(expected.mask.count());
    if (k == 17) {
      EXPECT_TRUE(std::isnan(occlusion[k]) && std::isnan(bent_normals[k].x));
    } else {
      EXPECT_EQ(occlusion[k], expected.occlusion) << k;
      EXPECT_EQ(bent_normals[k], expected.bent_normal) << k;
    }
    EXPECT_EQ(mask_words[2 * k], expected.mask.words[0]) << k;
    EXPECT_EQ(mask_words[2 * k + 1], expected.mask.words[1]) << k;
  }
  EXPECT_EQ(report.receiver_count, 300u);
  EXPECT_EQ(report.invalid_receiver_count, 1u);
  EXPECT_EQ(report.ray_count, ray_count);
  EXPECT_EQ(report.blocked_ray_count, blocked_count);
  EXPECT_GT(blocked_count, ray_count / 10);
  EXPECT_LT(blocked_count, ray_count / 10 * 9);
}

TEST(EmbreeReferenceBatch, OutputsOfTheWrongSizeAreRefused) {
  const scene::Mesh box = closed_box(1);
  const AmbientOcclusion ao = make_ao(box, options_of(1), 128);
  const EmbreeReference reference(box);
  const std::vector<Receiver> receivers(3, upright());
  std::vector<float> occlusion(4);
  std::vector<std::uint64_t> mask_words(5);
  EXPECT_NO_THROW(reference.query(ao, receivers, {}));
  EXPECT_THROW(reference.query(ao, receivers, {occlusion, {}, {}}), std::invalid_argument);
  EXPECT_THROW(reference.query(ao, receivers, {{}, {}, mask_words}), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::reference
