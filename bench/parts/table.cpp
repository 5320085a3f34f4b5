// The plane mask table: its build, and look-ups of planes all over it.
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bvh/table_lookup.h"
#include "lkao/plane_mask_table.h"
#include "scene/shapes.h"

namespace lkao::bench {
namespace {

PlaneMaskTable make_table(int ray_count, PlaneMasks masks) {
  return PlaneMaskTable(SamplePattern::standard(ray_count), {.resolution = 64, .masks = masks});
}

const PlaneMaskTable& kept_table(int ray_count, PlaneMasks masks) {
  static std::map<std::pair<int, PlaneMasks>, std::unique_ptr<const PlaneMaskTable>> tables;
  auto& table = tables[{ray_count, masks}];
  if (!table) table = std::make_unique<const PlaneMaskTable>(make_table(ray_count, masks));
  return *table;
}

void table_build(benchmark::State& state, PlaneMasks masks) {
  SamplePattern::standard(128);  // not part of the build
  for (auto _ : state) benchmark::DoNotOptimize(make_table(128, masks));
  state.counters["bytes"] = static_cast<double>(kept_table(128, masks).memory_bytes());
}
BENCHMARK_CAPTURE(table_build, nearest, PlaneMasks::nearest)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(table_build, must_may, PlaneMasks::must_may)->Unit(benchmark::kMillisecond)->UseRealTime();

// A plane of unit normal.
struct Plane {
  glm::dvec3 normal;
  double distance;
};

struct Edge {
  static Plane draw(scene::Random& random) { return {random.unit_vector(), 0}; }
  static void keep(const bvh::TableLookup& lookup, const Plane& plane, auto& masks) {
    lookup.keep_beyond_edge(plane.normal, masks);
  }
};

struct AnyPlane {
  static Plane draw(scene::Random& random) { return {random.unit_vector(), random.uniform()}; }
  static void keep(const bvh::TableLookup& lookup, const Plane& plane, auto& masks) {
    lookup.keep_beyond(plane.normal, plane.distance, masks);
  }
};

// `mismatch_rate`: rays that are said to be beyond a plane or not, against the exact plane. `in_doubt`: the others.
template <typename Kind>
void report_errors(benchmark::State& state, const bvh::TableLookup& lookup, const SamplePattern& pattern,
                   const std::vector<Plane>& planes) {
  double wrong_count = 0, doubt_count = 0;
  for (const Plane& plane : planes) {
    bvh::MaskBounds bounds{~OcclusionMask(), ~OcclusionMask()};
    Kind::keep(lookup, plane, bounds);
    for (int i = 0; i < pattern.ray_count(); ++i) {
      const auto ray = static_cast<std::size_t>(i);
      const double height = glm::dot(plane.normal, glm::dvec3(pattern.directions()[ray] * pattern.lengths()[ray]));
      const bool is_beyond = height >= plane.distance;
      wrong_count += is_beyond ? !bounds.may.test(i) : bounds.must.test(i);
      doubt_count += bounds.may.test(i) != bounds.must.test(i);
    }
  }
  const double all_count = static_cast<double>(planes.size()) * pattern.ray_count();
  state.counters["mismatch_rate"] = wrong_count / all_count;
  state.counters["in_doubt"] = doubt_count / all_count;
  if (lookup.has_bounds() && wrong_count > 0) state.SkipWithError("wrong answers");
}

template <typename Kind>
void look_up(benchmark::State& state, PlaneMasks masks_kind) {
  const PlaneMaskTable& table = kept_table(static_cast<int>(state.range(0)), masks_kind);
  const bvh::TableLookup lookup(table, glm::mat3(1), 1);
  scene::Random random(1);
  std::vector<Plane> planes(4096);
  for (Plane& plane : planes) plane = Kind::draw(random);
  const auto run = [&](auto masks) {
    std::size_t k = 0;
    for (auto _ : state) {
      Kind::keep(lookup, planes[k++ % planes.size()], masks);
      benchmark::DoNotOptimize(masks);
    }
  };
  if (lookup.has_bounds()) {
    run(bvh::MaskBounds());
  } else {
    run(OcclusionMask());
  }
  report_errors<Kind>(state, lookup, table.pattern(), planes);
}

void table_edge(benchmark::State& state, PlaneMasks masks) { look_up<Edge>(state, masks); }
void table_plane(benchmark::State& state, PlaneMasks masks) { look_up<AnyPlane>(state, masks); }

void by_rays(benchmark::internal::Benchmark* benchmark) { benchmark->ArgName("rays")->Arg(128)->Arg(1024); }
BENCHMARK_CAPTURE(table_edge, nearest, PlaneMasks::nearest)->Apply(by_rays);
BENCHMARK_CAPTURE(table_edge, must_may, PlaneMasks::must_may)->Apply(by_rays);
BENCHMARK_CAPTURE(table_plane, nearest, PlaneMasks::nearest)->Apply(by_rays);
BENCHMARK_CAPTURE(table_plane, must_may, PlaneMasks::must_may)->Apply(by_rays);

}  // namespace
}  // namespace lkao::bench
