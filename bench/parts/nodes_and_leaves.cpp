// One node and one leaf against rays, compiled once for every SIMD target as the kernel is (bvh/simd_kernel.cpp).
#include <bit>
#include <span>
#include <string>

#include <benchmark/benchmark.h>

#include "bench/parts/scenes.h"
#include "bvh/ray_box.h"
#include "bvh/ray_triangle.h"
#include "lkao/isa.h"

#ifndef LKAO_BENCH_PART
#define LKAO_BENCH_PART
namespace lkao::bench {
struct Part {
  const char* name;
  void (*run)(benchmark::State&);
};
}  // namespace lkao::bench
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/parts/nodes_and_leaves.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "lut/isa.h"

#if HWY_TARGET == HWY_SCALAR  // no vectors, no such parts

namespace lkao::bench::HWY_NAMESPACE {
std::span<const Part> parts() { return {}; }
}  // namespace lkao::bench::HWY_NAMESPACE

#else

#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/leaf_frames-inl.h"
#include "bvh/simd/leaf_planes-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bench::HWY_NAMESPACE {
namespace {

namespace simd = bvh::HWY_NAMESPACE;
using bvh::kWidth;
using simd::kLaneCount;
using simd::Verdict;

constexpr int kRayCount = 128;

// Times `test(item, first ray)`; both change every time.
template <int ray_count, typename Item, typename Test>
void run(benchmark::State& state, const std::vector<Item>& items, int items_each, const Test& test) {
  std::size_t k = 0;
  int first = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(test(items[k], first));
    k = (k + 1) % Surroundings::kCount;
    first = (first + kLaneCount) % kRayCount;
  }
  state.counters["tests/s"] = {static_cast<double>(state.iterations()) * items_each * ray_count,
                               benchmark::Counter::kIsRate};
}

struct NodeAnswer {
  std::uint32_t rays[kWidth];  // by child
};

// `kept`: the share of rays and boxes that may meet, which is what a node leaves open.
template <int ray_count, typename Test>
void run_nodes(benchmark::State& state, const Test& test) {
  const Surroundings& here = surroundings();
  run<ray_count>(state, here.nodes, kWidth, test);
  double kept_count = 0, all_count = 0;
  for (const bvh::Node& node : here.nodes) {
    for (int first = 0; first < kRayCount; first += ray_count) {
      for (const std::uint32_t rays : test(node, first).rays) kept_count += std::popcount(rays);
      all_count += ray_count * kWidth;
    }
  }
  state.counters["kept"] = kept_count / all_count;
}

void node_16_rays(benchmark::State& state) {
  const Surroundings& here = surroundings();
  const bvh::Query query = here.query();
  const simd::RaySet rays(query);
  const simd::WholeRays whole(query);
  run_nodes<kLaneCount>(state, [&](const bvh::Node& node, int first) {
    const simd::RelativeBoxes<simd::WholeRays> boxes(node, query);
    NodeAnswer met;
    for (int i = 0; i < kWidth; ++i) met.rays[i] = boxes.rays_meeting(i, rays, whole, first / kLaneCount) & 0xffffu;
    return met;
  });
}

void node_1_ray_scalar(benchmark::State& state) {
  const Surroundings& here = surroundings();
  bvh::BoxRay rays[kRayCount];
  for (int i = 0; i < kRayCount; ++i) rays[i] = bvh::BoxRay(here.rays.ray(i));
  run_nodes<1>(state, [&](const bvh::Node& node, int ray) {
    NodeAnswer met;
    for (int i = 0; i < kWidth; ++i) met.rays[i] = bvh::may_meet(rays[ray], here.rays.origin, node.child_bounds(i));
    return met;
  });
}

// Rays that TriangleTest says are blocked, of `ray_count` from `first` on.
template <int ray_count>
HWY_INLINE std::uint32_t blocked_by_definition(const Surroundings& here, const bvh::Query& query, const bvh::Leaf& leaf,
                                               int first) {
  std::uint32_t blocked = 0;
  for (const std::uint32_t primitive : leaf.primitives) {
    const bvh::TriangleTest test = bvh::make_test(here.occluders.layout(), primitive, query);
    if (!test.can_block()) continue;
    for (int i = 0; i < ray_count; ++i) {
      blocked |= static_cast<std::uint32_t>(test.blocks(here.rays.ray(first + i))) << i;
    }
  }
  return blocked;
}

