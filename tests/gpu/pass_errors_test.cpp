// Mistakes come back as exceptions that name them, in one line.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/expect_error.h"
#include "gpu/gl/program.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"

namespace lkao::gl::tests::pass_errors_test {
namespace {

constexpr int kSize = 16;

class PassErrors : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    positions_ = make_image(GL_RGBA32F, kSize, kSize);
    normals_ = make_image(GL_RGBA16F, kSize, kSize);
  }
  void TearDown() override {
    positions_.reset();
    normals_.reset();
  }

  GBuffer g_buffer() const {
    return {.width = kSize, .height = kSize, .positions = positions_.name(), .normals = normals_.name()};
  }

  static PassOnMesh ready_pass() {
    return make_pass(furnished_room(), PlaneMaskTable(SamplePattern::standard(64), {32, {}, PlaneMasks::nearest}));
  }

  Texture positions_, normals_;
};

TEST_F(PassErrors, NameTheMissingContext) {
  context_->release();
  expect_error<std::runtime_error>("no OpenGL context", [] { const PassOnMesh pass; });
  context_->make_current();
  PassOnMesh pass = ready_pass();
  context_->release();
  expect_error<std::runtime_error>("no OpenGL context", [&] { pass.occluders.update_positions({}); });
  expect_error<std::runtime_error>("no OpenGL context", [&] { pass.read_masks(); });
  context_->make_current();
  {
    const PassOnMesh outlives_its_context = ready_pass();
    context_->release();
  }
  context_->make_current();
}

TEST_F(PassErrors, NameTheStepThatIsMissing) {
  const Camera camera = room_camera(kSize, kSize);
  PassOnMesh pass;
  expect_error<std::runtime_error>("set_table", [&] { pass.draw(g_buffer(), camera, {.radius = 1.0f}); });
  expect_error<std::runtime_error>("draw()", [&] { pass.resolve({}); });
  expect_error<std::runtime_error>("draw()", [&] { pass.read_masks(); });
  expect_error<std::runtime_error>("draw()", [&] { pass.read_receivers(); });
  expect_error<std::runtime_error>("draw()", [&] { pass.read_fragment_counts(); });
  expect_error<std::runtime_error>("draw()", [&] { (void)pass.masks_texture(); });
}

TEST_F(PassErrors, NameTheOptionOutOfRange) {
  PassOnMesh pass = ready_pass();
  const Camera camera = room_camera(kSize, kSize);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  struct Mistake {
    const char* name;
    RayOptions options;
    RasterOptions raster = {};
  };
  const Mistake mistakes[] = {{"radius", {}},
                              {"radius", {.radius = -1.0f}},
                              {"radius", {.radius = nan}},
                              {"radius", {.radius = 1e19f}},
                              {"radius", {.radius = -std::numeric_limits<float>::infinity()}},
                              {"rotation", {.radius = 1.0f, .jitter = {.rotation = 1.5f}}},
                              {"tilt", {.radius = 1.0f, .jitter = {.tilt = nan}}},
                              {"surface_offset", {.radius = 1.0f, .surface_offset = -2.0f}},
                              {"billboard_threshold", {.radius = 1.0f}, {.billboard_threshold = nan}}};
  for (const Mistake& bad : mistakes) {
    expect_error<std::invalid_argument>(bad.name, [&] { pass.draw(g_buffer(), camera, bad.options, bad.raster); });
  }
}

TEST_F(PassErrors, NameTheTextureAndItsFault) {
  PassOnMesh pass = ready_pass();
  const Camera camera = room_camera(kSize, kSize);
  const Texture integers = make_image(GL_RGBA32UI, kSize, kSize), small = make_image(GL_RGBA32F, kSize, kSize - 1);
  const Texture red = make_image(GL_R32F, kSize, kSize), depth = make_image(GL_DEPTH_COMPONENT24, kSize, kSize);
  Texture array = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(array.name(), 1, GL_RGBA32F, kSize, kSize, 1);
  const auto expect = [&](const char* name, const GBuffer& textures) {
    expect_error<std::invalid_argument>(name, [&] { pass.draw(textures, camera, {.radius = 1.0f}); });
  };
  GBuffer bad = g_buffer();
  bad.width = 0;
  expect("size", bad);
  bad = g_buffer();
  bad.depth = depth.name();
  expect("exactly one", bad);
  bad.depth = bad.positions = 0;
  expect("exactly one", bad);
  for (const GLuint texture : {small.name(), array.name(), red.name(), integers.name(), 12345u}) {
    bad = g_buffer();
    bad.positions = texture;
    expect("positions", bad);
    bad = g_buffer();
    bad.geometric_normals = texture;
    expect("geometric_normals", bad);
  }
  bad = g_buffer();
  bad.normals = 0;
  expect("normals is not set", bad);
  bad.normals = 12345u;
  expect("was it made in one that shares nothing", bad);

  pass.draw(g_buffer(), camera, {.radius = 1.0f});
  expect_error<std::invalid_argument>("occlusion", [&] { pass.resolve({.occlusion = {small.name()}}); });
  expect_error<std::invalid_argument>("GL_R8", [&] { pass.resolve({.occlusion = {integers.name()}}); });
  expect_error<std::invalid_argument>("bent_normals", [&] { pass.resolve({.bent_normals = red.name()}); });
  EXPECT_NO_THROW(pass.resolve({.occlusion = {red.name()}}));
}

