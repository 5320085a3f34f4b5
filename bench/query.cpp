// One receiver at a time: the query against Embree's single rays and packets, on the same rays, by scene and ray count.
// Every row carries its share of mismatched rays against robust Embree; a row of speed without one does not exist.
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "lkao/lkao.h"
#include "reference/embree_reference.h"
#include "scene/builtin.h"
#include "scene/camera.h"

namespace lkao {
namespace {

// What the camera sees of a built-in scene, in 32 x 32 pixel tiles' density: neighbouring receivers.
struct Case {
  scene::Mesh mesh;
  std::vector<Receiver> receivers;
  std::unique_ptr<AmbientOcclusion> ao;
  std::unique_ptr<reference::EmbreeReference> oracle;

  Case(const std::string& name, float radius, int ray_count) : mesh(scene::make_builtin(name)) {
    receivers = scene::find_receivers(mesh, scene::builtin_scene(name).camera, 64, 48).receivers;
    ao = std::make_unique<AmbientOcclusion>(OccluderBvh(mesh.view()), SamplePattern::standard(ray_count),
                                            QueryOptions{.radius = radius});
    oracle = std::make_unique<reference::EmbreeReference>(mesh);
  }
};

enum class Method { query, embree_packets, embree_single_rays };

// Share of rays on which the method and robust Embree differ.
template <typename Answer>
double mismatch_rate(const Case& c, const Answer& answer) {
  std::uint64_t mismatched = 0, cast = 0;
  for (std::size_t k = 0; k < c.receivers.size(); ++k) {
    const OcclusionMask a = answer(k).mask, b = c.oracle->query(*c.ao, c.receivers[k], k).mask;
    mismatched += static_cast<std::uint64_t>(((a & ~b) | (b & ~a)).count());
    cast += static_cast<std::uint64_t>(c.ao->rays(c.receivers[k], k).cast.count());
  }
  return static_cast<double>(mismatched) / static_cast<double>(cast);
}

template <typename Answer>
void measure(benchmark::State& state, const Case& c, const Answer& answer) {
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(answer(k));
    k = (k + 1) % c.receivers.size();
  }
  state.counters["Mrays/s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * c.ao->pattern().ray_count() / 1e6, benchmark::Counter::kIsRate);
  state.counters["mismatch_rate"] = mismatch_rate(c, answer);
}

void query(benchmark::State& state, const std::string& scene, float radius, int ray_count, Method method) {
  const Case c(scene, radius, ray_count);
  if (method == Method::query) {
    measure(state, c, [&](std::size_t k) { return c.ao->query(c.receivers[k], k); });
    return;
  }
  const reference::Casting casting =
      method == Method::embree_packets ? reference::Casting::packets : reference::Casting::single_rays;
  const reference::EmbreeReference rival(c.mesh, {.robust = false, .casting = casting});
  measure(state, c, [&](std::size_t k) { return rival.query(*c.ao, c.receivers[k], k); });
}

[[maybe_unused]] const bool registered = [] {
  const std::pair<Method, const char*> methods[] = {
      {Method::query, "lkao"}, {Method::embree_packets, "embree16"}, {Method::embree_single_rays, "embree1"}};
  for (const char* name : {"atrium", "city"}) {
    const scene::SuggestedRadii& radii = scene::builtin_scene(name).radii;
    for (float radius : {radii.small, radii.large}) {
      for (int ray_count : {128, 1024}) {
        for (const auto& [method, method_name] : methods) {
          benchmark::RegisterBenchmark(fmt::format("{}/{}/{}/{}", name, radius, ray_count, method_name).c_str(), query,
                                       std::string(name), radius, ray_count, method);
        }
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace lkao
