// lkao-bench foliage: rays among cards with leaves on them, lkao against Embree with the same filter.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/compared_isas.h"
#include "bench/contest.h"
#include "bench/csv_file.h"
#include "bench/embree_modes.h"
#include "bench/filtered_scene.h"
#include "bench/foliage.h"
#include "bench/options.h"
#include "bench/tiles.h"
#include "lkao/isa.h"
#include "lkao/lkao.h"
#include "reference/embree_reference.h"
#include "scene/holes.h"

namespace lkao::bench {
namespace {

struct FoliageOptions {
  std::vector<std::string> scenes;
  std::vector<int> ray_counts = {128, 512};
  std::vector<int> thread_counts = {1};
  std::vector<std::string> isas;
  int round_count = 5;
  int tile_count = 4;
  std::string csv;
};

constexpr const char* kQuery = "lkao";
// The same with a filter that the library knows nothing of.
constexpr const char* kBlindQuery = "lkao_blind";
// The same cards without holes: what is lost by them.
constexpr const char* kWholeQuery = "lkao_whole";

Columns foliage_csv_columns() {
  return {{"scene"},
          {"triangles"},
          {"cards"},
          {"radius", "{:g}"},
          {"samples"},
          {"isa"},
          {"threads"},
          {"method"},
          {"mrays_per_second", "{:.6g}"},
          {"best_embree_mode"},
          {"best_embree_mrays", "{:.6g}"},
          {"ratio_best", "{:.5g}"},
          {"ray_mismatch_rate", "{:.4g}"},
          {"blocked_share", "{:.4g}"}};
}

Columns foliage_table_columns() {
  return {{"scene", "{}", -8},
          {"cards", "{}", 6},
          {"radius", "{:g}", 6},
          {"samples", "{}", 5, "rays"},
          {"isa", "{}", 8},
          {"threads", "{}", 3, "thr"},
          kBar,
          {"mrays_per_second", "{:.1f}", 8, "lkao"},
          {"blind", "{:.1f}", 8},
          {"whole", "{:.1f}", 8},
          kBar,
          {"best_embree_mode", "{}", -28, "best of Embree"},
          {"best_embree_mrays", "{:.1f}", 8, "Mrays/s"},
          {"ratio_best", "{:.2f}", 6, "x best"},
          {"ratio_blind", "{:.2f}", 7, "blind x"},
          kBar,
          {"ray_mismatch_rate", "{:.2g}", 8, "mismatch"},
          {"embree_mismatch_rate", "{:.2g}", 8, "Embree"},
          {"blocked_share", "{:.2f}", 7, "blocked"}};
}

// The same cards with all that is known of their holes, with the filter alone, and without holes.
struct Hierarchies {
  explicit Hierarchies(const scene::Mesh& mesh) : Hierarchies(mesh, scene::cut_outs_of(mesh.holes)) {}
  Hierarchies(const scene::Mesh& mesh, const CutOuts& cut_outs)
      : surveyed(mesh.view(), {.cut_outs = cut_outs}),
        blind(mesh.view(), {.cut_outs = {cut_outs.opacities, cut_outs.blocks}}),
        whole(mesh.view()) {}

  OccluderBvh surveyed, blind, whole;
};

class FoliageComparison {
 public:
  explicit FoliageComparison(const FoliageOptions& options)
      : options_(options),
        isas_(compared_isas(options.isas)),
        csv_(options.csv, foliage_csv_columns(), {timing_remark(options.round_count)}) {}

  void run() {
    fmt::print("{}", table_heading(columns_));
    for (const std::string& name : options_.scenes.empty() ? foliage_names() : options_.scenes) {
      const StudyScene scene = make_foliage(name, 1024, 768);
      const std::vector<Receiver> receivers = choose_tiles(scene, options_.tile_count);
      const Hierarchies hierarchies(scene.mesh);
      const reference::EmbreeReference oracle(scene.mesh, {});
      for (const ComparedIsa& isa : isas_) {
        force_isa(isa.lkao);
        const FilteredScene rival(scene.mesh, isa.embree_config);
        for (const float radius : scene.radii) {
          for (const int ray_count : options_.ray_counts) {
            measure(scene, hierarchies, receivers, oracle, rival,
                    {.isa = isa.name, .radius = radius, .ray_count = ray_count});
          }
        }
      }
    }
  }

