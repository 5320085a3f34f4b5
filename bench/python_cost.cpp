// The C++ side of python_cost.py: the time of a batch whose receivers are ready, as a C++ host has them.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/provenance.h"
#include "lkao/lkao.h"

#define LKAO_BENCH_API extern "C" __attribute__((visibility("default")))

namespace {

struct Host {
  std::vector<lkao::Receiver> receivers;
  lkao::AmbientOcclusion ao;
};

std::vector<lkao::Receiver> receivers_of(const float* positions, const float* normals, std::size_t count) {
  std::vector<lkao::Receiver> receivers;
  receivers.reserve(count);
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    receivers.push_back({.position = {positions[i], positions[i + 1], positions[i + 2]},
                         .normal = {normals[i], normals[i + 1], normals[i + 2]}});
  }
  return receivers;
}

}  // namespace

LKAO_BENCH_API Host* lkao_bench_open(const float* positions, std::size_t position_count, const std::uint32_t* triangles,
                                     std::size_t triangle_count, const float* points, const float* normals,
                                     std::size_t count, float radius, int ray_count) {
  const lkao::TriangleMesh mesh{lkao::PositionView(positions, position_count),
                                lkao::IndexView(triangles, triangle_count)};
  return new Host{
      receivers_of(points, normals, count),
      lkao::AmbientOcclusion(lkao::OccluderBvh(mesh), lkao::SamplePattern::standard(ray_count), {.radius = radius})};
}

// Answers all receivers into `occlusion`; returns the seconds.
LKAO_BENCH_API double lkao_bench_query(const Host* host, float* occlusion) {
  using Clock = std::chrono::steady_clock;
  const std::span<float> answers(occlusion, host->receivers.size());
  const Clock::time_point start = Clock::now();
  host->ao.query(host->receivers, {.occlusion = answers});
  return std::chrono::duration<double>(Clock::now() - start).count();
}

LKAO_BENCH_API void lkao_bench_close(Host* host) { delete host; }

LKAO_BENCH_API const char* lkao_bench_provenance() {
  static const std::string comment = lkao::bench::provenance_comment();
  return comment.c_str();
}
