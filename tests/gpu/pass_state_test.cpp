// A pass leaves OpenGL as it found it, and works whatever it finds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl_state.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"

namespace lkao::gl::tests::pass_state_test {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

constexpr int kWidth = 48;
constexpr int kHeight = 36;

class PassState : public OnSoftware {};

TEST_F(PassState, IsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const PlaneMaskTable table(SamplePattern::standard(192), {.resolution = 32});
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight), bent = make_image(GL_RGBA16F, kWidth, kHeight);
  const RayOptions options{.radius = 1.0f, .jitter = {.tilt = 0.02f}};
  const MaskPassSetup setups[] = {
      {.accumulator = Accumulator::logic_op, .count_fragments = true},
      {.geometry = GeometryBackEnd::geometry_shader, .accumulator = Accumulator::ssbo, .count_fragments = true}};

  std::vector<std::vector<std::uint64_t>> expected;
  for (const MaskPassSetup& setup : setups) {
    PassOnMesh pass = make_pass(mesh, table, setup);
    pass.draw(g_buffer.by_depth(), camera, options);
    pass.resolve({.occlusion = {occlusion.name()}, .bent_normals = bent.name()});
    expected.push_back(pass.read_masks());
    EXPECT_GT(count_bits(expected.back()), 10000u);
  }

  std::vector<std::vector<std::uint64_t>> masks;
  const OddState odd;
  const Snapshot before = take_snapshot();
  ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  for (const MaskPassSetup& setup : setups) {
    PassOnMesh pass(setup);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after the driver's check";
    pass.occluders = Occluders(mesh.positions, mesh.triangles);
    pass.set_table(table);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after set_table";
    pass.occluders.update_positions(mesh.positions);
    pass.draw(g_buffer.by_depth(), camera, options);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
    pass.resolve({.occlusion = {occlusion.name()}, .bent_normals = bent.name()});
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after resolve";
    masks.push_back(pass.read_masks());
    pass.read_receivers();
    pass.read_fragment_counts();
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after reading";
    EXPECT_THROW(pass.draw(g_buffer.by_depth(), {camera.view, glm::mat4(0)}, options), std::invalid_argument);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
  }
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_EQ(masks, expected);
}

TEST_F(PassState, OfVolumesIsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight);
  const RayOptions options{.radius = 1.0f};
  const VolumePassSetup setups[] = {
      {.count_fragments = true},
      {.geometry = GeometryBackEnd::geometry_shader, .keeps_volumes = true, .count_fragments = true},
      {.keep_state = false}};
  std::vector<std::vector<glm::vec4>> expected;
  for (const VolumePassSetup& setup : setups) {
    VolumePass pass(setup);
    Occluders occluders(mesh.positions, mesh.triangles);
    occluders.set_opacities(std::vector<float>(mesh.triangles.size(), 0.5f));
    pass.draw(occluders, g_buffer.by_depth(), camera, options, {occlusion.name()});
    expected.push_back(read_image(occlusion.name(), kWidth, kHeight));
  }

  for (std::size_t i = 0; i < std::size(setups); ++i) {
    const OddState odd;
    const Snapshot before = take_snapshot();
    VolumePass pass(setups[i]);
    Occluders occluders(mesh.positions, mesh.triangles);
    occluders.set_opacities(std::vector<float>(mesh.triangles.size(), 0.5f));
    if (setups[i].keep_state) {
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after the driver's check";
    }
    pass.draw(occluders, g_buffer.by_depth(), camera, options, {occlusion.name()});
    if (setups[i].keep_state) {
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
      pass.read_fragment_counts();
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after reading";
      EXPECT_THROW(pass.draw(occluders, g_buffer.by_depth(), {camera.view, glm::mat4(0)}, options, {occlusion.name()}),
                   std::invalid_argument);
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
    } else {
      EXPECT_THAT(changes_since(before), Not(IsEmpty()));
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    EXPECT_EQ(read_image(occlusion.name(), kWidth, kHeight), expected[i]);
  }
}

TEST_F(PassState, OfHorizonsIsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const Texture occlusion = make_image(GL_RGBA16F, kWidth, kHeight);
  const HorizonOptions options{.estimator = HorizonEstimator::bitmask, .radius = 1, .thickness = 0.5f};
  const auto draw = [&](HorizonPass& pass) {
    pass.draw(g_buffer.by_depth(), camera, options, {.texture = occlusion.name(), .channel = Channel::blue});
  };
  HorizonPass usual;
  draw(usual);
  const std::vector<glm::vec4> expected = read_image(occlusion.name(), kWidth, kHeight);
  for (const bool keeps : {true, false}) {
    const OddState odd;
    const Snapshot before = take_snapshot();
    HorizonPass pass({.keep_state = keeps});
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after it is made";
    draw(pass);
    if (keeps) {
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
      EXPECT_THROW(pass.draw(g_buffer.by_depth(), camera, {}, {occlusion.name()}), std::invalid_argument);
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
    } else {
      EXPECT_THAT(changes_since(before), Not(IsEmpty()));
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    EXPECT_EQ(read_image(occlusion.name(), kWidth, kHeight), expected);
  }
}

TEST_F(PassState, OfBlendingIsPutBack) {
  const OddState odd;
  const Snapshot before = take_snapshot();
  {
    const StateKeeper keeper({.draws = true, .blends = true});
    for (GLuint i = 0; i < kKeptColorCount; ++i) EXPECT_FALSE(glIsEnabledi(GL_BLEND, i));
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBlendEquation(GL_FUNC_ADD);
    glColorMask(GL_FALSE, GL_FALSE, GL_TRUE, GL_TRUE);
    EXPECT_THAT(changes_since(before), Not(IsEmpty()));
  }
  EXPECT_THAT(changes_since(before), IsEmpty());
}

TEST_F(PassState, OfAlchemyIsPutBackAndDoesNotMatter) {
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(furnished_room(), camera, kWidth, kHeight);
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight);
  const AlchemyOptions options{.radius = 0.5f};
  AlchemyPass().draw(g_buffer.by_depth(), camera, options, {occlusion.name()});
  const std::vector<glm::vec4> expected = read_image(occlusion.name(), kWidth, kHeight);
  for (const bool keeps : {true, false}) {
    const OddState odd;
    const Snapshot before = take_snapshot();
    AlchemyPass pass({.keep_state = keeps});
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after it was made";
    pass.draw(g_buffer.by_depth(), camera, options, {occlusion.name()});
    EXPECT_EQ(changes_since(before).empty(), keeps) << "after draw";
    EXPECT_THROW(pass.draw(g_buffer.by_depth(), {camera.view, glm::mat4(0)}, options, {occlusion.name()}),
                 std::invalid_argument);
    EXPECT_EQ(changes_since(before).empty(), keeps) << "after an exception";
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    EXPECT_EQ(read_image(occlusion.name(), kWidth, kHeight), expected);
  }
}

