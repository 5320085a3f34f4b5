// lkao-bench instances: scenes of instances against Embree's, standing and moving.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/contest.h"
#include "bench/csv_file.h"
#include "bench/embree_modes.h"
#include "bench/exact_rays.h"
#include "bench/instanced_city.h"
#include "bench/options.h"
#include "bench/tiles.h"
#include "lkao/lkao.h"
#include "method/median.h"
#include "method/stopwatch.h"
#include "reference/embree_instances.h"
#include "reference/embree_reference.h"

namespace lkao::bench {
namespace {

struct InstancesOptions {
  std::vector<std::size_t> counts = {1000, 100'000, 1'000'000};
  std::vector<float> radii = {4, 16, 64, std::numeric_limits<float>::infinity()};
  int ray_count = 128;
  int tile_count = 4;
  int round_count = 5;
  std::size_t moving_count = 10'000;
  std::string csv;
  std::string motion_csv;
};

// Of this process, in megabytes; 0 where that is not known.
double resident_megabytes() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * 4096 * 1e-6;
}

Columns standing_csv_columns() {
  return {{"instances"},
          {"triangles"},
          {"radius", "{:g}"},
          {"rays"},
          {"receivers"},
          {"lkao_build_s", "{:.3f}"},
          {"embree_build_s", "{:.3f}"},
          {"lkao_mb", "{:.0f}"},
          {"embree_mb", "{:.0f}"},
          {"lkao_mrays_per_s", "{:.2f}"},
          {"embree_mode"},
          {"embree_mrays_per_s", "{:.2f}"},
          {"ratio", "{:.2f}"},
          {"mismatched_rays", "{:.3g}"},
          {"wrong_rays"},
          {"embree_wrong_rays"},
          {"undecided_rays"}};
}

Columns standing_table_columns() {
  return {{"instances", "{}", 9},
          {"triangles", "{:.2e}", 9},
          {"radius", "{:g}", 6},
          {"rays", "{}", 5},
          kBar,
          {"lkao_build_s", "{:.2f}", 7, "build"},
          {"embree_build_s", "{:.2f}", 7, "Embree"},
          {"lkao_mb", "{:.0f}", 6, "MB"},
          {"embree_mb", "{:.0f}", 6, "Embree"},
          kBar,
          {"lkao_mrays_per_s", "{:.1f}", 8, "Mrays/s"},
          {"embree_mrays_per_s", "{:.1f}", 7, "Embree"},
          {"ratio", "{:.2f}", 6},
          {"embree_mode", "{}", -28, "its best mode"},
          {"mismatched_rays", "{:.1e}", 10, "mismatched"},
          {"wrong_rays", "{}", 5, "wrong"},
          {"embree_wrong_rays", "{}", 7, "Embree"},
          {"undecided_rays", "{}", 9, "undecided"}};
}

// Masks of so many receivers.
Masks masks_of(const AmbientOcclusion& ao, std::span<const Receiver> receivers) {
  return Masks(receivers.size() * static_cast<std::size_t>(ao.pattern().word_count()));
}

Rival by_query(const char* name, int round_count, const AmbientOcclusion& ao, std::span<const Receiver> receivers) {
  const auto answer = [&ao, receivers](Masks& masks) { ao.query(receivers, {.mask_words = masks}); };
  return {name, round_count, answer, masks_of(ao, receivers)};
}

// On all threads.
void run_rounds(std::vector<Rival>& rivals) { run_rounds(rivals, tbb::this_task_arena::max_concurrency()); }

std::vector<OccluderBvh> build_meshes(const InstancedCity& city) {
  std::vector<OccluderBvh> meshes;
  for (const scene::Mesh& mesh : city.meshes)
    meshes.emplace_back(mesh.view(), lkao::BuildOptions{.keep_zero_area = true});
  return meshes;
}

// A city in both libraries, with what making it cost.
struct BuiltCity {
  explicit BuiltCity(std::size_t instance_count) : city(make_city(instance_count)) {
    const double before = resident_megabytes();
    method::Stopwatch watch;
    scene.emplace(build_meshes(city), city.instances);
    seconds = watch.lap();
    const double between = resident_megabytes();
    watch.lap();
    embree.emplace(city.meshes, city.instances, false);
    embree_seconds = watch.lap();
    megabytes = between - before;
    embree_megabytes = resident_megabytes() - between;
  }

