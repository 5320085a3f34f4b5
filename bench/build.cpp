// What is made once: sample patterns and hierarchies.
#include <benchmark/benchmark.h>

#include "lkao/lkao.h"
#include "scene/builtin.h"

namespace lkao {
namespace {

void pattern(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(SamplePattern::relaxed(static_cast<int>(state.range(0))));
}
BENCHMARK(pattern)->Arg(64)->Arg(128)->Arg(1024)->Unit(benchmark::kMillisecond);

void hierarchy(benchmark::State& state, const char* name, bool spatial_splits) {
  const scene::Mesh mesh = scene::make_builtin(name);
  BuildReport report;
  for (auto _ : state) report = OccluderBvh(mesh.view(), {.spatial_splits = spatial_splits}).report();
  const auto triangle_count = static_cast<double>(report.occluder_count);
  state.counters["triangles"] = triangle_count;
  state.counters["bytes/triangle"] = static_cast<double>(report.memory_bytes) / triangle_count;
  state.counters["references/triangle"] = static_cast<double>(report.reference_count) / triangle_count;
}
BENCHMARK_CAPTURE(hierarchy, atrium, "atrium", true)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(hierarchy, atrium_without_splits, "atrium", false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(hierarchy, city, "city", true)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lkao