TEST_F(PassErrors, NameFormatsAndWhyTheyCannotBe) {
  PassOnMesh pass = ready_pass();
  const Camera camera = room_camera(kSize, kSize);
  const auto expect = [&](ObjectName GBuffer::*member, GLenum format, const std::string& message) {
    const Texture texture = make_image(format, kSize, kSize);
    GBuffer bad = g_buffer();
    if (member == &GBuffer::linear_depth) bad.positions = 0;
    bad.*member = texture.name();
    expect_error<std::invalid_argument>(message, [&] { pass.draw(bad, camera, {.radius = 1.0f}); });
  };
  expect(&GBuffer::normals, GL_RG16_SNORM,
         "normals must have 3 float or normalised components, not the format GL_RG16_SNORM");
  expect(&GBuffer::normals, GL_R11F_G11F_B10F, "normals cannot be in GL_R11F_G11F_B10F: its floats have no sign");
  expect(&GBuffer::normals, GL_SRGB8_ALPHA8, "normals cannot be in GL_SRGB8_ALPHA8: shaders read its numbers decoded");
  expect(&GBuffer::geometric_normals, GL_RGB9_E5, "geometric_normals cannot be in GL_RGB9_E5: its floats have no sign");
  expect(&GBuffer::positions, GL_R11F_G11F_B10F, "positions cannot be in GL_R11F_G11F_B10F: its floats have no sign");
  expect(&GBuffer::positions, GL_RGBA16, "positions cannot be in GL_RGBA16: it holds 0 to 1 only");
  expect(&GBuffer::positions, GL_RGBA32UI, "not the format GL_RGBA32UI");
  expect(&GBuffer::linear_depth, GL_R16, "linear_depth cannot be in GL_R16: it holds 0 to 1 only");
  expect(&GBuffer::linear_depth, GL_DEPTH_COMPONENT32F, "linear_depth cannot be in GL_DEPTH_COMPONENT32F");
  const Texture red = make_image(GL_R16F, kSize, kSize), half = make_image(GL_RG16F, kSize, kSize);
  const Texture no_image = make_image(GL_RGB8, kSize, kSize);
  GBuffer packed = g_buffer();
  packed.normals = red.name();
  packed.normal_encoding = NormalEncoding::octahedral;
  expect_error<std::invalid_argument>("normals must have 2", [&] { pass.draw(packed, camera, {.radius = 1.0f}); });
  packed.normals = half.name();
  packed.normal_encoding = NormalEncoding::xy;
  expect_error<std::invalid_argument>("normal_space", [&] { pass.draw(packed, camera, {.radius = 1.0f}); });
  pass.draw(g_buffer(), camera, {.radius = 1.0f});
  expect_error<std::invalid_argument>("format GL_RGB8;", [&] { pass.resolve({.occlusion = {no_image.name()}}); });
}

TEST_F(PassErrors, NameTheCamerasFault) {
  PassOnMesh pass = ready_pass();
  const Camera good = room_camera(kSize, kSize);
  const auto expect = [&](const char* name, const Camera& camera) {
    expect_error<std::invalid_argument>(name, [&] { pass.draw(g_buffer(), camera, {.radius = 1.0f}); });
  };
  expect("view", {glm::scale(good.view, glm::vec3(2)), good.projection});
  expect("view", {good.projection, good.projection});
  expect("projection", {good.view, glm::mat4(0)});
  expect("projection", {good.view, glm::perspectiveLH(1.0f, 1.0f, 0.1f, 10.0f)});
}

TEST_F(PassErrors, NameWhatIsWrongWithTheMesh) {
  PassOnMesh pass = ready_pass();
  const glm::vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const glm::uvec3 triangles[] = {{0, 1, 2}, {0, 3, 1}};
  expect_error<std::invalid_argument>("triangle 1", [&] { pass.occluders = Occluders(positions, triangles); });
  expect_error<std::invalid_argument>("positions", [&] { pass.occluders.update_positions(positions); });
}

TEST_F(PassErrors, NameAnErrorOfSomebodyElse) {
  PassOnMesh pass = ready_pass();
  glEnable(GL_TEXTURE_2D_ARRAY);
  expect_error<std::runtime_error>("GL_INVALID_ENUM while something before",
                                   [&] { pass.occluders.update_positions({}); });
  pass.draw(g_buffer(), room_camera(kSize, kSize), {.radius = 1.0f});
  glEnable(GL_TEXTURE_2D_ARRAY);
  expect_error<std::runtime_error>("GL_INVALID_ENUM while something before", [&] { pass.read_masks(); });
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(PassErrors, GiveTheDriversFirstLine) {
  expect_error<std::runtime_error>("refuses the shader broken", [] {
    make_program_of(GL_COMPUTE_SHADER, "broken", "#version 450 core\nvoid main() { x }\n");
  });
}

}  // namespace
}  // namespace lkao::gl::tests::pass_errors_test
