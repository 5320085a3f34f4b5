// The reference: the rays of the library's query, cast one by one through Embree, among the whole scene.
#include <optional>

#include "method/hidden_share.h"
#include "method/kernel_setting.h"
#include "method/kinds.h"
#include "method/stopwatch.h"
#include "reference/embree_reference.h"

namespace lkao::method {
namespace {

Abilities embree_abilities(const Settings&) { return {.levels = false, .lights = true, .holes = true}; }

class Embree : public Method {
 public:
  explicit Embree(const Settings& settings) : Method(embree_abilities(settings)), kernel_(kernel_of(settings)) {}

  void prepare(const Task& task) override {
    const Question& question = task.question;
    query_.reset();
    shadows_.reset();
    if (question.light) {
      shadows_.emplace(task.occluders.hierarchies().front().occluders, *question.light, question.pattern(),
                       question.shadow_options());
    } else {
      query_.emplace(task.occluders.hierarchies(), question.pattern(), question.ray_options());
    }
    const Stopwatch watch;
    embree_.emplace(task.occluders.mesh());
    build_seconds_ = watch.seconds();
  }

  double build_seconds() const override { return build_seconds_; }

  Answered answer(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                  std::uint64_t first_index) override {
    if (shadows_) {
      return answer_hidden_share(outputs, [&](const ShadowOutputs& shares) {
        return embree_.value().query(*shadows_, receivers, shares, first_index);
      });
    }
    const Stopwatch watch;
    const QueryReport report = embree_.value().query(query_.value(), receivers, outputs, first_index);
    return {report, watch.seconds()};
  }

  Remarks remarks() const override { return kernel_remarks(kernel_); }

 private:
  KernelChoice kernel_;
  std::optional<AmbientOcclusion> query_;  // whose rays are cast: one of these
  std::optional<SoftShadows> shadows_;
  std::optional<reference::EmbreeReference> embree_;
  double build_seconds_ = 0;
};

}  // namespace

MethodKind embree_kind() {
  return {
      .summary = "the same rays one by one, through Embree",
      .settings = {&kernel_setting()},  // of the traversal that it is checked against
      .abilities = embree_abilities,
      .open = [](const Settings& settings) -> std::unique_ptr<Method> { return std::make_unique<Embree>(settings); }};
}

}  // namespace lkao::method