// `mismatch_rate`: rays that are surely blocked, or surely not, against the definition. `in_doubt`: rays left to it.
template <int ray_count, typename Test>
void run_leaves(benchmark::State& state, const Test& test) {
  const Surroundings& here = surroundings();
  const bvh::Query query = here.query();
  run<ray_count>(state, here.leaves, bvh::kLeafWidth, test);
  double wrong_count = 0, doubt_count = 0, all_count = 0;
  for (const bvh::Leaf& leaf : here.leaves) {
    for (int first = 0; first < kRayCount; first += ray_count) {
      const Verdict rays = test(leaf, first);
      const std::uint32_t right = blocked_by_definition<ray_count>(here, query, leaf, first);
      wrong_count += std::popcount((rays.sure & ~right) | (right & ~(rays.sure | rays.perhaps)));
      doubt_count += std::popcount(rays.perhaps & ~rays.sure);
      all_count += ray_count;
    }
  }
  state.counters["mismatch_rate"] = wrong_count / all_count;
  state.counters["in_doubt"] = doubt_count / all_count;
  if (wrong_count > 0) state.SkipWithError("wrong answers");
}

void leaf_16_rays(benchmark::State& state) {
  const Surroundings& here = surroundings();
  const bvh::Query query = here.query();
  const simd::RaySet rays(query);
  const simd::WholeRays whole(query);
  const simd::LeafReceiver receiver(here.occluders.layout(), query);
  run_leaves<kLaneCount>(state, [&](const bvh::Leaf& leaf, int first) {
    const bvh::Leaf* const leaves[] = {&leaf};
    simd::LeafFrames<1> frames(receiver, leaves);
    frames.decide_sides(receiver);
    return simd::LeafPlanes(frames, here.radius, frames.candidates()).blocked(rays, whole, first / kLaneCount);
  });
}

void leaf_1_ray(benchmark::State& state) {
  const Surroundings& here = surroundings();
  const bvh::Query query = here.query();
  const simd::RaySet rays(query);
  const simd::WholeRays whole(query);
  const simd::LeafReceiver receiver(here.occluders.layout(), query);
  run_leaves<1>(state, [&](const bvh::Leaf& leaf, int ray) {
    const bvh::Leaf* const leaves[] = {&leaf};
    const std::uint32_t numbers[] = {static_cast<std::uint32_t>(ray)};
    simd::LeafFrames<1> frames(receiver, leaves);
    frames.decide_sides(receiver);
    const Verdict triangles = frames.blocked(rays, whole, numbers);
    return Verdict{triangles.sure != 0, triangles.perhaps != 0};
  });
}

template <int ray_count>
void leaf_definition(benchmark::State& state) {
  const Surroundings& here = surroundings();
  const bvh::Query query = here.query();
  run_leaves<ray_count>(state, [&](const bvh::Leaf& leaf, int first) {
    const std::uint32_t blocked = blocked_by_definition<ray_count>(here, query, leaf, first);
    return Verdict{blocked, blocked};
  });
}

}  // namespace

std::span<const Part> parts() {
  static constexpr Part kParts[] = {{"node/16_rays", node_16_rays},
                                    {"node/1_ray_scalar", node_1_ray_scalar},
                                    {"leaf/16_rays", leaf_16_rays},
                                    {"leaf/1_ray", leaf_1_ray},
                                    {"leaf/16_rays_definition", leaf_definition<kLaneCount>},
                                    {"leaf/1_ray_definition", leaf_definition<1>}};
  return kParts;
}

}  // namespace lkao::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace lkao::bench {
namespace {

HWY_EXPORT(parts);

const bool kRegistered = [] {
  for (const std::string& isa : available_isas()) {
    force_isa(isa);
    for (const Part& part : LKAO_DISPATCH(parts)()) {
      benchmark::RegisterBenchmark((std::string(part.name) + "/" + isa).c_str(), part.run);
    }
  }
  force_isa("");  // the first query obeys LKAO_ISA
  return true;
}();

}  // namespace
}  // namespace lkao::bench
#endif