 private:
  struct Question {
    std::string isa;
    float radius;
    int ray_count;
  };

  void measure(const StudyScene& scene, const Hierarchies& hierarchies, std::span<const Receiver> receivers,
               const reference::EmbreeReference& oracle, const FilteredScene& rival, const Question& question) {
    const auto ask = [&](const OccluderBvh& occluders) {
      return AmbientOcclusion(occluders, SamplePattern::standard(question.ray_count), {.radius = question.radius});
    };
    const AmbientOcclusion query = ask(hierarchies.surveyed), blind = ask(hierarchies.blind),
                           whole = ask(hierarchies.whole);
    const Masks masks(receivers.size() * static_cast<std::size_t>(query.pattern().word_count()));
    Masks expected = masks;
    const QueryReport report = oracle.query(query, receivers, {.mask_words = expected});
    for (const int thread_count : options_.thread_counts) {
      std::vector<Rival> rivals;
      for (const auto& [name, ao] : {std::pair{kQuery, &query}, {kBlindQuery, &blind}, {kWholeQuery, &whole}}) {
        const auto answer = [ao = ao, receivers](Masks& to) { ao->query(receivers, {.mask_words = to}); };
        rivals.push_back({name, options_.round_count, answer, masks});
      }
      for (const EmbreeMode& mode : all_embree_modes()) {
        const auto answer = [&, mode](Masks& to) { cast(mode, rival.scene(), query, receivers, to); };
        rivals.push_back({mode.name(), options_.round_count, answer, masks});
      }
      run_rounds(rivals, thread_count);
      std::vector<MethodResult> results;
      results.reserve(rivals.size());
      for (const Rival& one : rivals) {
        results.push_back(result_of(one, expected, static_cast<double>(report.ray_count)));
      }
      add(scene, question, thread_count, report, results);
    }
  }

  void add(const StudyScene& scene, const Question& question, int thread_count, const QueryReport& report,
           const std::vector<MethodResult>& results) {
    const MethodResult& best = *fastest(results, "embree");
    const MethodResult &blind = results[1], &whole = results[2];
    const auto measurement_of = [&](const MethodResult& result) -> Measurement {
      return {{"scene", scene.name},
              {"triangles", scene.mesh.triangles.size()},
              {"cards", scene.mesh.holes->triangles.size() / 2},
              {"radius", question.radius},
              {"samples", question.ray_count},
              {"isa", question.isa},
              {"threads", thread_count},
              {"method", result.method},
              {"mrays_per_second", result.mrays_per_second},
              {"blind", blind.mrays_per_second},
              {"whole", whole.mrays_per_second},
              {"best_embree_mode", best.method},
              {"best_embree_mrays", best.mrays_per_second},
              {"ratio_best", speed_ratio(result, best)},
              {"ratio_blind", speed_ratio(blind, best)},
              {"ray_mismatch_rate", result.mismatch_rate},
              {"embree_mismatch_rate", best.mismatch_rate},
              {"blocked_share", static_cast<double>(report.blocked_ray_count) / static_cast<double>(report.ray_count)}};
    };
    for (const MethodResult& result : results) csv_.write(measurement_of(result));
    fmt::print("{}", table_row(columns_, measurement_of(results.front())));
    std::fflush(stdout);
  }

  FoliageOptions options_;
  std::vector<ComparedIsa> isas_;
  CsvFile csv_;
  const Columns columns_ = foliage_table_columns();
};

}  // namespace

Command add_foliage_command(CLI::App& program) {
  auto options = std::make_shared<FoliageOptions>();
  CLI::App* app = program.add_subcommand(
      "foliage",
      "Rays among cards with leaves on them, lkao against Embree with the same filter. One thread: by its CPU time; "
      "several: by wall time.");
  app->add_option("--scenes", options->scenes, "which: card, grass, trees")
      ->delimiter(',')
      ->check(CLI::IsMember(foliage_names()));
  add_ray_counts_option(*app, options->ray_counts);
  add_rounds_option(*app, options->round_count);
  add_tiles_option(*app, options->tile_count);
  add_threads_option(*app, options->thread_counts);
  add_isas_option(*app, options->isas);
  add_csv_option(*app, options->csv);
  return {app, [options] {
            check_ray_counts(options->ray_counts);
            FoliageComparison(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
