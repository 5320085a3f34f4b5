#include "method/batch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reference/embree_reference.h"

namespace lkao::method {
namespace {

// Rays of one part of a batch: enough to keep all threads busy, few enough for progress to be seen.
constexpr std::size_t kRaysPerPart = std::size_t{1} << 21;

// Receivers [first, first + count).
struct Part {
  std::size_t first;
  std::size_t count;

  template <class Value>
  std::span<Value> of(std::span<Value> all) const {
    return all.empty() ? all : all.subspan(first, count);
  }
};

// One method, and what it has answered so far.
class Runner {
 public:
  Runner(Method& method, std::size_t receiver_count, bool with_bent_normals)
      : occlusion(receiver_count), bent_normals(with_bent_normals ? receiver_count : 0), method_(method) {}

  // `masks` is for this part alone; empty: not wanted.
  void run(std::span<const Receiver> receivers, const Part& part, std::span<std::uint64_t> masks) {
    const QueryOutputs outputs{.occlusion = part.of(std::span(occlusion)),
                               .bent_normals = part.of(std::span(bent_normals)),
                               .mask_words = masks};
    const Answered answered = method_.answer(part.of(receivers), outputs, part.first);
    seconds += answered.seconds;
    ray_count += answered.report.ray_count;
    invalid_receiver_count += answered.report.invalid_receiver_count;
  }

  std::vector<float> occlusion;
  std::vector<glm::vec3> bent_normals;
  double seconds = 0;
  std::uint64_t ray_count = 0;
  std::size_t invalid_receiver_count = 0;

 private:
  Method& method_;
};

// Compares the masks of a method and its check, part by part.
class MaskComparison {
 public:
  // Nothing is compared unless both tell ray by ray.
  MaskComparison(const Method& method, const Method* check, std::size_t word_count)
      : is_on_(check != nullptr && method.abilities().masks && check->abilities().masks), word_count_(word_count) {}

  void begin(std::size_t receiver_count) {
    if (!is_on_) return;
    asked_.resize(receiver_count * word_count_);
    other_.resize(receiver_count * word_count_);
  }
  std::span<std::uint64_t> asked() { return asked_; }
  std::span<std::uint64_t> other() { return other_; }
  void end() { wrong_ray_count_ += reference::count_mismatched_rays(asked_, other_); }

  std::optional<std::uint64_t> wrong_ray_count() const {
    return is_on_ ? std::optional(wrong_ray_count_) : std::nullopt;
  }

 private:
  bool is_on_;
  std::size_t word_count_;
  std::vector<std::uint64_t> asked_, other_;
  std::uint64_t wrong_ray_count_ = 0;
};

std::size_t part_size(const Method& method, const Method* check, std::size_t word_count, std::size_t receiver_count) {
  const bool is_whole = !method.abilities().any_receivers || (check != nullptr && !check->abilities().any_receivers);
  return is_whole ? std::max<std::size_t>(receiver_count, 1) : kRaysPerPart / (64 * word_count);
}

// Of `function` of the occlusion of valid receivers; NaN where there is none.
template <class Function>
double mean_of_valid(std::span<const float> occlusion, const Function& function) {
  double sum = 0;
  std::size_t count = 0;
  for (const float value : occlusion) {
    if (std::isnan(value)) continue;
    sum += function(value);
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

}  // namespace

Batch run_batch(Method& method, int ray_count, std::span<const Receiver> receivers, const BatchOptions& options) {
  Runner asked(method, receivers.size(), options.bent_normals);
  std::optional<Runner> other;
  if (options.check != nullptr) other.emplace(*options.check, receivers.size(), false);
  const auto word_count = static_cast<std::size_t>(word_count_of(ray_count));
  MaskComparison masks(method, options.check, word_count);

  const std::size_t size = part_size(method, options.check, word_count, receivers.size());
  for (std::size_t first = 0; first < receivers.size(); first += size) {
    const Part part{first, std::min(size, receivers.size() - first)};
    masks.begin(part.count);
    asked.run(receivers, part, masks.asked());
    if (other) {
      other->run(receivers, part, masks.other());
      masks.end();
    }
    if (options.progress && !options.progress(first + part.count, receivers.size())) throw Cancelled();
  }

  Batch batch;
  if (other) {
    batch.check = {deviation(asked.occlusion, other->occlusion, masks.wrong_ray_count(), asked.ray_count),
                   other->seconds};
  }
  batch.occlusion = std::move(asked.occlusion);
  batch.bent_normals = std::move(asked.bent_normals);
  batch.ray_count = asked.ray_count;
  batch.invalid_receiver_count = asked.invalid_receiver_count;
  batch.seconds = asked.seconds;
  return batch;
}

double Batch::occlusion_mean() const {
  return mean_of_valid(occlusion, [](float value) { return static_cast<double>(value); });
}

double Batch::fully_blocked_share() const {
  return mean_of_valid(occlusion, [](float value) { return value >= 1 ? 1.0 : 0.0; });
}

}  // namespace lkao::method
