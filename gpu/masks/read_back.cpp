// What a pass lets its caller read.
#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec4.hpp>

#include "gpu/gl/error.h"
#include "gpu/masks/mask_pass_state.h"

namespace lkao::gl {
namespace {

template <typename Texel>
std::vector<Texel> read_layer(const MaskImages& images, GLuint texture, int layer, GLenum format, GLenum type) {
  std::vector<Texel> texels(static_cast<std::size_t>(images.width()) * static_cast<std::size_t>(images.height()));
  glGetTextureSubImage(texture, 0, 0, 0, layer, images.width(), images.height(), 1, format, type,
                       static_cast<GLsizei>(texels.size() * sizeof(Texel)), texels.data());
  check_errors("reading a texture");
  return texels;
}

std::uint64_t word_of(std::uint32_t low, std::uint32_t high) { return low | std::uint64_t{high} << 32; }

}  // namespace

std::vector<std::uint64_t> MaskPass::read_masks() {
  require_clean_context(state_->setup.host_errors);
  state_->require_drawn();
  const StateKeeper keeper(kReadUse, state_->setup.keep_state);
  const MaskImages& images = state_->images;
  const auto words = static_cast<std::size_t>(state_->table->table().pattern().word_count());
  std::vector<std::uint64_t> masks;
  for (std::size_t k = 0; k < static_cast<std::size_t>(images.layer_count()); ++k) {
    const auto texels =
        read_layer<glm::uvec4>(images, images.masks(), static_cast<int>(k), GL_RGBA_INTEGER, GL_UNSIGNED_INT);
    masks.resize(texels.size() * words);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      masks[i * words + 2 * k] = word_of(texels[i].x, texels[i].y);
      // The last layer may hold 64 rays or fewer.
      if (2 * k + 1 < words) masks[i * words + 2 * k + 1] = word_of(texels[i].z, texels[i].w);
    }
  }
  return masks;
}

std::vector<PixelReceiver> MaskPass::read_receivers() {
  require_clean_context(state_->setup.host_errors);
  state_->require_drawn();
  const StateKeeper keeper(kReadUse, state_->setup.keep_state);
  const MaskImages& images = state_->images;
  std::array<std::vector<glm::vec4>, LKAO_RECEIVER_LAYER_COUNT> layers;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    layers[k] = read_layer<glm::vec4>(images, images.receivers(), static_cast<int>(k), GL_RGBA, GL_FLOAT);
  }
  std::vector<PixelReceiver> receivers(layers[0].size());
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    PixelReceiver& receiver = receivers[i];
    const glm::vec4& origin = layers[LKAO_RECEIVER_ORIGIN][i];
    receiver.is_valid = origin.w > 0.1f * static_cast<float>(LKAO_NO_RECEIVER);
    receiver.origin = origin;
    for (int axis = 0; axis < 3; ++axis) {
      const glm::vec4& texel = layers[static_cast<std::size_t>(LKAO_RECEIVER_FRAME + axis)][i];
      receiver.frame[axis] = texel;
      receiver.up[axis] = texel.w;
    }
  }
  return receivers;
}

FragmentCounts MaskPass::read_fragment_counts() {
  require_clean_context(state_->setup.host_errors);
  state_->require_drawn();
  if (!state_->setup.count_fragments) return {};
  const auto [drawn, survivors, masks] = state_->counters.read();
  return {drawn, survivors, masks};
}

}  // namespace lkao::gl
