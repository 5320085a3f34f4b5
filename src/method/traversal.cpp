// The library's own method: one traversal of a hierarchy for all rays of a receiver.
#include <optional>

#include "lkao/isa.h"
#include "method/hidden_share.h"
#include "method/kernel_setting.h"
#include "method/kinds.h"
#include "method/stopwatch.h"

namespace lkao::method {
namespace {

bool has_table(KernelChoice kernel) { return kernel == KernelChoice::table || kernel == KernelChoice::nearest; }

AmbientOcclusion make_query(Occluders& occluders, const Question& question, KernelChoice kernel) {
  const std::vector<OccluderLevel>& levels = occluders.hierarchies();
  if (has_table(kernel)) {
    const PlaneMasks masks = kernel == KernelChoice::table ? PlaneMasks::must_may : PlaneMasks::nearest;
    return {levels.front().occluders, question.table(masks), question.ray_options()};
  }
  return {levels, question.pattern(), question.ray_options(),
          kernel == KernelChoice::scalar ? Kernel::scalar : Kernel::simd};
}

SoftShadows make_shadows(Occluders& occluders, const Question& question, KernelChoice kernel) {
  return {occluders.hierarchies().front().occluders, *question.light, question.pattern(), question.shadow_options(),
          kernel == KernelChoice::scalar ? Kernel::scalar : Kernel::simd};
}

// Tables have all lengths as shares of the radius, and one hierarchy.
Abilities abilities(const Settings& settings) {
  const bool is_free = !has_table(kernel_of(settings));
  return {.levels = is_free, .infinite_lengths = is_free, .lights = is_free, .holes = true};
}

class Traversal : public Method {
 public:
  explicit Traversal(const Settings& settings) : Method(method::abilities(settings)), kernel_(kernel_of(settings)) {}

  void prepare(const Task& task) override {
    query_.reset();
    shadows_.reset();
    if (task.question.light) {
      shadows_.emplace(make_shadows(task.occluders, task.question, kernel_));
    } else {
      query_.emplace(make_query(task.occluders, task.question, kernel_));
    }
  }

  Answered answer(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                  std::uint64_t first_index) override {
    if (shadows_) {
      return answer_hidden_share(
          outputs, [&](const ShadowOutputs& shares) { return shadows_->query(receivers, shares, first_index); });
    }
    const Stopwatch watch;
    const QueryReport report = query_.value().query(receivers, outputs, first_index);
    return {report, watch.seconds()};
  }

  Remarks remarks() const override { return kernel_remarks(kernel_); }

 private:
  KernelChoice kernel_;
  std::optional<AmbientOcclusion> query_;  // one of these
  std::optional<SoftShadows> shadows_;
};

}  // namespace

const Setting& kernel_setting() {
  static const Setting setting =
      word_setting("kernel",
                   "What answers: simd; scalar, the definition; table, the paper's look-ups, exact; nearest, the same, "
                   "approximate",
                   kKernelWords, KernelChoice::simd);
  return setting;
}

KernelChoice kernel_of(const Settings& settings) { return settings.value(kernel_setting(), kKernelWords); }

Remarks kernel_remarks(KernelChoice kernel) {
  return {.keys = {{"kernel", word_of(kKernelWords, kernel)}, {"isa", active_isa()}}};
}

MethodKind traversal_kind() {
  return {.summary = "the library's traversal",
          .settings = {&kernel_setting()},
          .abilities = abilities,
          .open = [](const Settings& settings) -> std::unique_ptr<Method> {
            return std::make_unique<Traversal>(settings);
          }};
}

}  // namespace lkao::method
