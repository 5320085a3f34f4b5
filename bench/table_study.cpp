// lkao_bench_tables: what a plane mask table gets wrong, and what it costs, by resolution, ray count and addressing.
// Nearest cells are compared with the exact query ray by ray; must/may tables must agree with it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "answers.h"
#include "image/atomic_file.h"
#include "image/metrics.h"
#include "lkao/lkao.h"
#include "options.h"
#include "plane_errors.h"
#include "program.h"
#include "study_scenes.h"

namespace lkao::bench {
namespace {

struct Options {
  StudySceneOptions scenes;
  std::vector<int> resolutions = {32, 64, 128, 256};
  std::vector<int> ray_counts = {64, 128, 256, 512, 1024};
  std::vector<std::string> addressings = {"cube", "slices"};
  std::vector<std::string> masks = {"nearest", "must_may"};
  std::vector<std::string> node_masks = {"sphere", "outline"};
  std::string falloff = "constant";
  double max_mib = 1024;
  int plane_count = 10'000;
  int round_count = 1;
  std::string csv;
};

const std::map<std::string, PlaneAddressing> kAddressings = {{"cube", PlaneAddressing::cube},
                                                             {"slices", PlaneAddressing::slices}};
const std::map<std::string, PlaneMasks> kMasks = {{"nearest", PlaneMasks::nearest}, {"must_may", PlaneMasks::must_may}};
const std::map<std::string, NodeMasks> kNodeMasks = {{"sphere", NodeMasks::bounding_sphere},
                                                     {"outline", NodeMasks::box_outline}};

// A scene at one radius, and its exact answers for the pattern in use.
struct Case {
  const StudyScene* scene;
  OccluderBvh occluders;
  float radius;
  Answers exact;            // of the scalar kernel
  double simd_seconds = 0;  // of the other exact kernel
};

std::vector<Case> make_cases(const std::vector<StudyScene>& scenes) {
  std::vector<Case> cases;
  for (const StudyScene& scene : scenes) {
    const OccluderBvh occluders(scene.mesh.view());
    for (const float radius : scene.radii) cases.push_back({&scene, occluders, radius, {}, 0});
  }
  return cases;
}

// One table in use on one scene.
struct Result {
  double wrong_rays = 0;  // a receiver
  image::Metrics error;
  std::uint64_t ray_count = 0;
  double seconds = 0;
};

Result measure(const Case& c, const PlaneMaskTable& table, NodeMasks node_masks, int round_count) {
  const AmbientOcclusion ao(c.occluders, table, {.radius = c.radius}, node_masks);
  const Answers answers = ask({&ao, 1}, c.scene->receivers, round_count).front();
  const Deviation off = deviation(answers, c.exact);
  return {static_cast<double>(off.wrong_ray_count) / static_cast<double>(c.scene->receivers.size()), off.error,
          answers.ray_count, answers.seconds};
}

// The plain mean over scenes; times and rays are added up.
Result mean(const std::vector<Result>& results) {
  Result sum;
  const auto share = 1.0 / static_cast<double>(results.size());
  for (const Result& result : results) {
    sum.wrong_rays += share * result.wrong_rays;
    sum.error.mae += share * result.error.mae;
    sum.error.rmse += share * result.error.rmse;
    sum.error.equal_8bit_share += share * result.error.equal_8bit_share;
    sum.error.max_error = std::max(sum.error.max_error, result.error.max_error);
    sum.ray_count += result.ray_count;
    sum.seconds += result.seconds;
  }
  return sum;
}

double mrays_per_second(std::uint64_t ray_count, double seconds) {
  return 1e-6 * static_cast<double>(ray_count) / seconds;
}

// What the rows of a table have in common.
struct TableNames {
  std::string addressing, masks;
};

// Rays a plane that are wrong, or in doubt where the table knows its doubts.
double error_of(const RayErrors& errors, PlaneMasks masks) {
  return masks == PlaneMasks::nearest ? errors.wrong : errors.in_doubt;
}

class Report {
 public:
  Report() {
    csv_ =
        "scene,radius,receivers,rays,resolution,addressing,masks,node_masks,bytes,build_seconds,edge_rays,plane_rays,"
        "triangle_rays,wrong_receiver_rays,mae,rmse,max_error,exact_8bit_share,mrays_per_second,"
        "scalar_mrays_per_second,simd_mrays_per_second\n";
  }

