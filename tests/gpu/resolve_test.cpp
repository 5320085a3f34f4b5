// From masks to images: occlusion and bent normals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/in_furnished_room.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::resolve_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(64, 32);
constexpr int kHeight = lkao::tests::unless_sanitized(48, 24);

class Resolve : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  // The CPU's answers for all pixels; NaN where there is no receiver.
  void query(const std::vector<Receiver>& receivers, const SamplePattern& pattern, const RayOptions& options) {
    occlusion_.resize(receivers.size());
    bent_normals_.resize(receivers.size());
    AmbientOcclusion(OccluderBvh(mesh_.view()), pattern, options)
        .query(receivers, {.occlusion = occlusion_, .bent_normals = bent_normals_});
  }

  // Two tolerances: no pixel is off by more than `largest`, few by more than `small`.
  void expect_occlusion(const Texture& image, float small, float largest, float background) const {
    const std::vector<glm::vec4> pixels = read_image(image.name(), kWidth, kHeight);
    std::size_t off_count = 0;
    float worst = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const float expected = std::isnan(occlusion_[i]) ? background : occlusion_[i];
      const float difference = std::fabs(pixels[i].x - expected);
      off_count += !(difference <= small);
      worst = std::max(worst, difference);
    }
    EXPECT_LE(off_count, pixels.size() / 500);
    EXPECT_LE(worst, largest);
  }

  std::vector<float> occlusion_;
  std::vector<glm::vec3> bent_normals_;
};

TEST_F(Resolve, GivesTheCpusOcclusionInEveryFormat) {
  for (const int ray_count : {64, 100, 128, 256}) {
    const PlaneMaskTable table(SamplePattern::standard(ray_count), {.resolution = 32});
    PassOnMesh pass = make_pass(mesh_, table);
    const RayOptions options{.radius = 1.0f};
    pass.draw(g_buffer_->by_positions(), camera_, options);
    query(g_buffer_->receivers(), table.pattern(), options);
    const float one_ray = 1.0f / static_cast<float>(ray_count);
    for (const auto& [format, rounding] :
         {std::pair{GL_R8, 0.5f / 255}, {GL_R16, 0.5f / 65535}, {GL_R16F, 0x1p-11f}, {GL_R32F, 0.0f}}) {
      const Texture image = make_image(static_cast<GLenum>(format), kWidth, kHeight);
      pass.resolve({.occlusion = {image.name(), 0.25f}});
      expect_occlusion(image, rounding + 1e-6f, 3 * one_ray + rounding, 0.25f);
    }
  }
}

TEST_F(Resolve, GivesTheCpusBentNormals) {
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  const RayOptions options{.radius = 1.0f};
  pass.draw(g_buffer_->by_positions(), camera_, options);
  query(g_buffer_->receivers(), table.pattern(), options);
  for (const GLenum format : std::initializer_list<GLenum>{GL_RGBA16F, GL_RGBA32F}) {
    const Texture image = make_image(format, kWidth, kHeight), occlusion = make_image(GL_R32F, kWidth, kHeight);
    pass.resolve({.occlusion = {occlusion.name()}, .bent_normals = image.name()});
    const std::vector<glm::vec4> pixels = read_image(image.name(), kWidth, kHeight);
    std::size_t off_count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const glm::vec4 expected = std::isnan(occlusion_[i]) ? glm::vec4(0) : glm::vec4(bent_normals_[i], 1);
      off_count += glm::length(pixels[i] - expected) > (format == GL_RGBA16F ? 1e-3f : 1e-5f);
    }
    EXPECT_LE(off_count, pixels.size() / 500);
  }
}

TEST_F(Resolve, CountsOnlyTheRaysThatAreCast) {
  std::vector<Receiver> receivers = g_buffer_->receivers();
  std::vector<glm::vec4> normals;
  for (Receiver& receiver : receivers) {
    // So far over that half of the pattern is below the surface.
    receiver.geometric_normal = receiver.normal;
    const float length = glm::length(receiver.normal);
    receiver.normal = glm::vec3(receiver.normal.y, receiver.normal.z, receiver.normal.x) + 0.2f * receiver.normal;
    if (length == 0) receiver.normal = glm::vec3(0);
    normals.emplace_back(receiver.normal, 0);
  }
  const Texture normal_image = make_image(GL_RGBA32F, kWidth, kHeight, &normals[0].x);
  GBuffer textures = g_buffer_->by_positions();
  textures.geometric_normals = textures.normals;
  textures.normals = normal_image.name();
  const PlaneMaskTable table(SamplePattern::standard(128), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  const RayOptions options{.radius = 1.0f};
  pass.draw(textures, camera_, options);
  query(receivers, table.pattern(), options);
  const Texture image = make_image(GL_R32F, kWidth, kHeight);
  pass.resolve({.occlusion = {image.name(), std::numeric_limits<float>::infinity()}});
  const std::vector<glm::vec4> pixels = read_image(image.name(), kWidth, kHeight);
  std::size_t off_count = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    off_count += std::isnan(occlusion_[i]) ? !std::isinf(pixels[i].x) : std::fabs(pixels[i].x - occlusion_[i]) > 1e-6f;
  }
  EXPECT_LE(off_count, pixels.size() / 500);
}

TEST_F(Resolve, OfAnEmptySceneIsOpen) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass;
  pass.set_table(table);
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight), bent = make_image(GL_RGBA32F, kWidth, kHeight);
  for (int i = 0; i < 2; ++i) {
    pass.draw(g_buffer_->by_positions(), camera_, {.radius = 1.0f});
    pass.resolve({.occlusion = {occlusion.name()}, .bent_normals = bent.name()});
    EXPECT_EQ(count_bits(pass.read_masks()), 0u);
    for (const glm::vec4& pixel : read_image(occlusion.name(), kWidth, kHeight)) ASSERT_EQ(pixel.x, 0.0f);
    pass.occluders = Occluders({}, {});
  }
}

TEST_F(Resolve, TakesImagesOfOddSizes) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  // The room without its small things.
  Mesh mesh = mesh_;
  mesh.triangles.resize(12);
  PassOnMesh pass = make_pass(mesh, table);
  for (const auto& [width, height] :
       {std::pair{1, 1}, lkao::tests::unless_sanitized(std::pair{511, 383}, {127, 95}), {3, 200}, {1, 1}}) {
    const Camera camera = room_camera(width, height);
    const GBufferPass g_buffer(mesh, camera, width, height);
    const RayOptions options{.radius = 1.5f};
    pass.draw(g_buffer.by_positions(), camera, options);
    const auto masks = pass.read_masks();
    ASSERT_EQ(masks.size(), static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto expected = cpu_masks(mesh, g_buffer.receivers(), table.pattern(), options);
    EXPECT_LE(count_differences(masks, expected), masks.size() * 64 / 10000);
    const Texture image = make_image(GL_R32F, width, height);
    pass.resolve({.occlusion = {image.name()}});
    const auto pixels = read_image(image.name(), width, height);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      ASSERT_FLOAT_EQ(pixels[i].x, static_cast<float>(count_bits({masks[i]})) / 64) << i;
    }
  }
}

}  // namespace
}  // namespace lkao::gl::tests::resolve_test
