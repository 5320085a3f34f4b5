// lkao-bench refit: hierarchies of deformed meshes, refitted against built anew, and queries in both.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/deformations.h"
#include "bench/geometric_mean.h"
#include "bench/options.h"
#include "bench/study_scenes.h"
#include "bench/word_option.h"
#include "bench/work_clock.h"
#include "lkao/lkao.h"
#include "method/median.h"

namespace lkao::bench {
namespace {

struct RefitStudyOptions {
  StudySceneOptions scenes;
  std::vector<Deformation> deformations = {Deformation::twist, Deformation::bend, Deformation::shake};
  int round_count = 5;
  std::string csv;
};

Columns refit_csv_columns() {
  return {{"scene"},
          {"triangles"},
          {"spatial_splits"},
          {"deformation"},
          {"strength", "{:g}"},
          {"radius", "{:g}"},
          {"build_seconds", "{:.6g}"},
          {"refit_seconds", "{:.6g}"},
          {"time_ratio", "{:.4f}"},
          {"growth", "{:.4f}"},
          {"cost_ratio", "{:.4f}"},
          {"built_query_us", "{:.5g}"},
          {"refitted_query_us", "{:.5g}"},
          {"query_ratio", "{:.4f}"},
          {"mismatched_rays"},
          {"rays"}};
}

Columns refit_table_columns() {
  return {{"scene", "{}", -14},
          {"spatial_splits", "{}", 6, "splits"},
          {"deformation", "{}", -11},
          {"strength", "{:g}", 8},
          {"radius", "{:g}", 8},
          kBar,
          {"build_seconds", "{:.3f} s", 9, "build"},
          {"refit_seconds", "{:.3f} s", 9, "refit"},
          {"time_ratio", "{:.3f}", 6, "ratio"},
          kBar,
          {"growth", "{:.2f}", 6},
          {"cost_ratio", "{:.2f}", 6, "x cost"},
          {"query_ratio", "{:.2f}", 7, "x query"},
          {"mismatched_rays", "{}", 10, "mismatched"}};
}

std::uint64_t differing_bits(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += static_cast<std::uint64_t>(std::popcount(a[i] ^ b[i]));
  return count;
}

template <typename Work>
double seconds_of(const Work& work) {
  const WorkClock clock(1);
  work();
  return clock.seconds();
}

// A mesh where it was and where it is now: round after round built, refitted and queried, on one thread.
class Moved {
 public:
  Moved(const StudyScene& before, const StudyScene& now, bool spatial_splits)
      : now_(now), options_{.spatial_splits = spatial_splits}, before_(before.mesh.view(), options_) {}

  void run_hierarchies() {
    built_.reset();  // not more than one at a time besides the first
    refitted_.reset();
    build_seconds_.push_back(seconds_of([&] { built_.emplace(now_.mesh.view(), options_); }));
    refit_seconds_.push_back(
        seconds_of([&] { refitted_.emplace(before_.refitted(now_.mesh.view().positions, kNeverAnew)); }));
  }

  double time_ratio() const { return method::median(refit_seconds_) / method::median(build_seconds_); }

  // Of the last round's hierarchies.
  Measurement query(float radius, int round_count) const {
    const Queries built(*built_, now_.receivers, radius), refitted(*refitted_, now_.receivers, radius);
    std::vector<double> built_seconds, refitted_seconds;
    std::vector<std::uint64_t> built_masks, refitted_masks;
    for (int round = 0; round < round_count; ++round) {
      built_seconds.push_back(built.seconds(built_masks));
      refitted_seconds.push_back(refitted.seconds(refitted_masks));
    }
    const double per_receiver = 1e6 / static_cast<double>(now_.receivers.size());
    const double of_built = method::median(built_seconds), of_refitted = method::median(refitted_seconds);
    const BuildReport &now = refitted_->report(), &anew = built_->report();
    return {{"radius", radius},
            {"build_seconds", method::median(build_seconds_)},
            {"refit_seconds", method::median(refit_seconds_)},
            {"time_ratio", time_ratio()},
            {"growth", now.growth},
            {"cost_ratio", now.surface_area_cost / anew.surface_area_cost},
            {"built_query_us", of_built * per_receiver},
            {"refitted_query_us", of_refitted * per_receiver},
            {"query_ratio", of_refitted / of_built},
            {"mismatched_rays", differing_bits(built_masks, refitted_masks)},
            {"rays", now_.receivers.size() * kRayCount}};
  }

