// Mistakes in the use of a volume pass come back as exceptions, or statuses, that name them in one line.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/expect_error.h"
#include "gpu/g_buffer_pass.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"

namespace lkao::gl::tests::volumes_errors_test {
namespace {

constexpr int kSize = 16;

class VolumeErrors : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    positions_ = make_image(GL_RGBA32F, kSize, kSize);
    normals_ = make_image(GL_RGBA16F, kSize, kSize);
    target_ = make_image(GL_R8, kSize, kSize);
  }
  void TearDown() override {
    for (Texture* texture : {&positions_, &normals_, &target_}) texture->reset();
  }

  GBuffer g_buffer() const {
    return {.width = kSize, .height = kSize, .positions = positions_.name(), .normals = normals_.name()};
  }

  const Camera camera_ = room_camera(kSize, kSize);
  Texture positions_, normals_, target_;
};

TEST_F(VolumeErrors, NameTheOptionOutOfRange) {
  VolumePass pass;
  const Occluders none;
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const auto expect = [&](const char* named, const RayOptions& options, const VolumeOptions& volumes = {}) {
    expect_error<std::invalid_argument>(
        named, [&] { pass.draw(none, g_buffer(), camera_, options, {target_.name()}, volumes); });
  };
  expect("radius must be", {});
  expect("radius must be", {.radius = nan});
  expect("radius must be finite for volumes, not inf", {.radius = infinity});
  expect("min_distance must be 0 for volumes, not 0.5", {.radius = 1, .min_distance = 0.5f});
  expect("surface_offset", {.radius = 1, .surface_offset = -3});
  expect("compensation must be finite", {.radius = 1}, {.compensation = {1, nan, 0}});
  EXPECT_NO_THROW(pass.draw(none, g_buffer(), camera_, {.radius = 1}, {target_.name()}));
}

TEST_F(VolumeErrors, NameTheTextureAndItsFault) {
  VolumePass pass;
  const Occluders none;
  const Texture small = make_image(GL_R8, kSize, kSize - 1), depth = make_image(GL_DEPTH_COMPONENT24, kSize, kSize);
  const auto expect = [&](const char* named, const GBuffer& textures, ObjectName target) {
    expect_error<std::invalid_argument>(named, [&] { pass.draw(none, textures, camera_, {.radius = 1}, {target}); });
  };
  expect("occlusion must be of", g_buffer(), small.name());
  expect("occlusion", g_buffer(), depth.name());
  expect("occlusion is not set", g_buffer(), 0);
  GBuffer bad = g_buffer();
  bad.normals = 0;
  expect("normals is not set", bad, target_.name());
  bad = g_buffer();
  bad.depth = depth.name();
  expect("exactly one", bad, target_.name());
}

TEST_F(VolumeErrors, NameWhatIsWrongWithTheOccluders) {
  VolumePass pass;
  const Mesh mesh = furnished_room();
  const std::vector<glm::vec2> ranges(mesh.triangles.size(), {0, 1});
  const Occluders levels(mesh.positions, mesh.triangles, ranges);
  expect_error<std::invalid_argument>("ranges",
                                      [&] { pass.draw(levels, g_buffer(), camera_, {.radius = 1}, {target_.name()}); });
  Occluders occluders(mesh.positions, mesh.triangles);
  const std::size_t count = mesh.triangles.size();
  std::vector<float> opacities(count, 0.5f);
  EXPECT_NO_THROW(occluders.set_opacities(opacities));
  opacities.back() = 1.5f;
  expect_error<std::invalid_argument>("opacities[" + std::to_string(count - 1) + "] must be from 0 to 1, not 1.5",
                                      [&] { occluders.set_opacities(opacities); });
  opacities.pop_back();
  expect_error<std::invalid_argument>("opacities for", [&] { occluders.set_opacities(opacities); });
  opacities = {std::numeric_limits<float>::quiet_NaN()};
  opacities.resize(count);
  EXPECT_NE(occluders.try_set_opacities(opacities).message.find("opacities[0]"), std::string::npos);
}

TEST_F(VolumeErrors, AreStatusesForThoseWithoutExceptions) {
  Status status;
  std::optional<VolumePass> pass = VolumePass::try_make({}, status);
  ASSERT_TRUE(pass && status.ok()) << status.message;
  const Occluders none;
  EXPECT_NE(pass->try_draw(none, g_buffer(), camera_, {}, {target_.name()}).message.find("radius"), std::string::npos);
  EXPECT_TRUE(pass->try_draw(none, g_buffer(), camera_, {.radius = 1}, {target_.name()}).ok());
  context_->release();
  EXPECT_FALSE(VolumePass::try_make({}, status).has_value());
  EXPECT_NE(status.message.find("no OpenGL context"), std::string::npos);
  context_->make_current();
}

TEST_F(VolumeErrors, NothingIsReadWhereNothingWasDrawn) {
  VolumePass pass;
  expect_error<std::runtime_error>("draw()", [&] { pass.read_fragment_counts(); });
  const Occluders none;
  pass.draw(none, g_buffer(), camera_, {.radius = 1}, {target_.name()});
  EXPECT_EQ(pass.read_fragment_counts().drawn, 0u);
}

}  // namespace
}  // namespace lkao::gl::tests::volumes_errors_test
