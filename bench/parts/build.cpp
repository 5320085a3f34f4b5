// One build of the hierarchy by scene type, and what it takes to keep. lkao-bench build has it beside Embree's.
#include <cstddef>

#include <benchmark/benchmark.h>

#include "bench/parts/scenes.h"

namespace lkao::bench {
namespace {

void build(benchmark::State& state, const char* scene_name) {
  const TriangleMesh mesh = measured_scene(scene_name).view.mesh.view();
  std::size_t memory_bytes = 0;
  for (auto _ : state) memory_bytes = OccluderBvh(mesh).report().memory_bytes;
  const auto triangle_count = static_cast<double>(mesh.triangles.size());
  state.counters["triangles/s"] = {triangle_count * static_cast<double>(state.iterations()),
                                   benchmark::Counter::kIsRate};
  state.counters["bytes/triangle"] = static_cast<double>(memory_bytes) / triangle_count;
}

BENCHMARK_CAPTURE(build, atrium, "atrium")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, city, "city")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, hairball, "hairball")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lkao::bench
