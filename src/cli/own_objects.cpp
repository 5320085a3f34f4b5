#include "cli/own_objects.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "method/occluders.h"
#include "method/stopwatch.h"

namespace lkao::cli {
namespace {

using method::Answered, method::Method, method::Task;

// Receivers [begin, end), all of one object.
struct Run {
  std::size_t begin, end;
  QueryReport report = {};

  template <class Value>
  std::span<Value> of(std::span<Value> all, std::size_t each = 1) const {
    return all.empty() ? all : all.subspan(begin * each, (end - begin) * each);
  }
};

std::vector<Run> runs_of(std::span<const Receiver> receivers) {
  std::vector<Run> runs;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    const bool goes_on = k > 0 && receivers[k].excluded_instance == receivers[k - 1].excluded_instance;
    if (!goes_on) runs.push_back({k, k});
    runs.back().end = k + 1;
  }
  return runs;
}

class OwnObjects final : public Method {
 public:
  explicit OwnObjects(const MethodOptions& options)
      : Method(options.kind->abilities(options.settings)), options_(options) {}

  void prepare(const Task& task) override {
    build_seconds_ = 0;
    methods_.clear();
    for (const scene::Mesh& object : scene::split_by_objects(task.occluders.mesh())) {
      method::Occluders occluders(object);
      methods_.push_back(options_.kind->open(options_.settings));
      methods_.back()->prepare({occluders, task.question});
      build_seconds_ += occluders.build_seconds();
    }
  }
  double build_seconds() const override { return build_seconds_; }

  Answered answer(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                  std::uint64_t first_index) override {
    const method::Stopwatch watch;
    const std::size_t word_count = outputs.mask_words.size() / std::max<std::size_t>(receivers.size(), 1);
    std::vector<Run> runs = runs_of(receivers);
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t i) {
      Run& run = runs[i];
      const QueryOutputs own = {.occlusion = run.of(outputs.occlusion),
                                .bent_normals = run.of(outputs.bent_normals),
                                .mask_words = run.of(outputs.mask_words, word_count)};
      Method& of_object = *methods_.at(receivers[run.begin].excluded_instance);
      run.report = of_object.answer(run.of(receivers), own, first_index + run.begin).report;
    });
    QueryReport sum;
    for (const Run& run : runs) sum += run.report;
    return {sum, watch.seconds()};
  }

  method::Remarks remarks() const override {
    return methods_.empty() ? method::Remarks{} : methods_.front()->remarks();
  }

 private:
  const MethodOptions& options_;
  std::vector<std::unique_ptr<Method>> methods_;  // by object
  double build_seconds_ = 0;
};

}  // namespace

std::unique_ptr<Method> open_for_objects(const MethodOptions& method) { return std::make_unique<OwnObjects>(method); }

}  // namespace lkao::cli
