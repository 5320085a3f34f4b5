#include "c_api/convert.h"

#include <algorithm>
#include <cstring>
#include <string>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "c_api/errors.h"
#include "c_api/versioned.h"
#include "c_api/words.h"

namespace lkao::c_api {

Falloff falloff_of(const lkao_falloff* falloff, const char* name) {
  const lkao_falloff read_falloff = read(falloff, LKAO_FALLOFF_INIT, name);
  switch (read_falloff.kind) {
    case LKAO_FALLOFF_CONSTANT:
      return Falloff::constant();
    case LKAO_FALLOFF_LINEAR:
      return Falloff::linear();
    case LKAO_FALLOFF_SMOOTH:
      return Falloff::smooth();
    case LKAO_FALLOFF_EXPONENTIAL:
      return Falloff::exponential(read_falloff.rate);
    case LKAO_FALLOFF_CUSTOM: {
      const lkao_falloff_function function = needed(read_falloff.function, (std::string(name) + "->function").c_str());
      return Falloff::custom("custom", [function, user = read_falloff.user](double x) { return function(user, x); });
    }
    default:
      refuse(std::string(name) + "->kind must be 0 to 4, not " + std::to_string(read_falloff.kind));
  }
}

RayOptions ray_options_of(const lkao_ray_options* options) {
  const lkao_ray_options from = read(options, LKAO_RAY_OPTIONS_INIT, "options");
  return {.radius = from.radius,
          .sidedness = word(kSidednesses, from.sidedness, "options->sidedness"),
          .jitter = {.rotation = from.jitter_rotation, .tilt = from.jitter_tilt},
          .seed = from.seed,
          .surface_offset = from.surface_offset,
          .min_distance = from.min_distance};
}

lkao_ray_options c_options_of(const RayOptions& options) {
  lkao_ray_options result = LKAO_RAY_OPTIONS_INIT;
  result.radius = options.radius;
  result.sidedness = number_of(kSidednesses, options.sidedness);
  result.jitter_rotation = options.jitter.rotation;
  result.jitter_tilt = options.jitter.tilt;
  result.seed = options.seed;
  result.surface_offset = options.surface_offset;
  result.min_distance = options.min_distance;
  return result;
}

Receiver receiver_of(const lkao_receiver* receiver) {
  const lkao_receiver from = read(receiver, LKAO_RECEIVER_INIT, "receiver");
  const float *p = from.position, *n = from.normal, *g = from.geometric_normal;
  return {.position = {p[0], p[1], p[2]},
          .normal = {n[0], n[1], n[2]},
          .geometric_normal = {g[0], g[1], g[2]},
          .excluded_primitive = from.excluded_primitive,
          .excluded_instance = from.excluded_instance,
          .occluder_groups = from.occluder_groups};
}

lkao_answer c_answer_of(const ReceiverOcclusion& answer) {
  lkao_answer result = LKAO_ANSWER_INIT;
  static_assert(sizeof(result.mask) == sizeof(answer.mask.words));
  std::memcpy(result.mask, answer.mask.words, sizeof(result.mask));
  result.occlusion = answer.occlusion;
  std::memcpy(result.bent_normal, &answer.bent_normal, sizeof(result.bent_normal));
  return result;
}

Progress progress_of(lkao_progress progress, void* user) {
  if (progress == nullptr) return {};
  return [progress, user](std::size_t done, std::size_t total) { return progress(user, done, total) != 0; };
}

void check_mask(const SamplePattern& pattern, const std::uint64_t* words, std::size_t word_count) {
  needed(words, "mask");
  const auto least = static_cast<std::size_t>(pattern.word_count());
  if (word_count >= least) return;
  refuse("word_count must be at least the pattern's, " + std::to_string(least) + ", not " + std::to_string(word_count));
}

void write_mask(const OcclusionMask& mask, const SamplePattern& pattern, std::uint64_t* words, std::size_t word_count) {
  const auto needed_count = static_cast<std::size_t>(pattern.word_count());
  std::copy_n(mask.words, needed_count, words);
  std::fill(words + needed_count, words + word_count, 0);
}

void write_words(const OcclusionMask& mask, std::uint64_t* words, std::size_t word_count) {
  const std::size_t own_count = std::min<std::size_t>(word_count, OcclusionMask::kMaxWordCount);
  std::copy_n(mask.words, own_count, words);
  std::fill(words + own_count, words + word_count, 0);
}

lkao_rays c_rays_of(const ReceiverRays& rays) {
  lkao_rays result = LKAO_RAYS_INIT;
  std::memcpy(result.origin, &rays.origin, sizeof(result.origin));
  std::memcpy(result.frame, &rays.frame, sizeof(result.frame));
  std::memcpy(result.up, &rays.up, sizeof(result.up));
  std::memcpy(result.cast, rays.cast.words, sizeof(result.cast));
  result.radius = rays.radius;
  result.ray_count = rays.ray_count;
  return result;
}

void write_rays(const ReceiverRays& from, lkao_rays* rays, const Strided<float, 3>& segments) {
  if (rays != nullptr) write(c_rays_of(from), rays);
  if (!segments) return;
  for (int i = 0; i < from.ray_count; ++i) {
    const glm::vec3 segment = from.ray(i);
    segments.set(static_cast<std::size_t>(i), &segment);
  }
}

void run_on_threads(std::int32_t thread_count, const char* name, const std::function<void()>& body) {
  constexpr std::int32_t kMost = 4096;
  check_range(thread_count, 0, kMost, name);
  if (thread_count == 0) return body();
  // More than oneTBB has are not only useless: it would print a warning.
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(static_cast<int>(std::min(static_cast<std::size_t>(thread_count), allowed)));
  arena.execute(body);
}

}  // namespace lkao::c_api
