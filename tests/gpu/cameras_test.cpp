// Every kind of camera and G-buffer gives the CPU's masks for the receivers that it shows.
#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/cpu_rays.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::cameras_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(32, 24);
constexpr int kHeight = lkao::tests::unless_sanitized(24, 18);
constexpr float kAspect = static_cast<float>(kWidth) / kHeight;

struct NamedCamera {
  std::string name;
  Camera camera;
};

std::vector<NamedCamera> all_cameras() {
  const glm::mat4 view = room_camera(kWidth, kHeight).view;
  const auto zero_to_one = ClipDepth::zero_to_one, minus_one = ClipDepth::minus_one_to_one;
  glm::mat4 infinite_reversed(0);
  infinite_reversed[0][0] = 1.1f;
  infinite_reversed[1][1] = 1.1f * kAspect;
  infinite_reversed[3][2] = 0.05f;
  infinite_reversed[2][3] = -1;
  const glm::mat4 mirror = glm::scale(glm::mat4(1), glm::vec3(1, -1, 1));
  return {{"perspective", {view, glm::perspectiveRH_NO(1.2f, kAspect, 0.05f, 50.0f), minus_one}},
          {"perspective, depths from 0", {view, glm::perspectiveRH_ZO(1.2f, kAspect, 0.05f, 50.0f), zero_to_one}},
          {"reversed perspective", {view, glm::perspectiveRH_ZO(1.2f, kAspect, 50.0f, 0.05f), zero_to_one}},
          {"reversed, infinitely far", {view, infinite_reversed, zero_to_one}},
          {"infinitely far", {view, glm::infinitePerspective(1.2f, kAspect, 0.05f), minus_one}},
          {"mirrored", {view, mirror * glm::perspectiveRH_NO(1.2f, kAspect, 0.05f, 50.0f), minus_one}},
          {"lopsided", {view, glm::frustumRH_NO(-0.04f, 0.02f, -0.01f, 0.03f, 0.05f, 50.0f), minus_one}},
          {"far plane in the room", {view, glm::perspectiveRH_NO(1.2f, kAspect, 2.0f, 5.0f), minus_one}},
          {"orthographic", {view, glm::orthoRH_NO(-2.8f, 2.8f, -2.0f, 2.0f, 0.1f, 20.0f), minus_one}},
          {"reversed orthographic", {view, glm::orthoRH_ZO(-2.8f, 2.8f, -2.0f, 2.0f, 20.0f, 0.1f), zero_to_one}}};
}

class Cameras : public OnSoftware {
 protected:
  static void expect_receivers(const std::vector<PixelReceiver>& seen, const std::vector<Receiver>& expected,
                               float tolerance) {
    std::size_t off_count = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const bool shows_something = expected[i].normal != glm::vec3(0);
      off_count += seen[i].is_valid != shows_something ||
                   (shows_something && glm::distance(seen[i].origin, expected[i].position) > tolerance);
    }
    EXPECT_EQ(off_count, 0u);
  }

  // The masks of the last draw against the CPU's at the very same receivers.
  static void expect_cpu_masks(PassOnMesh& pass, const OccluderBvh& occluders, const SamplePattern& pattern,
                               const RayOptions& options) {
    const query::PatternLanes lanes(pattern);
    const std::vector<PixelReceiver> receivers = pass.read_receivers();
    const std::vector<std::uint64_t> masks = pass.read_masks();
    const auto words = static_cast<std::size_t>(pattern.word_count());
    std::uint64_t difference_count = 0, bit_count = 0, receiver_count = 0;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      OcclusionMask expected;
      if (receivers[i].is_valid) {
        ++receiver_count;
        const ReceiverRays rays = rays_of(receivers[i], lanes, options.radius);
        expected = cpu_mask(occluders, rays, options.radius, options.sidedness);
      }
      for (std::size_t word = 0; word < words; ++word) {
        bit_count += static_cast<unsigned>(std::popcount(expected.words[word]));
        difference_count += static_cast<unsigned>(std::popcount(expected.words[word] ^ masks[i * words + word]));
      }
    }
    EXPECT_GT(receiver_count, receivers.size() / 3);
    EXPECT_GT(bit_count, 2 * receiver_count);
    EXPECT_LE(difference_count, receiver_count * static_cast<std::uint64_t>(pattern.ray_count()) / 10000);
  }
};