  InstancedCity city;
  std::optional<OccluderScene> scene;
  std::optional<reference::EmbreeInstances> embree;
  double seconds, embree_seconds, megabytes, embree_megabytes;
};

class Standing {
 public:
  Standing(const InstancesOptions& options, CsvFile& csv) : options_(options), csv_(csv) {
    fmt::print("{}", table_heading(columns_));
  }

  void run(std::size_t instance_count) {
    BuiltCity built(instance_count);
    const InstancedCity& city = built.city;
    const std::vector<Receiver> receivers =
        choose_tiles(built.embree->see(city.meshes, city.instances, city.camera, 1024, 768), options_.tile_count);
    for (const float radius : options_.radii) measure(built, receivers, radius);
  }

 private:
  void measure(const BuiltCity& built, const std::vector<Receiver>& receivers, float radius) {
    const AmbientOcclusion ao(*built.scene, SamplePattern::standard(options_.ray_count), {.radius = radius});
    std::vector<Rival> rivals{by_query("lkao", options_.round_count, ao, receivers)};
    for (const EmbreeMode& mode : all_embree_modes()) {
      // Embree 3.13.5 does at times not come back from coherent packets in a scene of instances.
      if (mode.order == scene::embree::Order::coherent && mode.width > 1) continue;
      const auto answer = [&, mode](Masks& masks) { cast(mode, built.embree->scene(), ao, receivers, masks); };
      rivals.push_back({mode.name(), options_.round_count, answer, masks_of(ao, receivers)});
    }
    run_rounds(rivals);
    report(built, receivers, ao, rivals);
  }

  void report(const BuiltCity& built, const std::vector<Receiver>& receivers, const AmbientOcclusion& ao,
              const std::vector<Rival>& rivals) {
    // Embree's robust mode is the oracle; its fast one leaks at edges.
    const reference::EmbreeInstances oracle(built.city.meshes, built.city.instances, true);
    Masks expected = masks_of(ao, receivers);
    cast(all_embree_modes().front(), oracle.scene(), ao, receivers, expected);
    const auto ray_count = static_cast<double>(ao.query(receivers, {}).ray_count);
    std::vector<MethodResult> results;
    for (const Rival& rival : rivals) results.push_back(result_of(rival, expected, ray_count));
    const MethodResult& lkao = results.front();
    const MethodResult& best = *fastest(results, "embree");
    const Disagreement decided = decide_exactly(ao, receivers, rivals.front().masks, expected);
    const Measurement measurement = {{"instances", built.city.instances.size()},
                                     {"triangles", built.city.triangle_count},
                                     {"radius", ao.options().radius},
                                     {"rays", options_.ray_count},
                                     {"receivers", receivers.size()},
                                     {"lkao_build_s", built.seconds},
                                     {"embree_build_s", built.embree_seconds},
                                     {"lkao_mb", built.megabytes},
                                     {"embree_mb", built.embree_megabytes},
                                     {"lkao_mrays_per_s", lkao.mrays_per_second},
                                     {"embree_mode", best.method},
                                     {"embree_mrays_per_s", best.mrays_per_second},
                                     {"ratio", speed_ratio(lkao, best)},
                                     {"mismatched_rays", lkao.mismatch_rate},
                                     {"wrong_rays", decided.first_wrong},
                                     {"embree_wrong_rays", decided.second_wrong},
                                     {"undecided_rays", decided.undecided}};
    csv_.write(measurement);
    Measurement shown = measurement;
    shown[1].second = static_cast<double>(built.city.triangle_count);
    fmt::print("{}", table_row(columns_, shown));
    std::fflush(stdout);
  }

  const InstancesOptions& options_;
  CsvFile& csv_;
  const Columns columns_ = standing_table_columns();
};

Columns motion_csv_columns() {
  return {{"instances"},
          {"moved"},
          {"distance", "{:g}"},
          {"move_ms", "{:.2f}"},
          {"build_ms", "{:.2f}"},
          {"embree_ms", "{:.2f}"},
          {"query_slowdown", "{:.3f}"},
          {"mismatched_rays"}};
}

Columns motion_table_columns() {
  return {{"instances", "{}", 9},
          {"distance", "{:g}", 8},
          kBar,
          {"move_ms", "{:.1f}", 8, "move ms"},
          {"build_ms", "{:.1f}", 8, "build ms"},
          {"embree_ms", "{:.1f}", 9, "Embree ms"},
          kBar,
          {"query_slowdown", "{:.3f}", 14, "query slowdown"},
          {"mismatched_rays", "{}", 10, "mismatched"}};
}

// All instances move at once: the time of that, and what queries lose to a scene built anew.
class Motion {
 public:
  Motion(const InstancesOptions& options, CsvFile& csv) : options_(options), csv_(csv) {
    fmt::print("\n{}", table_heading(columns_));
  }