 private:
  static constexpr RefitOptions kNeverAnew{.max_growth = std::numeric_limits<double>::infinity()};
  static constexpr int kRayCount = 128;

  class Queries {
   public:
    Queries(const OccluderBvh& occluders, const std::vector<Receiver>& receivers, float radius)
        : ao_(occluders, SamplePattern::standard(kRayCount), {.radius = radius}), receivers_(receivers) {}

    double seconds(std::vector<std::uint64_t>& masks) const {
      masks.assign(receivers_.size() * static_cast<std::size_t>(ao_.pattern().word_count()), 0);
      return seconds_of([&] { ao_.query(receivers_, {.mask_words = masks}); });
    }

   private:
    const AmbientOcclusion ao_;
    const std::vector<Receiver>& receivers_;
  };

  const StudyScene& now_;
  lkao::BuildOptions options_;
  OccluderBvh before_;
  std::optional<OccluderBvh> built_, refitted_;
  std::vector<double> build_seconds_, refit_seconds_;
};

class RefitStudy {
 public:
  explicit RefitStudy(const RefitStudyOptions& options) : options_(options), csv_(options.csv, refit_csv_columns()) {}

  void run() {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
    tbb::task_arena(1).execute([&] {
      const std::vector<std::string> names = study_scene_names(options_.scenes);
      fmt::print("{}", table_heading(columns_));
      for (const std::string& name : names) {
        const StudyScene scene = load_study_scene(name, options_.scenes);
        for (const Deformation deformation : options_.deformations) {
          for (const float strength : deformation_strengths(deformation)) move(scene, deformation, strength);
        }
      }
    });
    fmt::print("\nRefit over build, geometric mean: time {:.3f} with and {:.3f} without spatial splits\n",
               geometric_mean(time_ratios_[1]), geometric_mean(time_ratios_[0]));
  }

 private:
  void move(const StudyScene& scene, Deformation deformation, float strength) {
    scene::Mesh mesh = scene.mesh;
    mesh.positions = deform(mesh.positions, deformation, strength);
    const StudyScene now =
        look_at(scene.name, std::move(mesh), scene.radii, scene.camera, options_.scenes.width, options_.scenes.height);
    for (const bool spatial_splits : {true, false}) {
      Moved moved(scene, now, spatial_splits);
      for (int round = 0; round < options_.round_count; ++round) moved.run_hierarchies();
      for (const float radius : now.radii) {
        Measurement measurement = {{"scene", scene.name},
                                   {"triangles", scene.mesh.triangles.size()},
                                   {"spatial_splits", spatial_splits ? "yes" : "no"},
                                   {"deformation", word_of(kDeformationWords, deformation)},
                                   {"strength", strength}};
        const Measurement measured = moved.query(radius, options_.round_count);
        measurement.insert(measurement.end(), measured.begin(), measured.end());
        fmt::print("{}", table_row(columns_, measurement));
        std::fflush(stdout);
        csv_.write(measurement);
      }
      time_ratios_[spatial_splits ? 1 : 0].push_back(moved.time_ratio());
    }
  }

  RefitStudyOptions options_;
  CsvFile csv_;
  const Columns columns_ = refit_table_columns();
  std::vector<double> time_ratios_[2];  // without and with spatial splits
};

}  // namespace

Command add_refit_command(CLI::App& program) {
  auto options = std::make_shared<RefitStudyOptions>();
  options->scenes.width = 128, options->scenes.height = 96;
  CLI::App* app = program.add_subcommand(
      "refit",
      "Deformed meshes: hierarchies refitted against built anew, and queries of 128 rays in both, on one thread.");
  add_scene_options(*app, options->scenes);
  add_size_options(*app, options->scenes);
  add_words_option(*app, "--deformations", options->deformations, kDeformationWords);
  add_rounds_option(*app, options->round_count);
  add_csv_option(*app, options->csv);
  return {app, [options] {
            RefitStudy(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