TEST_F(Cameras, OfAllKindsGiveTheCpusMasks) {
  const Mesh mesh = furnished_room();
  const OccluderBvh occluders(mesh.view());
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh, table);
  // Coarse formats take receivers so far off their surfaces that shapes must know of it.
  const GBufferFormats fine, coarse{.depth = GL_DEPTH_COMPONENT16, .linear_depth = GL_R16F, .positions = GL_RGBA16F};
  for (const auto& [name, camera] : all_cameras()) {
    const auto receivers = GBufferPass(mesh, camera, kWidth, kHeight).receivers();
    for (const bool is_fine : {true, false}) {
      const GBufferPass g_buffer(mesh, camera, kWidth, kHeight, is_fine ? fine : coarse);
      for (const GBuffer& textures :
           {g_buffer.by_positions(), g_buffer.by_view_positions(), g_buffer.by_depth(), g_buffer.by_linear_depth()}) {
        SCOPED_TRACE(name + (is_fine ? "" : ", coarse") +
                     (textures.depth != 0                              ? ", by depth"
                      : textures.linear_depth != 0                     ? ", by linear depth"
                      : textures.position_space == PositionSpace::view ? ", by view positions"
                                                                       : ", by positions"));
        for (const bool two_sided : {true, false}) {
          const RayOptions options{.radius = 0.7f, .sidedness = sidedness_of(two_sided)};
          pass.draw_off_surface(textures, camera, options);
          expect_receivers(pass.read_receivers(), receivers, is_fine ? 2e-3f : 0.25f);
          expect_cpu_masks(pass, occluders, table.pattern(), options);
        }
      }
    }
  }
}

TEST_F(Cameras, SeeShapesThatReachReceiversFarOffTheirSurfaces) {
  // A floor seen along itself, its positions coarse so high up: they are out of the reach of what hangs above them, but
  // receivers start 1/16 higher.
  constexpr int kPixels = 128;
  const Camera camera{glm::lookAt(glm::vec3(0, 100, 10), glm::vec3(0, 100, 0), glm::vec3(0, 1, 0)),
                      glm::ortho(-2.0f, 2.0f, -1.0f / 64, 1.0f / 64, 0.0f, 20.0f), ClipDepth::minus_one_to_one};
  std::vector<glm::vec4> places, ups(kPixels, {0, 1, 0, 0});
  for (int i = 0; i < kPixels; ++i) places.emplace_back(-2 + (static_cast<float>(i) + 0.5f) / 32, 100, 0, 1);
  const Texture positions = make_image(GL_RGBA16F, kPixels, 1, &places[0].x);
  const Texture normals = make_image(GL_RGBA32F, kPixels, 1, &ups[0].x);
  const Mesh mesh{{{-1.5f, 101.01f, -1}, {1.5f, 101.01f, -1}, {0, 101.01f, 1}}, {{0, 1, 2}}};
  const OccluderBvh occluders(mesh.view());
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh, table);
  for (const float threshold : {0.0f, 100.0f}) {  // prisms, billboards
    const RayOptions options{.radius = 1};
    pass.draw_off_surface({.width = kPixels, .height = 1, .positions = positions.name(), .normals = normals.name()},
                          camera, options, {.billboard_threshold = threshold});
    expect_cpu_masks(pass, occluders, table.pattern(), options);
  }
}

TEST_F(Cameras, MayStandInsideOfTheShapes) {
  // The radius is larger than the room: the camera is inside of every prism and every sphere.
  const Mesh mesh = furnished_room();
  const OccluderBvh occluders(mesh.view());
  const Camera camera{glm::lookAt(glm::vec3(0.2f, 1.5f, 1.0f), glm::vec3(-1, 1, -3), glm::vec3(0, 1, 0)),
                      glm::perspective(1.5f, kAspect, 0.5f, 50.0f), ClipDepth::minus_one_to_one};
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  for (const GeometryBackEnd geometry : {GeometryBackEnd::vertex_pulling, GeometryBackEnd::geometry_shader}) {
    PassOnMesh pass = make_pass(mesh, table, {.geometry = geometry});
    for (const bool two_sided : {true, false}) {
      const RayOptions options{.radius = 9.0f, .sidedness = sidedness_of(two_sided)};
      pass.draw(g_buffer.by_positions(), camera, options, {.billboard_threshold = 100.0f});
      expect_cpu_masks(pass, occluders, table.pattern(), options);
    }
  }
}

TEST_F(Cameras, MayBeFarFromTheOriginAndInAnyUnit) {
  for (const float scale : {1e-10f, 1e-3f, 1e3f, 1e9f}) {
    Mesh mesh = furnished_room();
    const glm::vec3 move(3.0f, -20.0f, 7.0f);
    for (glm::vec3& position : mesh.positions) position = scale * (position + move);
    const OccluderBvh occluders(mesh.view());
    const glm::vec3 eye = scale * (glm::vec3(0.3f, 1.9f, 3.4f) + move),
                    target = scale * (glm::vec3(0, 1.3f, -1) + move);
    const Camera camera{glm::lookAt(eye, target, glm::vec3(0, 1, 0)),
                        glm::perspective(1.2f, kAspect, 0.05f * scale, 50.0f * scale), ClipDepth::minus_one_to_one};
    const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
    const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
    PassOnMesh pass = make_pass(mesh, table);
    const RayOptions options{.radius = 0.7f * scale};
    pass.draw(g_buffer.by_positions(), camera, options);
    expect_cpu_masks(pass, occluders, table.pattern(), options);
  }
}

}  // namespace
}  // namespace lkao::gl::tests::cameras_test
