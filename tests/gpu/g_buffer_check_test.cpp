// The first frame of a kind of G-buffer is looked at: positions in the wrong space are named, coarse ones remarked on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/in_furnished_room.h"

namespace lkao::gl::tests::g_buffer_check_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class GBufferCheck : public InFurnishedRoom<64, 48> {
 protected:
  static PassOnMesh ready_pass(const MaskPassSetup& setup = {}) {
    return make_pass(furnished_room(), PlaneMaskTable(SamplePattern::standard(64), {32, {}, PlaneMasks::nearest}),
                     setup);
  }
  static std::string error_of(PassOnMesh& pass, const GBuffer& textures, const Camera& camera) {
    try {
      pass.draw_off_surface(textures, camera, {.radius = 0.5f});
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }
  GBuffer in_wrong_space() const {
    GBuffer textures = g_buffer_->by_view_positions();
    textures.position_space = PositionSpace::world;
    return textures;
  }
};

TEST_F(GBufferCheck, NamesTheSpaceThatPositionsAreIn) {
  PassOnMesh pass = ready_pass();
  EXPECT_EQ(error_of(pass, g_buffer_->by_view_positions(), camera_), "");
  EXPECT_EQ(error_of(pass, g_buffer_->by_positions(), camera_), "");
  EXPECT_THAT(error_of(pass, in_wrong_space(), camera_), IsEmpty()) << "of the kind of the last frame";
  EXPECT_EQ(error_of(pass, g_buffer_->by_depth(), camera_), "");
  EXPECT_THAT(error_of(pass, in_wrong_space(), camera_),
              HasSubstr("they are not in world space; they fit view space: set position_space"));
  GBuffer as_view = g_buffer_->by_positions();
  as_view.position_space = PositionSpace::view;
  EXPECT_THAT(error_of(pass, as_view, camera_), HasSubstr("not in view space; they fit world space"));
  EXPECT_THAT(error_of(pass, as_view, camera_), HasSubstr("not in view space")) << "is said again";
}

TEST_F(GBufferCheck, NamesAPictureUpsideDown) {
  PassOnMesh pass = ready_pass();
  Camera mirrored = camera_;
  mirrored.projection = glm::scale(glm::mat4(1), glm::vec3(1, -1, 1)) * camera_.projection;
  EXPECT_THAT(error_of(pass, g_buffer_->by_positions(), mirrored), HasSubstr("rows run downwards"));
  Camera other = camera_;
  other.view = glm::rotate(camera_.view, 0.2f, glm::vec3(0, 1, 0));
  EXPECT_THAT(error_of(pass, g_buffer_->by_positions(), other), HasSubstr("they fit neither space"));
}

TEST_F(GBufferCheck, WaitsForAFrameThatShowsSomething) {
  PassOnMesh pass = ready_pass();
  const GBufferPass sky(Mesh{{{0, 0, 900}, {1, 0, 900}, {0, 1, 900}}, {{0, 1, 2}}}, camera_, 64, 48);
  GBuffer nothing = sky.by_view_positions();
  nothing.position_space = PositionSpace::world;
  EXPECT_EQ(error_of(pass, nothing, camera_), "");
  EXPECT_THAT(error_of(pass, in_wrong_space(), camera_), HasSubstr("set position_space"));
}

TEST_F(GBufferCheck, CanBeSwitchedOff) {
  PassOnMesh pass = ready_pass({.check_g_buffer = false});
  EXPECT_EQ(error_of(pass, in_wrong_space(), camera_), "");
  EXPECT_THAT(pass.warnings(), IsEmpty());
}

TEST_F(GBufferCheck, RemarksOnCoarseFormats) {
  PassOnMesh pass = ready_pass();
  const auto warnings_of = [&](const GBuffer& textures) {
    EXPECT_EQ(error_of(pass, textures, camera_), "");
    return pass.warnings();
  };
  for (const GBuffer& fine : {g_buffer_->by_positions(), g_buffer_->by_depth(), g_buffer_->by_linear_depth()}) {
    EXPECT_THAT(warnings_of(fine), IsEmpty());
  }
  const GBufferPass half(mesh_, camera_, 64, 48, {.depth = GL_DEPTH_COMPONENT16, .positions = GL_RGBA16F});
  // The ceiling is at 4: from there on halves are 1/256 apart.
  EXPECT_THAT(warnings_of(half.by_positions()),
              testing::ElementsAre(HasSubstr("positions of half floats are off by up to 0.0039")));
  Camera near_by = camera_;
  near_by.projection = glm::perspective(1.2f, 64.0f / 48, 0.005f, 50.0f);
  const GBufferPass coarse(mesh_, near_by, 64, 48, {.depth = GL_DEPTH_COMPONENT16});
  pass.draw_off_surface(coarse.by_depth(), near_by, {.radius = 0.5f});
  EXPECT_THAT(pass.warnings(), testing::ElementsAre(HasSubstr("depth may be off by 0.1")));
  pass.draw_off_surface(coarse.by_depth(), near_by, {.radius = 5});
  EXPECT_THAT(pass.warnings(), IsEmpty());
}

TEST_F(GBufferCheck, LeavesHalfFloatsFarAwayInPeace) {
  // A thousand units from the origin half floats miss their pixels by many, and are in the right space all the same.
  const glm::vec3 move(1000, 0, 0);
  for (glm::vec3& position : mesh_.positions) position += move;
  Camera camera = camera_;
  camera.view = glm::translate(camera.view, -move);
  const GBufferPass far(mesh_, camera, 64, 48, {.positions = GL_RGBA16F});
  PassOnMesh pass = ready_pass();
  EXPECT_EQ(error_of(pass, far.by_positions(), camera), "");
  EXPECT_THAT(pass.warnings(), testing::Contains(HasSubstr("off by up to 0.5")));
}

}  // namespace
}  // namespace lkao::gl::tests::g_buffer_check_test
