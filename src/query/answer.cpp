#include "query/answer.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "query/bent_normal.h"
#include "query/ray_count.h"

namespace lkao::query {

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

glm::vec3 bent_normal_of(const SamplePattern& pattern, const Receiver& receiver, const ReceiverRays& rays,
                         const OcclusionMask& blocked) {
  return rays.cast.any() ? bent_normal(pattern, rays, blocked, receiver.normal) : glm::vec3(kNaN);
}

}  // namespace

float occlusion_of(const ReceiverRays& rays, const OcclusionMask& blocked) {
  const int cast_count = ray_count_of(rays.cast, rays);
  return cast_count > 0 ? static_cast<float>(ray_count_of(blocked, rays)) / static_cast<float>(cast_count) : kNaN;
}

ReceiverOcclusion make_answer(const SamplePattern& pattern, const Receiver& receiver, const ReceiverRays& rays,
                              const OcclusionMask& blocked) {
  return {occlusion_of(rays, blocked), bent_normal_of(pattern, receiver, rays, blocked), blocked};
}

void require_sizes(const QueryOutputs& outputs, std::size_t receiver_count, int word_count) {
  const auto require = [](const char* name, std::size_t size, std::size_t wanted) {
    if (size != 0 && size != wanted) {
      throw std::invalid_argument(fmt::format("outputs.{} has {} entries, not 0 or {}", name, size, wanted));
    }
  };
  require("occlusion", outputs.occlusion.size(), receiver_count);
  require("bent_normals", outputs.bent_normals.size(), receiver_count);
  require("mask_words", outputs.mask_words.size(), receiver_count * static_cast<std::size_t>(word_count));
}

void store(const QueryOutputs& outputs, std::size_t k, const SamplePattern& pattern, const Receiver& receiver,
           const ReceiverRays& rays, const OcclusionMask& blocked) {
  if (!outputs.occlusion.empty()) outputs.occlusion[k] = occlusion_of(rays, blocked);
  if (!outputs.bent_normals.empty()) outputs.bent_normals[k] = bent_normal_of(pattern, receiver, rays, blocked);
  if (!outputs.mask_words.empty()) {
    const auto words = static_cast<std::size_t>(pattern.word_count());
    std::copy_n(blocked.words, words, outputs.mask_words.begin() + static_cast<std::ptrdiff_t>(k * words));
  }
}

void count(QueryReport& report, const ReceiverRays& rays, const OcclusionMask& blocked) {
  const int cast_count = ray_count_of(rays.cast, rays);
  ++report.receiver_count;
  report.invalid_receiver_count += cast_count == 0;
  report.ray_count += static_cast<std::uint64_t>(cast_count);
  report.blocked_ray_count += static_cast<std::uint64_t>(ray_count_of(blocked, rays));
}

}  // namespace lkao::query
