#include "cli/batch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/stopwatch.h"

namespace lkao::cli {
namespace {

// Rays of one part of a batch: enough to keep all threads busy, few enough for the progress bar to move.
constexpr std::size_t kRaysPerPart = std::size_t{1} << 21;

// One method, and what it has answered so far.
struct Runner {
  Runner(const Caster& runner_caster, std::size_t receiver_count) : caster(runner_caster), occlusion(receiver_count) {}

  void run(std::span<const Receiver> part, const QueryOutputs& outputs, std::uint64_t first_index) {
    const Stopwatch watch;
    const QueryReport report = caster.answer(part, outputs, first_index);
    seconds += watch.seconds();
    ray_count += report.ray_count;
    invalid_receiver_count += report.invalid_receiver_count;
  }

  const Caster& caster;
  std::vector<float> occlusion;
  double seconds = 0;
  std::uint64_t ray_count = 0;
  std::size_t invalid_receiver_count = 0;
};

BatchCheck make_check(const Runner& checked, const Runner& other, std::uint64_t mismatched_ray_count) {
  BatchCheck check;
  check.method = other.caster.method;
  check.mismatched_ray_count = mismatched_ray_count;
  if (checked.ray_count > 0) {
    check.ray_mismatch_rate = static_cast<double>(mismatched_ray_count) / static_cast<double>(checked.ray_count);
  }
  check.occlusion = image::compare(checked.occlusion, other.occlusion);
  check.seconds = other.seconds;
  return check;
}

}  // namespace

const char* name_of(Method method) {
  switch (method) {
    case Method::bvh:
      return "bvh";
    case Method::embree:
      return "embree";
    case Method::raster:
      break;
  }
  return "raster";
}

Method other_than(Method method) { return method == Method::embree ? Method::bvh : Method::embree; }

Answer answer_of(const AmbientOcclusion& ao) {
  return [&ao](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index) {
    return ao.query(receivers, outputs, first_index);
  };
}

Answer answer_of(const reference::EmbreeReference& embree, const AmbientOcclusion& ao) {
  return [&](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index) {
    return embree.query(ao, receivers, outputs, first_index);
  };
}

Batch run_batch(const Caster& caster, const SamplePattern& pattern, std::span<const Receiver> receivers,
                const BatchOptions& options, ProgressBar& progress) {
  Runner asked(caster, receivers.size());
  std::optional<Runner> other;
  if (options.check) other.emplace(*options.check, receivers.size());
  std::vector<glm::vec3> bent_normals(options.bent_normals ? receivers.size() : 0);
  std::uint64_t mismatched_ray_count = 0;

  const std::size_t part_size = kRaysPerPart / static_cast<std::size_t>(pattern.ray_count());
  const auto word_count = static_cast<std::size_t>(pattern.word_count());
  const std::size_t mask_size = options.check ? std::min(part_size, receivers.size()) * word_count : 0;
  std::vector<std::uint64_t> asked_masks(mask_size);
  std::vector<std::uint64_t> other_masks(mask_size);

  progress.begin("casting rays", receivers.size());
  for (std::size_t first = 0; first < receivers.size(); first += part_size) {
    const std::size_t count = std::min(part_size, receivers.size() - first);
    const auto part_of = [&](auto& values) { return std::span(values).subspan(first, count); };
    const auto masks_of = [&](auto& words) { return std::span(words).first(options.check ? count * word_count : 0); };

    QueryOutputs outputs{
        .occlusion = part_of(asked.occlusion), .bent_normals = {}, .mask_words = masks_of(asked_masks)};
    if (options.bent_normals) outputs.bent_normals = part_of(bent_normals);
    asked.run(receivers.subspan(first, count), outputs, first);
    if (other) {
      outputs = {.occlusion = part_of(other->occlusion), .bent_normals = {}, .mask_words = masks_of(other_masks)};
      other->run(receivers.subspan(first, count), outputs, first);
      mismatched_ray_count += reference::count_mismatched_rays(masks_of(asked_masks), masks_of(other_masks));
    }
    progress.advance(count);
  }

  Batch batch;
  if (other) batch.check = make_check(asked, *other, mismatched_ray_count);
  batch.occlusion = std::move(asked.occlusion);
  batch.bent_normals = std::move(bent_normals);
  batch.ray_count = asked.ray_count;
  batch.invalid_receiver_count = asked.invalid_receiver_count;
  batch.seconds = asked.seconds;
  return batch;
}

double Batch::occlusion_mean() const {
  double sum = 0;
  std::size_t count = 0;
  for (const float value : occlusion) {
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

double mrays_per_second(std::uint64_t ray_count, double seconds) {
  return seconds > 0 ? static_cast<double>(ray_count) / seconds / 1e6 : 0;
}

}  // namespace lkao::cli
