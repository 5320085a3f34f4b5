#include "cli/options.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/parse.h"
#include "cli/parsed_option.h"

namespace lkao::cli {
namespace {

constexpr int kMaxThreadCount = 1024;

}  // namespace

std::string_view name_of(KernelChoice kernel) {
  switch (kernel) {
    case KernelChoice::simd:
      return "simd";
    case KernelChoice::scalar:
      return "scalar";
    case KernelChoice::table:
      return "table";
    case KernelChoice::nearest:
      break;
  }
  return "nearest";
}

void add_common_options(CLI::App& app, CommonOptions& options) {
  const auto parse_thread_count = [](const std::string& text) { return parse_integer(text, 1, kMaxThreadCount); };
  add_parsed(app, "--threads", options.thread_count, parse_thread_count, "Threads to use (default: all)")
      ->type_name("N");
  app.add_option("--json", options.json_path, "Write the results as JSON; - for stdout, instead of the table")
      ->type_name("FILE");
  app.add_flag("--quiet", options.quiet, "No table and no progress bar");
}

void add_occlusion_options(CLI::App& app, OcclusionOptions& options) {
  add_parsed(
      app, "--radius", options.radius, parse_radius,
      "AO radius: length of the longest ray, in the scene's unit; or inf, then rays go beyond the scene, and JSON "
      "says null (required)")
      ->type_name("R");
  add_parsed(app, "--samples", options.ray_count, parse_ray_count,
             "Rays a receiver: a multiple of 64 from 64 to 1024 (default: 128)")
      ->type_name("N");
  add_parsed(app, "--falloff", options.falloff, Falloff::named,
             "How occluders fade with distance: constant, linear, smooth or exponential (default: constant)")
      ->type_name("NAME");
  add_parsed(app, "--sided", options.sidedness, parse_sidedness,
             "Sides from which triangles block: one (their front) or two (default: two)")
      ->type_name("one|two");
  const auto parse_kernel = [](const std::string& text) {
    return parse_choice<KernelChoice>(text, {{"simd", KernelChoice::simd},
                                             {"scalar", KernelChoice::scalar},
                                             {"table", KernelChoice::table},
                                             {"nearest", KernelChoice::nearest}});
  };
  add_parsed(app, "--kernel", options.kernel, parse_kernel,
             "What answers the bvh method: simd; scalar, the definition; table, the paper's look-ups, exact; nearest, "
             "the same, approximate (default: simd)")
      ->type_name("NAME");
  add_parsed(app, "--seed", options.seed, parse_seed, "Seed of the per-receiver jitter (default: 0)")->type_name("S");
}

SamplePattern make_pattern(const OcclusionOptions& options) {
  const SamplePattern& pattern = SamplePattern::standard(options.ray_count);
  return options.falloff.name() == "constant" ? pattern : pattern.with_falloff(options.falloff);
}

void check_radius(const OcclusionOptions& options, bool is_drawn) {
  if (!options.radius || !std::isinf(*options.radius) || options.falloff.name() == "constant") return;
  const KernelChoice kernel = options.kernel.value_or(KernelChoice::simd);
  if (!is_drawn && kernel != KernelChoice::table && kernel != KernelChoice::nearest) return;
  throw std::invalid_argument(
      fmt::format("--radius inf with --falloff {} is not for {}, whose table needs rays of one length",
                  options.falloff.name(), is_drawn ? "--method raster" : fmt::format("--kernel {}", name_of(kernel))));
}

float radius_of(const OcclusionOptions& options) { return static_cast<float>(options.radius.value()); }

RayOptions ray_options(const OcclusionOptions& options) {
  return {.radius = radius_of(options), .sidedness = options.sidedness, .seed = options.seed};
}

PlaneMaskTable make_table(const OcclusionOptions& options, PlaneMasks masks) {
  PlaneMaskTableOptions table;
  table.masks = masks;
  return PlaneMaskTable(make_pattern(options), table);
}

AmbientOcclusion make_query(std::vector<OccluderLevel> levels, const OcclusionOptions& options) {
  const KernelChoice kernel = options.kernel.value_or(KernelChoice::simd);
  const RayOptions query = ray_options(options);
  const OccluderBvh& occluders = levels.front().occluders;
  if (kernel == KernelChoice::table) return {occluders, make_table(options, PlaneMasks::must_may), query};
  if (kernel == KernelChoice::nearest) return {occluders, make_table(options, PlaneMasks::nearest), query};
  return {std::move(levels), make_pattern(options), query,
          kernel == KernelChoice::scalar ? Kernel::scalar : Kernel::simd};
}

}  // namespace lkao::cli
