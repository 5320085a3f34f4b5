// Receivers as the pass makes them: those of the CPU's query.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/on_software.h"
#include "gpu/pass_scene.h"

namespace lkao::gl::tests::receivers_in_glsl_test {
namespace {

constexpr int kSize = 128;

class ReceiversInGlsl : public OnSoftware {
 protected:
  struct Images {
    std::vector<Receiver> receivers;
    Texture positions, normals, geometric_normals;
    GBuffer g_buffer() const {
      return {.width = kSize,
              .height = kSize,
              .positions = positions.name(),
              .normals = normals.name(),
              .geometric_normals = geometric_normals.name()};
    }
  };

  // Random places and normals of all lengths; every tenth along an axis.
  static Images random_images() {
    Images images;
    lut::RandomStream random(4);
    std::vector<glm::vec4> positions, normals, geometric_normals;
    for (int i = 0; i < kSize * kSize; ++i) {
      Receiver receiver;
      receiver.position = lkao::tests::random_point(random, 3.0f);
      receiver.normal = lkao::tests::random_direction(random) * std::exp(lkao::tests::uniform(random, -20, 20));
      if (i % 10 == 0) {
        receiver.normal = glm::vec3(i % 40 == 0 ? -0.0f : 0.0f);
        receiver.normal[i / 10 % 3] = i % 20 == 0 ? 1.0f : -1.0f;
      }
      if (i % 2 == 0) receiver.geometric_normal = receiver.normal + 0.3f * glm::length(receiver.normal);
      positions.emplace_back(receiver.position, 1);
      normals.emplace_back(receiver.normal, 0);
      geometric_normals.emplace_back(receiver.geometric_normal, 0);
      images.receivers.push_back(receiver);
    }
    images.positions = make_image(GL_RGBA32F, kSize, kSize, &positions[0].x);
    images.normals = make_image(GL_RGBA32F, kSize, kSize, &normals[0].x);
    images.geometric_normals = make_image(GL_RGBA32F, kSize, kSize, &geometric_normals[0].x);
    return images;
  }
};

float largest_difference(const glm::mat3& a, const glm::mat3& b) {
  float largest = 0;
  for (int column = 0; column < 3; ++column) {
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::fabs(a[column][i] - b[column][i]));
  }
  return largest;
}

TEST_F(ReceiversInGlsl, HaveTheJitterOfTheQuery) {
  const Images images = random_images();
  const Mesh mesh = furnished_room();
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32, .masks = PlaneMasks::nearest});
  // Positions are anywhere but at their pixels.
  PassOnMesh pass = make_pass(mesh, table, {.check_g_buffer = false});
  for (const RayOptions& options :
       {RayOptions{.radius = 0.1f}, RayOptions{.radius = 0.1f, .seed = 0xfedcba9876543210u},
        RayOptions{.radius = 0.1f, .jitter = {0.125f, 0.03f}, .seed = 77, .surface_offset = 3.7f},
        RayOptions{.radius = 0.1f, .jitter = {.rotation = 0}}}) {
    pass.draw(images.g_buffer(), room_camera(kSize, kSize), options);
    const std::vector<PixelReceiver> seen = pass.read_receivers();
    const AmbientOcclusion ao(OccluderBvh(mesh.view()), table.pattern(), options);
    std::size_t other_frame_count = 0, other_origin_count = 0;
    float largest = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      ASSERT_TRUE(seen[i].is_valid);
      const ReceiverRays rays = ao.rays(images.receivers[i], i);
      other_frame_count += seen[i].frame != rays.frame;
      other_origin_count += seen[i].origin != rays.origin;
      largest = std::max(largest, largest_difference(seen[i].frame, rays.frame));
    }
    // Two doubles that differ in the last bit may round to different floats.
    EXPECT_LE(other_frame_count, 2u);
    EXPECT_LE(other_origin_count, 2u);
    EXPECT_LE(largest, 1.2e-7f);
  }
}

TEST_F(ReceiversInGlsl, AreMissingWhereNothingIsShown) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const glm::vec4 positions[] = {{0, 1, 0, 1}, {nan, 1, 0, 1}, {0, infinity, 0, 1}, {0, 1, 2e18f, 1},
                                 {0, 1, 0, 1}, {0, 1, 0, 1},   {0, 1, 0, 1},        {0, 1, 0, 1}};
  const glm::vec4 normals[] = {{0, 1, 0, 0}, {0, 1, 0, 0},   {0, 1, 0, 0},        {0, 1, 0, 0},
                               {0, 0, 0, 0}, {0, nan, 0, 0}, {infinity, 0, 0, 0}, {0, 0, -1e-30f, 0}};
  const Texture position_image = make_image(GL_RGBA32F, 8, 1, &positions[0].x);
  const Texture normal_image = make_image(GL_RGBA32F, 8, 1, &normals[0].x);
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32, .masks = PlaneMasks::nearest});
  PassOnMesh pass = make_pass(furnished_room(), table, {.check_g_buffer = false});
  pass.draw({.width = 8, .height = 1, .positions = position_image.name(), .normals = normal_image.name()},
            room_camera(8, 1), {.radius = 1.0f});
  const std::vector<PixelReceiver> seen = pass.read_receivers();
  const std::vector<std::uint64_t> masks = pass.read_masks();
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(seen[i].is_valid, i == 0 || i == 7) << i;
    EXPECT_TRUE(seen[i].is_valid || masks[i] == 0);
  }
}

TEST_F(ReceiversInGlsl, UnderstandPackedAndViewSpaceNormals) {
  const Camera camera = room_camera(kSize, kSize);
  const Images images = random_images();
  std::vector<glm::vec4> in_view, packed;
  std::vector<glm::vec3> world;
  for (const Receiver& receiver : images.receivers) {
    world.push_back(glm::normalize(receiver.normal));
    in_view.emplace_back(glm::mat3(camera.view) * world.back(), 0);
    packed.emplace_back(0.5f * world.back() + 0.5f, 0);
  }
  const Texture view_image = make_image(GL_RGBA16F, kSize, kSize, &in_view[0].x);
  const Texture packed_image = make_image(GL_RGB10_A2, kSize, kSize, &packed[0].x);
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32, .masks = PlaneMasks::nearest});
  PassOnMesh pass = make_pass(furnished_room(), table, {.check_g_buffer = false});
  for (const bool is_view : {true, false}) {
    pass.draw({.width = kSize,
               .height = kSize,
               .positions = images.positions.name(),
               .normals = is_view ? view_image.name() : packed_image.name(),
               .normal_space = is_view ? NormalSpace::view : NormalSpace::world},
              camera, {.radius = 0.1f});
    const std::vector<PixelReceiver> seen = pass.read_receivers();
    float largest = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      largest = std::max(largest, glm::distance(seen[i].up, world[i]));
    }
    EXPECT_LT(largest, is_view ? 1e-3f : 3e-3f);
  }
}

}  // namespace
}  // namespace lkao::gl::tests::receivers_in_glsl_test