  void run() {
    BuiltCity built(options_.moving_count);
    for (const float distance : {0.1f, 1.0f, 5.0f, 50.0f}) measure(built, distance);
  }

 private:
  void measure(BuiltCity& built, float distance) {
    const InstancedCity& city = built.city;
    OccluderScene moved = *built.scene;
    std::optional<OccluderScene> rebuilt;
    std::vector<double> move_ms, build_ms, embree_ms;
    std::vector<OccluderInstance> instances = city.instances;
    for (int round = 0; round < options_.round_count; ++round) {
      const std::vector<InstanceMove> moves = stir(city, distance, static_cast<std::uint64_t>(round));
      for (const InstanceMove& move : moves) instances[move.instance].to_world = move.to_world;
      method::Stopwatch watch;
      moved.move(moves);
      move_ms.push_back(1e3 * watch.lap());
      rebuilt.emplace(meshes_of(*built.scene), instances);
      build_ms.push_back(1e3 * watch.lap());
      built.embree->move(moves);
      embree_ms.push_back(1e3 * watch.lap());
    }
    const auto image = built.embree->see(city.meshes, instances, city.camera, 1024, 768);
    const std::vector<Receiver> receivers = choose_tiles(image, options_.tile_count);
    const SamplePattern pattern = SamplePattern::standard(options_.ray_count);
    const AmbientOcclusion old(moved, pattern, {.radius = 4}), fresh(*rebuilt, pattern, {.radius = 4});
    std::vector<Rival> rivals{by_query("moved", options_.round_count, old, receivers),
                              by_query("rebuilt", options_.round_count, fresh, receivers)};
    run_rounds(rivals);
    const auto ray_count = static_cast<double>(fresh.query(receivers, {}).ray_count);
    const MethodResult of_moved = result_of(rivals[0], rivals[1].masks, ray_count),
                       of_rebuilt = result_of(rivals[1], rivals[1].masks, ray_count);
    const Measurement measurement = {
        {"instances", instances.size()},
        {"moved", instances.size() - 1},
        {"distance", distance},
        {"move_ms", method::median(move_ms)},
        {"build_ms", method::median(build_ms)},
        {"embree_ms", method::median(embree_ms)},
        {"query_slowdown", speed_ratio(of_rebuilt, of_moved)},
        {"mismatched_rays", reference::count_mismatched_rays(rivals[0].masks, rivals[1].masks)}};
    csv_.write(measurement);
    fmt::print("{}", table_row(columns_, measurement));
    std::fflush(stdout);
  }

  static std::vector<OccluderBvh> meshes_of(const OccluderScene& scene) {
    std::vector<OccluderBvh> meshes;
    for (std::uint32_t i = 0; i < scene.mesh_count(); ++i) meshes.push_back(scene.mesh(i));
    return meshes;
  }

  const InstancesOptions& options_;
  CsvFile& csv_;
  const Columns columns_ = motion_table_columns();
};

void run(const InstancesOptions& options) {
  CsvFile csv(options.csv, standing_csv_columns());
  CsvFile motion_csv(options.motion_csv, motion_csv_columns());
  Standing standing(options, csv);
  for (const std::size_t count : options.counts) standing.run(count);
  if (options.moving_count > 0) Motion(options, motion_csv).run();
}

}  // namespace

Command add_instances_command(CLI::App& program) {
  auto options = std::make_shared<InstancesOptions>();
  CLI::App* app = program.add_subcommand(
      "instances", "A city of instances against Embree's, by their number; and thousands of them that move.");
  app->add_option("--counts", options->counts, "of instances")
      ->delimiter(',')
      ->check(CLI::Range(std::size_t{2}, std::size_t{100'000'000}))
      ->capture_default_str();
  app->add_option("--radii", options->radii, "AO radii; houses are some 4 wide; inf: without bounds")
      ->delimiter(',')
      ->capture_default_str();
  app->add_option("--rays", options->ray_count, "of a receiver")
      ->check(CLI::Range(kMinRayCount, kMaxRayCount))
      ->capture_default_str();
  app->add_option("--moving", options->moving_count, "of instances that move; 0: none")->capture_default_str();
  add_rounds_option(*app, options->round_count);
  add_csv_option(*app, options->csv);
  app->add_option("--motion-csv", options->motion_csv, "of those that move");
  return {app, [options] {
            run(*options);
            return 0;
          }};
}

}  // namespace lkao::bench