  void print_heading() const {
    fmt::print(
        "Rays in error (nearest) or in doubt (must_may) of each edge, plane and triangle; wrong rays of each\n"
        "receiver, errors and speed as means over the scenes.\n\n"
        "{:>5} {:>5} {:7} {:8} {:7} {:>7} {:>7} {:>6} {:>6} {:>8} {:>8} {:>8} {:>8} {:>6} {:>7}\n",
        "rays", "res.", "cells", "masks", "nodes", "MiB", "build/s", "edge", "plane", "triangle", "receiver", "MAE",
        "RMSE", "exact", "Mrays/s");
  }

  void print(const PlaneMaskTable& table, const TableNames& names, const std::string& node_masks,
             const PlaneErrors& planes, const Result& result) const {
    const PlaneMasks masks = table.options().masks;
    fmt::print(
        "{:5} {:5} {:7} {:8} {:7} {:7.1f} {:7.3f} {:6.3f} {:6.3f} {:8.4f} {:8.4f} {:8.6f} {:8.6f} {:6.4f} {:7.2f}\n",
        table.pattern().ray_count(), table.options().resolution, names.addressing, names.masks, node_masks,
        static_cast<double>(table.memory_bytes()) / 0x1p20, table.build_seconds(), error_of(planes.edge, masks),
        error_of(planes.plane, masks), error_of(planes.triangle, masks), result.wrong_rays, result.error.mae,
        result.error.rmse, result.error.equal_8bit_share, mrays_per_second(result.ray_count, result.seconds));
    std::fflush(stdout);
  }

  void add(const Case& c, const PlaneMaskTable& table, const TableNames& names, const std::string& node_masks,
           const PlaneErrors& planes, const Result& result) {
    const PlaneMasks masks = table.options().masks;
    csv_ += fmt::format(
        "{},{:g},{},{},{},{},{},{},{},{:.4f},{:.5f},{:.5f},{:.5f},{:.6f},{:.8f},{:.8f},{:.6f},{:.6f},"
        "{:.3f},{:.3f},{:.3f}\n",
        c.scene->name, c.radius, c.scene->receivers.size(), table.pattern().ray_count(), table.options().resolution,
        names.addressing, names.masks, node_masks, table.memory_bytes(), table.build_seconds(),
        error_of(planes.edge, masks), error_of(planes.plane, masks), error_of(planes.triangle, masks),
        result.wrong_rays, result.error.mae, result.error.rmse, result.error.max_error, result.error.equal_8bit_share,
        mrays_per_second(result.ray_count, result.seconds), mrays_per_second(c.exact.ray_count, c.exact.seconds),
        mrays_per_second(c.exact.ray_count, c.simd_seconds));
  }

  const std::string& csv() const { return csv_; }

 private:
  std::string csv_;
};

class Study {
 public:
  explicit Study(const Options& options) : options_(options) {
    if (!options.csv.empty()) csv_file_.emplace(options.csv);  // now, not after minutes
    scenes_ = load_study_scenes(options.scenes);
    cases_ = make_cases(scenes_);
  }

  // False where a must/may table was found to be wrong.
  bool run() {
    report_.print_heading();
    for (const int ray_count : options_.ray_counts) study_ray_count(ray_count);
    if (csv_file_) write_csv();
    if (has_must_may_ && wrong_must_may_rays_ == 0) fmt::print("\nmust_may: no ray differs from the exact kernel\n");
    if (wrong_must_may_rays_ > 0)
      fmt::print("\nmust_may: RAYS DIFFER from the exact kernel, or lie outside the bounds\n");
    return wrong_must_may_rays_ == 0;
  }

 private:
  void write_csv() {
    std::ofstream(csv_file_->temporary_path(), std::ios::binary) << report_.csv();
    csv_file_->commit();
  }

  void study_ray_count(int ray_count) {
    const SamplePattern pattern = SamplePattern::standard(ray_count).with_falloff(Falloff::named(options_.falloff));
    const PlaneSamples samples(pattern, options_.plane_count, 1);
    ask_exactly(pattern);
    for (const int resolution : options_.resolutions) {
      for (const std::string& masks : options_.masks) {
        for (const std::string& addressing : options_.addressings) {
          study_table(pattern, samples, {resolution, kAddressings.at(addressing), kMasks.at(masks)},
                      {addressing, masks});
        }
      }
    }
  }

