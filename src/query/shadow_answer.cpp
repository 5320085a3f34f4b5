#include "query/shadow_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "query/ray_count.h"

namespace lkao::query {

LightVisibility make_shadow_answer(bool is_valid, const ReceiverRays& rays, const OcclusionMask& blocked) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  if (!is_valid) return {kUnknown, kUnknown, {}};
  const int cast_count = ray_count_of(rays.cast, rays), seen_count = cast_count - ray_count_of(blocked, rays);
  const auto share = [&](int some) { return static_cast<float>(some) / static_cast<float>(rays.ray_count); };
  return {share(seen_count), share(cast_count), blocked};
}

void require_sizes(const ShadowOutputs& outputs, std::size_t receiver_count, int word_count) {
  const auto require = [](const char* name, std::size_t size, std::size_t wanted) {
    if (size != 0 && size != wanted) {
      throw std::invalid_argument(fmt::format("outputs.{} has {} entries, not 0 or {}", name, size, wanted));
    }
  };
  require("visibility", outputs.visibility.size(), receiver_count);
  require("above_horizon", outputs.above_horizon.size(), receiver_count);
  require("mask_words", outputs.mask_words.size(), receiver_count * static_cast<std::size_t>(word_count));
}

void store(const ShadowOutputs& outputs, std::size_t k, int word_count, const LightVisibility& answer) {
  if (!outputs.visibility.empty()) outputs.visibility[k] = answer.visibility;
  if (!outputs.above_horizon.empty()) outputs.above_horizon[k] = answer.above_horizon;
  if (!outputs.mask_words.empty()) {
    const auto words = static_cast<std::size_t>(word_count);
    std::copy_n(answer.blocked.words, words, outputs.mask_words.begin() + static_cast<std::ptrdiff_t>(k * words));
  }
}

void count(QueryReport& report, const ReceiverRays& rays, const LightVisibility& answer) {
  ++report.receiver_count;
  report.invalid_receiver_count += std::isnan(answer.visibility);
  report.ray_count += static_cast<std::uint64_t>(ray_count_of(rays.cast, rays));
  report.blocked_ray_count += static_cast<std::uint64_t>(ray_count_of(answer.blocked, rays));
}

}  // namespace lkao::query
