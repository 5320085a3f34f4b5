// One receiver by scene type, and batches on several threads, on the instruction set that LKAO_ISA chooses.
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "bench/parts/scenes.h"
#include "lkao/isa.h"
#include "method/stopwatch.h"

namespace lkao::bench {
namespace {

void report(benchmark::State& state, double ray_count, double mismatch_rate) {
  state.counters["rays/s"] = {ray_count, benchmark::Counter::kIsRate};
  state.counters["mismatch_rate"] = mismatch_rate;
  state.SetLabel(active_isa());
  if (mismatch_rate > 1e-4) state.SkipWithError("wrong answers");
}

// Neighbours one after another, each from the root.
void receiver(benchmark::State& state, const char* scene_name) {
  const MeasuredScene& scene = measured_scene(scene_name);
  const AmbientOcclusion ao(scene.occluders, SamplePattern::standard(static_cast<int>(state.range(0))),
                            {.radius = state.range(1) != 0 ? scene.view.radii.back() : scene.view.radii.front()});
  const std::vector<Receiver>& receivers = scene.tiles;
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ao.query(receivers[k], k));
    k = k + 1 < receivers.size() ? k + 1 : 0;
  }
  const Accuracy accuracy = find_accuracy(scene, ao, receivers);
  const double share_answered = static_cast<double>(state.iterations()) / static_cast<double>(receivers.size());
  report(state, accuracy.ray_count * share_answered, accuracy.mismatch_rate);
}

void by_rays_and_radius(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"rays", "large_radius"})->ArgsProduct({{128, 1024}, {0, 1}})->Unit(benchmark::kMicrosecond);
}
BENCHMARK_CAPTURE(receiver, atrium, "atrium")->Apply(by_rays_and_radius);
BENCHMARK_CAPTURE(receiver, city, "city")->Apply(by_rays_and_radius);
BENCHMARK_CAPTURE(receiver, hairball, "hairball")->Apply(by_rays_and_radius);
BENCHMARK_CAPTURE(receiver, closed, "closed")->Apply(by_rays_and_radius);

double seconds_of_batch(const AmbientOcclusion& ao, const std::vector<Receiver>& receivers, int thread_count) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(thread_count));
  std::vector<float> occlusion(receivers.size());
  return tbb::task_arena(thread_count).execute([&] {
    const method::Stopwatch time;
    ao.query(receivers, {.occlusion = occlusion});
    return time.seconds();
  });
}

// Alternates with one thread, so that the speedup holds where the machine's speed drifts.
void batch(benchmark::State& state) {
  const MeasuredScene& scene = measured_scene("atrium");
  const AmbientOcclusion ao(scene.occluders, SamplePattern::standard(128), {.radius = scene.view.radii.back()});
  double alone = 0, together = 0;
  for (auto _ : state) {
    alone += seconds_of_batch(ao, scene.view.receivers, 1);
    const double seconds = seconds_of_batch(ao, scene.view.receivers, static_cast<int>(state.range(0)));
    together += seconds;
    state.SetIterationTime(seconds);
  }
  state.counters["speedup"] = alone / together;
  const Accuracy accuracy = find_accuracy(scene, ao, scene.view.receivers);
  report(state, accuracy.ray_count * static_cast<double>(state.iterations()), accuracy.mismatch_rate);
}
BENCHMARK(batch)
    ->ArgName("threads")
    ->RangeMultiplier(2)
    ->Range(1, tbb::info::default_concurrency())
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lkao::bench