  void ask_exactly(const SamplePattern& pattern) {
    std::uint64_t ray_count = 0;
    double scalar_seconds = 0, simd_seconds = 0;
    for (Case& c : cases_) {
      const auto ask_kernel = [&](Kernel kernel) {
        const AmbientOcclusion ao(c.occluders, pattern, {.radius = c.radius}, kernel);
        return ask({&ao, 1}, c.scene->receivers, options_.round_count).front();
      };
      c.exact = ask_kernel(Kernel::scalar);
      c.simd_seconds = ask_kernel(Kernel::simd).seconds;
      ray_count += c.exact.ray_count;
      scalar_seconds += c.exact.seconds;
      simd_seconds += c.simd_seconds;
    }
    fmt::print("{:5} rays, exact kernels without a table: scalar {:.2f}, SIMD {:.2f} Mrays/s\n", pattern.ray_count(),
               mrays_per_second(ray_count, scalar_seconds), mrays_per_second(ray_count, simd_seconds));
  }

  void study_table(const SamplePattern& pattern, const PlaneSamples& samples, const PlaneMaskTableOptions& options,
                   const TableNames& names) {
    if (const double mib = expected_mib(pattern, options); mib > options_.max_mib) {
      fmt::print("{:5} {:5} {:7} {:8} left out: {:.0f} MiB are above --max-mib {:.0f}\n", pattern.ray_count(),
                 options.resolution, names.addressing, names.masks, mib, options_.max_mib);
      return;
    }
    const PlaneMaskTable table(pattern, options);
    const PlaneErrors planes = samples.errors(table);
    for (const std::string& node_masks : options_.node_masks) {
      std::vector<Result> results;
      for (const Case& c : cases_) {
        results.push_back(measure(c, table, kNodeMasks.at(node_masks), options_.round_count));
        report_.add(c, table, names, node_masks, planes, results.back());
      }
      report_.print(table, names, node_masks, planes, mean(results));
      if (options.masks == PlaneMasks::must_may) {
        has_must_may_ = true;
        wrong_must_may_rays_ +=
            mean(results).wrong_rays + planes.edge.wrong + planes.plane.wrong + planes.triangle.wrong;
      }
    }
  }

  static double expected_mib(const SamplePattern& pattern, const PlaneMaskTableOptions& options) {
    const auto lengths = pattern.lengths();
    const bool has_full_length = std::all_of(lengths.begin(), lengths.end(), [](float l) { return l == 1; });
    return std::pow(options.resolution, 3) * pattern.ray_count() / 8 / 0x1p20 *
           (options.masks == PlaneMasks::must_may ? 2 : 1) * (has_full_length ? 1 : 2);
  }

  Options options_;
  std::optional<image::AtomicFile> csv_file_;
  std::vector<StudyScene> scenes_;
  std::vector<Case> cases_;
  Report report_;
  bool has_must_may_ = false;
  double wrong_must_may_rays_ = 0;
};

template <typename Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App program("Error, size and speed of plane mask tables.", "lkao_bench_tables");
  add_scene_options(program, options.scenes);
  add_size_options(program, options.scenes);
  program.add_option("--resolutions", options.resolutions)->delimiter(',')->capture_default_str();
  program.add_option("--rays", options.ray_counts)->delimiter(',')->capture_default_str();
  program.add_option("--addressings", options.addressings)
      ->delimiter(',')
      ->check(CLI::IsMember(names_of(kAddressings)))
      ->capture_default_str();
  program.add_option("--masks", options.masks)
      ->delimiter(',')
      ->check(CLI::IsMember(names_of(kMasks)))
      ->capture_default_str();
  program.add_option("--node-masks", options.node_masks)
      ->delimiter(',')
      ->check(CLI::IsMember(names_of(kNodeMasks)))
      ->capture_default_str();
  program.add_option("--falloff", options.falloff, "of the ray lengths")->capture_default_str();
  program.add_option("--max-mib", options.max_mib, "leave larger tables out")->capture_default_str();
  program.add_option("--planes", options.plane_count, "random planes and triangles")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_rounds_option(program, options.round_count);
  add_csv_option(program, options.csv);
  return run_program(program, argc, argv, [&] { return Study(options).run() ? 0 : 1; });
}

}  // namespace
}  // namespace lkao::bench

int main(int argc, char** argv) { return lkao::bench::run(argc, argv); }
