// Errors as values, and errors that the host left behind.
#include <gmock/gmock.h>

#include <optional>
#include <vector>

#include "gpu/in_furnished_room.h"

namespace lkao::gl::tests::status_test {
namespace {

using testing::HasSubstr;

class Statuses : public InFurnishedRoom<32, 24> {
 protected:
  PlaneMaskTable table_{SamplePattern::standard(64), {.resolution = 32}};
};

TEST_F(Statuses, AreGoodWhereACallWorks) {
  Status status{"not asked yet"};
  std::optional<Occluders> occluders = Occluders::try_make(mesh_.positions, mesh_.triangles, status);
  ASSERT_TRUE(occluders) << status.message;
  EXPECT_TRUE(status.ok());
  EXPECT_TRUE(occluders->try_update_positions(mesh_.positions));
  std::optional<MaskPass> pass = MaskPass::try_make({}, status);
  ASSERT_TRUE(pass && status) << status.message;
  EXPECT_TRUE(pass->try_set_table(table_));
  EXPECT_TRUE(pass->try_draw(*occluders, g_buffer_->by_positions(), camera_, {.radius = 0.8f}));
  PassOnMesh throwing = make_pass(mesh_, table_);
  EXPECT_EQ(pass->read_masks(), draw(throwing, {.radius = 0.8f}));

  const Texture target = make_image(GL_R8, 32, 24);
  EXPECT_TRUE(pass->try_resolve({.occlusion = {target.name()}}));
  std::optional<BilateralFilter> filter = BilateralFilter::try_make({}, status);
  ASSERT_TRUE(filter && status) << status.message;
  EXPECT_TRUE(filter->try_filter(g_buffer_->by_positions(), camera_, {target.name()}, {target.name()}));
  GBuffer half = g_buffer_->by_positions();
  half.step = 2;
  const Texture samples = make_image(GL_R8, 16, 12);
  EXPECT_TRUE(filter->try_upsample(half, camera_, {samples.name()}, {target.name()}));
  EXPECT_THAT(filter->try_upsample(half, camera_, {target.name()}, {target.name()}).message, HasSubstr("16x12"));
}

TEST_F(Statuses, SayWhatWouldHaveBeenThrown) {
  Status status;
  MaskPass pass;
  const Occluders occluders(mesh_.positions, mesh_.triangles);
  EXPECT_THAT(pass.try_draw(occluders, g_buffer_->by_positions(), camera_, {.radius = 0.8f}).message,
              HasSubstr("set_table()"));
  EXPECT_TRUE(pass.try_set_table(table_));
  EXPECT_THAT(pass.try_draw(occluders, g_buffer_->by_positions(), camera_, {.radius = -1}).message,
              HasSubstr("radius"));
  EXPECT_THAT(pass.try_resolve({}).message, HasSubstr("draw()"));
  const std::vector<glm::uvec3> beyond{{0, 1, 1000000}};
  EXPECT_FALSE(Occluders::try_make(mesh_.positions, beyond, status));
  EXPECT_THAT(status.message, HasSubstr("1000000"));
  context_->release();
  EXPECT_FALSE(MaskPass::try_make({}, status));
  EXPECT_THAT(status.message, HasSubstr("no OpenGL context"));
  EXPECT_TRUE(context_->try_make_current());
}

TEST_F(Statuses, ErrorsOfTheHostAreReportedOrDropped) {
  const auto leave_an_error = [] { glEnable(GL_TEXTURE_2D_ARRAY); };
  MaskPass reporting, dropping({.host_errors = HostErrors::dropped});
  Occluders occluders(mesh_.positions, mesh_.triangles, {}, HostErrors::dropped);
  leave_an_error();
  EXPECT_THAT(reporting.try_set_table(table_).message, HasSubstr("before lkao was called"));
  leave_an_error();
  EXPECT_TRUE(dropping.try_set_table(table_));
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  leave_an_error();
  EXPECT_TRUE(occluders.try_update_positions(mesh_.positions));
  leave_an_error();
  EXPECT_TRUE(dropping.try_draw(occluders, g_buffer_->by_positions(), camera_, {.radius = 0.8f}));
  EXPECT_GT(count_bits(dropping.read_masks()), 0u);
}

}  // namespace
}  // namespace lkao::gl::tests::status_test
