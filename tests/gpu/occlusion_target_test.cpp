// Where occlusion is written: every format and channel, as occlusion or visibility, and nothing beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/frame/format_names.h"
#include "gpu/in_furnished_room.h"
#include "lkao/gl/bilateral_filter.h"
#include "lut/random.h"

namespace lkao::gl::tests::occlusion_target_test {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 30;

struct Format {
  GLenum name;
  int component_count;
  float rounding;  // at most, of numbers from 0 to 1
};

constexpr Format kFormats[] = {
    {GL_R8, 1, 0.5f / 255},        {GL_R16, 1, 0.5f / 65535},      {GL_R16F, 1, 0x1p-11f},    {GL_R32F, 1, 0},
    {GL_RG8, 2, 0.5f / 255},       {GL_RG16, 2, 0.5f / 65535},     {GL_RG16F, 2, 0x1p-11f},   {GL_RG32F, 2, 0},
    {GL_RGBA8, 4, 0.5f / 255},     {GL_RGBA16, 4, 0.5f / 65535},   {GL_RGBA16F, 4, 0x1p-11f}, {GL_RGBA32F, 4, 0},
    {GL_RGB10_A2, 3, 0.5f / 1023}, {GL_R11F_G11F_B10F, 3, 0x1p-6f}};

class OcclusionTargets : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  void SetUp() override {
    InFurnishedRoom::SetUp();
    if (IsSkipped()) return;
    // From outside, so that some pixels show nothing.
    camera_.view = glm::lookAt(glm::vec3(0.3f, 1.9f, 12), glm::vec3(0, 1.3f, 0), glm::vec3(0, 1, 0));
    g_buffer_ = std::make_unique<GBufferPass>(mesh_, camera_, kWidth, kHeight);
    pass_ = std::make_unique<PassOnMesh>(
        make_pass(mesh_, PlaneMaskTable(SamplePattern::standard(100), {.resolution = 32})));
    pass_->draw(g_buffer_->by_positions(), camera_, {.radius = 2.0f});
    const Texture plain = make_image(GL_R32F, kWidth, kHeight);
    pass_->resolve({.occlusion = {plain.name(), -1}});
    for (const glm::vec4& texel : read_image(plain.name(), kWidth, kHeight)) occlusion_.push_back(texel.x);
    lut::RandomStream random(3);
    for (std::size_t i = 0; i < occlusion_.size(); ++i) {
      glm::vec4& texel = before_.emplace_back();
      for (int c = 0; c < 4; ++c) texel[c] = static_cast<float>(random.next_double());
    }
  }
  void TearDown() override {
    pass_.reset();
    InFurnishedRoom::TearDown();
  }

  std::unique_ptr<PassOnMesh> pass_;
  std::vector<float> occlusion_;  // -1: no receiver
  std::vector<glm::vec4> before_;
};

TEST_F(OcclusionTargets, OfEveryFormatAndChannelKeepTheRest) {
  ASSERT_GT(std::count(occlusion_.begin(), occlusion_.end(), -1), kWidth * kHeight / 20);
  for (const Format& format : kFormats) {
    for (int channel = 0; channel < format.component_count; ++channel) {
      for (const Quantity quantity : {Quantity::occlusion, Quantity::visibility}) {
        const Texture image = make_image(format.name, kWidth, kHeight, &before_[0].x);
        const std::vector<glm::vec4> before = read_image(image.name(), kWidth, kHeight);
        pass_->resolve({.occlusion = {.texture = image.name(),
                                      .background = 0.75f,
                                      .quantity = quantity,
                                      .channel = static_cast<Channel>(channel)}});
        const std::vector<glm::vec4> after = read_image(image.name(), kWidth, kHeight);
        for (std::size_t i = 0; i < after.size(); ++i) {
          const float occlusion = occlusion_[i], visibility = 1 - occlusion;
          const float expected = occlusion < 0 ? 0.75f : quantity == Quantity::visibility ? visibility : occlusion;
          ASSERT_NEAR(after[i][channel], expected, format.rounding + 1e-6f) << format_name(format.name) << channel;
          glm::vec4 others = after[i];
          others[channel] = before[i][channel];
          ASSERT_EQ(others, before[i]) << format_name(format.name) << channel;
        }
      }
    }
  }
}

// As an engine packs it: visibility in the alpha of its material's texture, smoothed in place.
TEST_F(OcclusionTargets, AreReadByTheFilterAsTheyWereWritten) {
  BilateralFilter filter;
  const Texture plain = make_image(GL_R32F, kWidth, kHeight),
                packed = make_image(GL_RGBA32F, kWidth, kHeight, &before_[0].x);
  pass_->resolve({.occlusion = {plain.name(), 0.25f}});
  filter.filter(g_buffer_->by_depth(), camera_, {plain.name()}, {plain.name(), 0.25f});
  const OcclusionTarget alpha{
      .texture = packed.name(), .background = 0.75f, .quantity = Quantity::visibility, .channel = Channel::alpha};
  pass_->resolve({.occlusion = alpha});
  filter.filter(g_buffer_->by_depth(), camera_, alpha, alpha);
  const std::vector<glm::vec4> expected = read_image(plain.name(), kWidth, kHeight);
  const std::vector<glm::vec4> found = read_image(packed.name(), kWidth, kHeight);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_NEAR(1 - found[i].w, expected[i].x, 1e-6f);
    ASSERT_EQ(glm::vec3(found[i]), glm::vec3(before_[i]));
  }
}

TEST_F(OcclusionTargets, ThatCannotBeAreRefused) {
  struct Mistake {
    GLenum format;
    Channel channel;
    const char* line;
  };
  const Mistake mistakes[] = {
      {GL_R8, Channel::green, "occlusion has no green component in the format GL_R8"},
      {GL_RG16F, Channel::blue, "occlusion has no blue component in the format GL_RG16F"},
      {GL_R11F_G11F_B10F, Channel::alpha, "occlusion has no alpha component in the format GL_R11F_G11F_B10F"},
      {GL_RGB10_A2, Channel::alpha, "occlusion cannot be in the alpha of GL_RGB10_A2: it has 2 bits"},
      {GL_SRGB8_ALPHA8, Channel::red,
       "occlusion cannot be written to the format GL_SRGB8_ALPHA8; GL_R8, GL_RGBA8 and GL_R16F are among those that it "
       "can be written to"},
  };
  for (const Mistake& bad : mistakes) {
    const Texture image = make_image(bad.format, kWidth, kHeight);
    try {
      pass_->resolve({.occlusion = {.texture = image.name(), .channel = bad.channel}});
      ADD_FAILURE() << "no exception: " << bad.line;
    } catch (const std::invalid_argument& error) {
      EXPECT_STREQ(error.what(), bad.line);
    }
  }
  for (const GLenum format : std::initializer_list<GLenum>{GL_RGB8, GL_R8UI, GL_R8_SNORM}) {
    const Texture image = make_image(format, kWidth, kHeight);
    EXPECT_THROW(pass_->resolve({.occlusion = {image.name()}}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace lkao::gl::tests::occlusion_target_test
