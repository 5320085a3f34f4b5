// lkao simplify: a scene as a chain of levels of detail.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/lod_option.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/parse.h"
#include "cli/parsed_option.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/scene_input.h"
#include "lod/chain_file.h"
#include "lod/simplify.h"
#include "method/stopwatch.h"

namespace lkao::cli {
namespace {

struct SimplifyCommandOptions {
  std::string scene;
  std::string output;
  std::optional<method::Radius> radius;
  std::optional<double> epsilon;
  double k = 3;
  double growth = 3;
  int level_count = 4;
  CommonOptions common;
};

struct Simplification {
  SceneInput scene;
  lod::Simplified simplified;
  double seconds = 0;
};

lod::LevelRule rule_of(const SimplifyCommandOptions& options, const SceneInput& scene) {
  lod::LevelRule rule;
  rule.k = static_cast<float>(options.k);
  rule.growth = static_cast<float>(options.growth);
  rule.level_count = options.level_count;
  if (options.epsilon) {
    rule.epsilon = static_cast<float>(*options.epsilon);
  } else if (options.radius) {
    const double radius = resolve_radius(options.radius, scene);
    rule.epsilon = lod::automatic_epsilon(scene.mesh, static_cast<float>(radius), rule);
  } else {
    const scene::SuggestedRadii radii = suggest_radii(scene.name, scene::bounds_of(scene.mesh));
    throw std::invalid_argument(
        fmt::format("--radius or --epsilon is required; a radius of {} (small) or {} (large) would suit {}",
                    radii.small, radii.large, scene.name));
  }
  return rule;
}

Simplification compute(const SimplifyCommandOptions& options, ProgressBar& progress) {
  Simplification result;
  progress.begin("loading " + options.scene);
  result.scene = load_scene({.name = options.scene});
  const lod::LevelRule rule = rule_of(options, result.scene);
  progress.clear();
  print_notes(result.scene.notes);

  const method::Stopwatch watch;
  result.simplified = simplify_watched(result.scene.mesh, rule, progress);
  result.seconds = watch.seconds();
  return result;
}

Json distance_json(const lod::Distance& distance) {
  return {{"maximum", distance.maximum},
          {"bound", distance.bound},
          {"rms", distance.rms()},
          {"samples", distance.sample_count}};
}

Json level_json(const lod::Level& level, const lod::LevelReport& report) {
  Json json = {{"triangles", report.triangle_count}, {"epsilon", level.epsilon}, {"r_min", level.r_min}};
  json["r_max"] = level.r_max;  // null for infinity
  json["area"] = report.area;
  if (level.epsilon == 0) return json;
  json["sample_spacing"] = report.spacing;
  json["from_original"] = distance_json(report.from_original);
  json["to_original"] = distance_json(report.to_original);
  json["parts_redone"] = report.redone_part_count;
  json["parts_kept_finer"] = report.fallen_back_part_count;
  json["thread_seconds"] = report.thread_seconds;
  return json;
}

Json document_of(const SimplifyCommandOptions& options, const Simplification& result) {
  const lod::SimplifyReport& report = result.simplified.report;
  const lod::Chain& chain = result.simplified.chain;
  Json document;
  document["scene"] = options.scene;
  add_scene_keys(document, result.scene);
  document["k"] = chain.k;
  document["growth"] = chain.growth;
  document["duplicates_left_out"] = report.duplicate_count;
  document["simplified"] = {{"parts", report.simplified_part_count},
                            {"triangles", report.simplified_part_triangle_count}};
  document["too_small"] = {{"parts", report.small_part_count}, {"triangles", report.small_part_triangle_count}};
  document["refused"] = report.refused_count;
  document["not_manifold"] = {{"crowded_edges", report.crowded_edge_count},
                              {"wrong_winding_edges", report.wrong_winding_edge_count},
                              {"split_vertices", report.split_vertex_count}};
  document["levels"] = Json::array();
  for (std::size_t i = 0; i < chain.levels.size(); ++i) {
    document["levels"].push_back(level_json(chain.levels[i], report.levels[i]));
  }
  document["seconds"] = result.seconds;
  document["threads"] = tbb::this_task_arena::max_concurrency();
  return document;
}

using Row = std::vector<std::string>;

Row level_row(std::size_t number, const lod::Level& level, const lod::LevelReport& report,
              const lod::LevelReport& original) {
  const auto share = [](double part, double whole) { return fmt::format("{:.1f} %", 100 * part / whole); };
  const auto distance = [](const lod::Distance& d) { return fmt::format("{:.3g} ({:.2g})", d.maximum, d.rms()); };
  Row row = {fmt::format("{}", number),
             fmt::format("{:.4g}", level.r_min),
             fmt::format("{:.4g}", level.r_max),
             grouped(report.triangle_count),
             share(static_cast<double>(report.triangle_count), static_cast<double>(original.triangle_count)),
             share(report.area, original.area)};
  if (level.epsilon == 0) return row;
  const Row measured = {fmt::format("{:.3g}", level.epsilon),
                        distance(report.from_original),
                        distance(report.to_original),
                        fmt::format("{:.2g}", report.spacing),
                        fmt::format("{:.3g}", std::max(report.from_original.bound, report.to_original.bound)),
                        grouped(report.redone_part_count),
                        grouped(report.fallen_back_part_count),
                        fmt::format("{:.2f}", report.thread_seconds)};
  row.insert(row.end(), measured.begin(), measured.end());
  return row;
}

void print_rows(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("{}{:>{}}", i == 0 ? "" : "  ", row[i], widths[i]);
    fmt::print("{}\n", line);
  }
}

void print_table(const SimplifyCommandOptions& options, const Simplification& result) {
  const lod::SimplifyReport& report = result.simplified.report;
  Table table;
  add_scene_row(table, result.scene);
  table.add("simplified",
            fmt::format("{} triangles in {} connected parts, {:.3f} s", grouped(report.simplified_part_triangle_count),
                        grouped(report.simplified_part_count), result.seconds));
  table.add("as they are",
            fmt::format("{} triangles in {} parts too small, {} refused", grouped(report.small_part_triangle_count),
                        grouped(report.small_part_count), grouped(report.refused_count)));
  table.add("left out", fmt::format("{} duplicate triangles", grouped(report.duplicate_count)));
  table.add("not manifold",
            fmt::format("{} edges of more than two triangles, {} of opposite windings; {} vertices split",
                        grouped(report.crowded_edge_count), grouped(report.wrong_winding_edge_count),
                        grouped(report.split_vertex_count)));
  table.add("wrote", options.output);
  table.print();

  std::vector<Row> rows = {{"level", "r min", "r max", "triangles", "share", "area", "epsilon", "from original",
                            "to original", "spacing", "bound", "redone", "kept finer", "thread s"}};
  const lod::Chain& chain = result.simplified.chain;
  for (std::size_t i = 0; i < chain.levels.size(); ++i) {
    rows.push_back(level_row(i, chain.levels[i], report.levels[i], report.levels[0]));
  }
  fmt::print("\n");
  print_rows(rows);
  fmt::print(
      "\nDistances: maximum (RMS) over samples; no point is farther than the bound. Redone, kept finer: parts.\n");
}

void simplify(const SimplifyCommandOptions& options) {
  const auto level_count = static_cast<std::size_t>(options.level_count);
  OutputFiles outputs({options.scene});
  std::vector<std::string> targets;
  for (const std::string& file : lod::chain_files(options.output, level_count)) targets.push_back(outputs.claim(file));
  const JsonOutput json(options.common.json_path, outputs);

  ProgressBar progress(!options.common.quiet);
  const Simplification result = compute(options, progress);
  lod::write_chain(result.simplified.chain, options.output, targets);
  json.write_and_commit(document_of(options, result));
  if (options.common.wants_table()) print_table(options, result);
}

double parse_growth(const std::string& text) {
  const double growth = parse_positive_number(text);
  if (static_cast<float>(growth) > 1) return growth;
  throw std::invalid_argument(fmt::format("expected a number above 1, got '{}'", text));
}

std::string parse_chain_name(const std::string& text) {
  lod::chain_files(text, 0);  // throws for other endings
  return text;
}

void add_options(CLI::App& app, SimplifyCommandOptions& options) {
  add_scene_argument(app, options.scene);
  add_parsed(app, "-o,--output", options.output, parse_chain_name,
             "Chain: NAME.json, with NAME.0.ply, NAME.1.ply ... beside it")
      ->required()
      ->type_name("FILE");
  auto* const radius = add_parsed(app, "--radius", options.radius, method::parse_radius,
                                  "AO radius, a length or as 5% of the scene's diagonal: the last level begins at half "
                                  "of it, of the scene's diagonal where it is "
                                  "inf (or give --epsilon)");
  radius->type_name("R|P%|inf");
  add_parsed(app, "--epsilon", options.epsilon, parse_positive_number,
             "Allowed error of the first simplified level, in the scene's unit")
      ->type_name("E")
      ->excludes(radius);
  add_parsed(app, "--k", options.k, parse_positive_number,
             "How many times its error a level stays away from the receiver, usually 2 to 5 (default: 3)")
      ->type_name("K");
  add_parsed(app, "--growth", options.growth, parse_growth, "Factor from level to level (default: 3)")->type_name("G");
  const auto parse_level_count = [](const std::string& text) { return parse_integer(text, 1, lod::kMaxLevelCount); };
  add_parsed(app, "--levels", options.level_count, parse_level_count, "Levels, with the original (default: 4)")
      ->type_name("N");
  add_common_options(app, options.common);
  app.footer("Level 0 is the scene itself. See src/lod/README.md for what the columns mean.");
}

}  // namespace

Command add_simplify_command(CLI::App& program) {
  const auto options = std::make_shared<SimplifyCommandOptions>();
  CLI::App* const app = program.add_subcommand("simplify", "Make levels of detail of a scene, each within an error");
  add_options(*app, *options);
  const auto run = [options] {
    with_threads(options->common.thread_count, [&] { simplify(*options); });
    return kSuccess;
  };
  return {app, run};
}

}  // namespace lkao::cli
