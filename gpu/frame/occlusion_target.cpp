#include "gpu/frame/occlusion_target.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "gpu/frame/format_names.h"
#include "gpu/frame/texture_checks.h"
#include "gpu/frame/units.h"

namespace lkao::gl {
namespace {

// Those of an image unit that shaders see as floats of 0 and more.
constexpr GLenum kImageFormats[] = {GL_R8,      GL_R16,     GL_R16F,     GL_R32F,          GL_RG8,
                                    GL_RG16,    GL_RG16F,   GL_RG32F,    GL_RGBA8,         GL_RGBA16,
                                    GL_RGBA16F, GL_RGBA32F, GL_RGB10_A2, GL_R11F_G11F_B10F};

constexpr const char* kChannelNames[] = {"red", "green", "blue", "alpha"};

void require_channel(const OcclusionTarget& target) {
  const GLenum format = format_of(target.texture);
  const int channel = static_cast<int>(target.channel);
  if (!has_component(target.texture, channel)) {
    throw std::invalid_argument(
        fmt::format("occlusion has no {} component in the format {}", kChannelNames[channel], format_name(format)));
  }
  if (format == GL_RGB10_A2 && target.channel == Channel::alpha) {
    throw std::invalid_argument("occlusion cannot be in the alpha of GL_RGB10_A2: it has 2 bits");
  }
}

}  // namespace

glm::vec4 steps_to_one(ObjectName texture) {
  glm::vec4 steps{0};
  if (texture == 0 || !is_unorm(texture)) return steps;
  for (int component = 0; component < 4; ++component) steps[component] = step_count(texture, component);
  return steps;
}

void validate(const OcclusionTarget& target, int width, int height) {
  require_size("occlusion", target.texture, {width, height, target.part});
  const GLenum format = format_of(target.texture);
  if (std::find(std::begin(kImageFormats), std::end(kImageFormats), format) == std::end(kImageFormats)) {
    throw std::invalid_argument(
        fmt::format("occlusion cannot be written to the format {}; GL_R8, GL_RGBA8 and GL_R16F are among those that it "
                    "can be written to",
                    format_name(format)));
  }
  require_channel(target);
}

void validate_source(const OcclusionTarget& source, int width, int height) {
  require_readable("occlusion", source.texture, {width, height, source.part}, 1, Use::value);
  require_channel(source);
}

void bind(const OcclusionTarget& target, const UniformBuffer<TargetBlock>& block, const Sampler& plain_sampler) {
  TargetBlock values{};
  const Part first = target.part.value_or(Part{});
  values.first_x = first.x;
  values.first_y = first.y;
  values.channel = static_cast<int>(target.channel);
  values.keeps_others = target.texture != 0 && has_component(target.texture, 1);
  values.is_visibility = target.quantity == Quantity::visibility;
  values.background = target.background;
  values.steps = steps_to_one(target.texture);
  block.set_and_bind(values);
  if (target.texture != 0) bind_image(LKAO_IMAGE_TARGET, target.texture);
  if (values.keeps_others != 0) glBindTextureUnit(LKAO_UNIT_TARGET, target.texture);
  glBindSampler(LKAO_UNIT_TARGET, plain_sampler.name());
}

void bind_image(unsigned unit, ObjectName texture) {
  glBindImageTexture(unit, texture, 0, GL_FALSE, 0, GL_WRITE_ONLY, format_of(texture));
}

void begin_writing_targets() { glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT); }

void end_writing_targets() {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT);
}

}  // namespace lkao::gl
