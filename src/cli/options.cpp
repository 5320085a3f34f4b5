#include "cli/options.h"

#include <string>

#include "cli/parse.h"
#include "cli/parsed_option.h"

namespace lkao::cli {
namespace {

constexpr int kMaxThreadCount = 1024;

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& options) {
  const auto parse_thread_count = [](const std::string& text) { return parse_integer(text, 1, kMaxThreadCount); };
  add_parsed(app, "--threads", options.thread_count, parse_thread_count, "Threads to use (default: all)")
      ->type_name("N");
  app.add_option("--json", options.json_path, "Write the results as JSON; - for stdout, instead of the table")
      ->type_name("FILE");
  app.add_flag("--quiet", options.quiet, "No table and no progress bar");
}

void add_occlusion_options(CLI::App& app, OcclusionOptions& options) {
  add_parsed(app, "--radius", options.radius, method::parse_radius,
             "AO radius, the length of the longest ray: a length in the scene's unit; or as 5%, of the diagonal of the "
             "scene's box; or inf, then rays go beyond the scene, and JSON says null (required)")
      ->type_name("R|P%|inf");
  add_parsed(app, "--samples", options.ray_count, parse_ray_count, "Rays a receiver, from 1 to 1024 (default: 128)")
      ->type_name("N");
  const auto parse_weighting = [](const std::string& text) {
    return method::parse_word(method::kWeightingWords, text);
  };
  add_parsed(app, "--weighting", options.weighting, parse_weighting,
             "What the mean over rays stands for: cosine, as renderers define ambient occlusion, or uniform, the share "
             "of the hemisphere's solid angle (default: cosine)")
      ->type_name(method::join(method::list_words(method::kWeightingWords), "|"));
  add_parsed(app, "--falloff", options.falloff, Falloff::named,
             "How occluders fade with distance: constant, linear, smooth or exponential (default: constant)")
      ->type_name("NAME");
  const auto parse_sidedness = [](const std::string& text) {
    return method::parse_word(method::kSidednessWords, text);
  };
  add_parsed(app, "--sided", options.sidedness, parse_sidedness,
             "Sides from which triangles block: one (their front) or two (default: two)")
      ->type_name(method::join(method::list_words(method::kSidednessWords), "|"));
  add_parsed(app, "--seed", options.seed, parse_seed, "Seed of the per-receiver jitter (default: 0)")->type_name("S");
  add_parsed(app, "--min-distance", options.min_distance, parse_non_negative_number,
             "Only what is at least so far away occludes: a length in the scene's unit, less than the radius "
             "(default: 0)")
      ->type_name("D");
}

method::Question OcclusionOptions::question(double length) const {
  return {.radius = static_cast<float>(length),
          .ray_count = ray_count,
          .weighting = weighting,
          .falloff = falloff,
          .sidedness = sidedness,
          .seed = seed,
          .min_distance = static_cast<float>(min_distance)};
}

}  // namespace lkao::cli