TEST_F(PassState, MayHaveAProgramThatWasDeletedWhileInUse) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  PassOnMesh pass = make_pass(mesh, PlaneMaskTable(SamplePattern::standard(64), {.resolution = 32}));
  ProgramObject program = make_program({"frame/screen.vert", "masks/fill.frag"});
  glUseProgram(program.name());
  program.reset();
  pass.draw(g_buffer.by_depth(), camera, {.radius = 1.0f});
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(PassState, IsLeftChangedWhereNobodyWantsItKept) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh keeping = make_pass(mesh, table), careless = make_pass(mesh, table, {.keep_state = false});
  keeping.draw(g_buffer.by_depth(), camera, {.radius = 1.0f});
  const OddState odd;
  const Snapshot before = take_snapshot();
  careless.draw(g_buffer.by_depth(), camera, {.radius = 1.0f});
  EXPECT_THAT(changes_since(before), Not(IsEmpty()));
  EXPECT_EQ(careless.read_masks(), keeping.read_masks());
}

TEST_F(PassState, OfSplatsIsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const GBuffer textures = g_buffer.by_depth(), behind = g_buffer.by_positions();
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight);
  const std::vector<glm::vec4> spheres{{0.9f, 0.7f, -0.8f, 0.7f}, {-2, 1, -1.5f, 0.4f}};
  const SplatOptions options{.near_radius = 0.3f};
  SplatPass usual;
  usual.set_spheres(spheres);
  usual.draw(textures, camera, options, {occlusion.name()}, &behind);
  const std::vector<glm::vec4> expected = read_image(occlusion.name(), kWidth, kHeight);

  const auto read = [&] {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    return read_image(occlusion.name(), kWidth, kHeight);
  };
  {
    const OddState odd;
    const Snapshot before = take_snapshot();
    SplatPass pass({.count_fragments = true});
    pass.set_spheres(spheres);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after set_spheres";
    pass.draw(textures, camera, options, {occlusion.name()}, &behind);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
    EXPECT_GT(pass.read_fragment_count(), 0u);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after reading";
    EXPECT_THROW(pass.draw(textures, {camera.view, glm::mat4(0)}, options, {occlusion.name()}), std::invalid_argument);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
    EXPECT_EQ(read(), expected);
  }
  const OddState odd;
  const Snapshot before = take_snapshot();
  SplatPass careless({.keep_state = false});
  careless.set_spheres(spheres);
  careless.draw(textures, camera, options, {occlusion.name()}, &behind);
  EXPECT_THAT(changes_since(before), Not(IsEmpty()));
  EXPECT_EQ(read(), expected);
}

TEST_F(PassState, OfVaoIsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight), bleeding = make_image(GL_RGBA16F, kWidth, kHeight);
  GBuffer textures = g_buffer.by_depth();
  textures.colours = g_buffer.normals();
  const VaoOptions options{.radius = 0.5f, .luminance = LuminanceSensitivity{}};
  const BleedingTarget colours{bleeding.name()};
  const auto read = [&] {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    std::vector<glm::vec4> texels = read_image(occlusion.name(), kWidth, kHeight);
    const std::vector<glm::vec4> bled = read_image(bleeding.name(), kWidth, kHeight);
    texels.insert(texels.end(), bled.begin(), bled.end());
    return texels;
  };
  VaoPass().draw(textures, camera, options, {occlusion.name()}, &colours);
  const std::vector<glm::vec4> expected = read();
  for (const bool counts : {false, true}) {
    const OddState odd;
    const Snapshot before = take_snapshot();
    VaoPass pass({.count = counts});
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after it is made";
    pass.draw(textures, camera, options, {occlusion.name()}, &colours);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
    if (counts) {
      EXPECT_GT(pass.read_counts().samples, 0u);
    }
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after reading";
    EXPECT_THROW(pass.draw(textures, {camera.view, glm::mat4(0)}, options, {occlusion.name()}), std::invalid_argument);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
    EXPECT_EQ(read(), expected);
  }
  const OddState odd;
  const Snapshot before = take_snapshot();
  VaoPass({.keep_state = false}).draw(textures, camera, options, {occlusion.name()}, &colours);
  EXPECT_THAT(changes_since(before), Not(IsEmpty()));
  EXPECT_EQ(read(), expected);
}

}  // namespace
}  // namespace lkao::gl::tests::pass_state_test
