// Options that several subcommands share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "method/question.h"
#include "method/radius.h"

namespace CLI {
class App;
}

namespace lkao::cli {

// How to run and what to tell; on every subcommand.
struct CommonOptions {
  std::optional<int> thread_count;  // all of the machine's where not given
  std::string json_path;            // "-" for stdout, empty for none
  bool quiet = false;               // neither table nor progress bar

  bool wants_table() const { return !quiet && json_path != "-"; }
};
void add_common_options(CLI::App& app, CommonOptions& options);

// What to ask of every receiver; on `render` and `bake`.
struct OcclusionOptions {
  std::optional<method::Radius> radius;
  int ray_count = 128;
  Weighting weighting = Weighting::cosine;
  Falloff falloff = Falloff::constant();
  Sidedness sidedness = Sidedness::two_sided;
  std::uint64_t seed = 0;
  double min_distance = 0;

  // `length` is what the radius is in the scene's unit: resolve_radius() tells it.
  method::Question question(double length) const;
};
void add_occlusion_options(CLI::App& app, OcclusionOptions& options);

// Calls `function` so that everything parallel in it uses the given number of threads.
template <class Function>
auto with_threads(std::optional<int> thread_count, Function function) {
  if (!thread_count) return function();
  const auto count = static_cast<std::size_t>(*thread_count);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, count);
  tbb::task_arena arena(*thread_count);
  return arena.execute(std::move(function));
}

}  // namespace lkao::cli
