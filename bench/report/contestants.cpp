#include "bench/report/contestants.h"

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace lkao::bench {
namespace {

using scene::embree::Order;

Contestant query(int ray_count, bool is_quick) {
  return {.name = fmt::format("query, {} rays", ray_count),
          .family = Family::query,
          .method = "bvh",
          .ray_count = ray_count,
          .is_quick = is_quick};
}

Contestant pattern(PatternKind kind, int ray_count, bool is_quick) {
  return {.name = fmt::format("query, {} rays, {}", ray_count, pattern_kind_name(kind)),
          .family = Family::patterns,
          .method = "bvh",
          .ray_count = ray_count,
          .pattern = kind,
          .is_quick = is_quick};
}

Contestant table(const char* kernel, int resolution, int ray_count, bool is_quick) {
  return {.name = fmt::format("table {}, {}^3, {} rays", std::string_view(kernel) == "table" ? "exact" : kernel,
                              resolution, ray_count),
          .family = Family::tables,
          .method = "bvh",
          .settings = {{"kernel", kernel}},
          .ray_count = ray_count,
          .table_resolution = resolution,
          .is_quick = is_quick};
}

Contestant levels(const char* method, float k, float epsilon_share, bool is_quick) {
  return {.name = fmt::format("{}, levels k {:g}, epsilon x {:.3g}", method, k, epsilon_share),
          .family = Family::levels,
          .method = method,
          .levels = ReportLevels{k, epsilon_share},
          .is_quick = is_quick};
}

Contestant embree(const char* mode, int ray_count, bool is_quick) {
  return {.name = fmt::format("{}, {} rays", mode, ray_count),
          .family = Family::embree,
          .method = "embree",
          .ray_count = ray_count,
          .is_quick = is_quick};
}

Contestant drawn(Family family, const char* method, const std::string& what, ChangedSettings settings, bool is_quick) {
  return {.name = what.empty() ? method : fmt::format("{}, {}", method, what),
          .family = family,
          .method = method,
          .settings = std::move(settings),
          .is_quick = is_quick};
}

void add_rays(std::vector<Contestant>& all) {
  for (const int ray_count : {16, 32, 64, 128, 256, 512, 1024}) {
    const bool is_quick = ray_count != 32 && ray_count != 512;
    all.push_back(query(ray_count, is_quick));
    all.push_back(embree("rtcOccluded1", ray_count, is_quick));
    all.back().embree = EmbreeMode{1, Order::coherent};
    all.push_back(embree("Embree's best mode", ray_count, is_quick));
    all.back().is_best_embree = true;
  }
  for (const int ray_count : {64, 256}) {
    for (const PatternKind kind : {PatternKind::random, PatternKind::sobol, PatternKind::fibonacci}) {
      all.push_back(pattern(kind, ray_count, ray_count == 64 && kind != PatternKind::fibonacci));
    }
  }
  all.push_back(table("table", 64, 128, false));
  for (const int resolution : {32, 64, 128}) all.push_back(table("nearest", resolution, 128, resolution == 64));
  for (const float k : {1.5f, 3.0f}) all.push_back(levels("bvh", k, 1, k == 3));
}

void add_screen(std::vector<Contestant>& all, Family family, const char* method,
                OwnFalloff falloff = OwnFalloff::constant) {
  const std::size_t first = all.size();
  all.push_back(drawn(family, method, "", {}, true));
  all.push_back(drawn(family, method, "no filter", {{"filter", "0"}}, true));
  all.push_back(drawn(family, method, "converged", {{"converged", "on"}}, true));
  all.push_back(drawn(family, method, "half resolution", {{"step", "2"}}, false));
  all.push_back(drawn(family, method, "guard band", {{"guard-band", "64"}}, false));
  for (std::size_t i = first; i < all.size(); ++i) all[i].falloff = falloff;
}

// Table 1 of Alchemy: its times are those of obscurance and filter, one by one.
void add_alchemy_settings(std::vector<Contestant>& all) {
  for (const AlchemyColumn& column : kAlchemyColumns) {
    for (const bool is_filtered : {false, true}) {
      const ChangedSettings settings = {{"alchemy-samples", std::to_string(column.samples)},
                                        {"alchemy-bands", std::to_string(column.bands)},
                                        {"filter", std::to_string(is_filtered ? column.filter_width / 2 : 0)}};
      all.push_back(drawn(Family::alchemy, "alchemy", column.name(is_filtered), settings, false));
      all.back().falloff = OwnFalloff::alchemy;
      all.back().is_for_paper = true;
    }
  }
}

// Table 1 of VAO++.
void add_vao_optimisations(std::vector<Contestant>& all) {
  const std::pair<const char*, ChangedSettings> kinds[] = {
      {"plain", {{"vao-fewest-width", "0"}, {"vao-culling", "off"}}},
      {"adaptive", {{"vao-culling", "off"}}},
      {"culled", {{"vao-fewest-width", "0"}}},
      {"both", {}}};
  for (const int samples : {2, 4, 8, 16, 32}) {
    for (const auto& [what, settings] : kinds) {
      ChangedSettings changed = settings;
      changed.emplace_back("vao-samples", std::to_string(samples));
      changed.emplace_back("filter", "0");
      all.push_back(drawn(Family::vao, "vao", fmt::format("{} samples, {}", samples, what), changed, false));
      all.back().falloff = OwnFalloff::ball;
      all.back().is_for_paper = true;
    }
  }
}

void add_drawn(std::vector<Contestant>& all) {
  all.push_back(drawn(Family::raster, "raster", "nearest", {{"masks", "nearest"}}, true));
  all.push_back(drawn(Family::raster, "raster", "exact", {{"masks", "exact"}}, false));
  for (const float k : {1.5f, 3.0f}) all.push_back(levels("raster", k, 1, k == 3));
  for (const char* delta : {"0.4", "0.6", "1"}) {
    Contestant volumes =
        drawn(Family::volumes, "volumes", fmt::format("delta {}", delta), {{"delta", delta}}, *delta == '0');
    volumes.falloff = OwnFalloff::linear;
    all.push_back(volumes);
  }
  all.push_back(drawn(Family::splats, "splat", "both halves", {}, true));
  all.push_back(drawn(Family::splats, "splat", "far half", {{"halves", "far"}}, false));
  add_screen(all, Family::alchemy, "alchemy", OwnFalloff::alchemy);
  add_alchemy_settings(all);
  add_screen(all, Family::vao, "vao", OwnFalloff::ball);
  add_vao_optimisations(all);
  add_screen(all, Family::gtao, "gtao");
  add_screen(all, Family::vbao, "vbao");
  all.push_back(drawn(Family::vbao, "vbao", "linear falloff", {}, false));
  all.back().falloff = OwnFalloff::linear;
}

}  // namespace

std::string AlchemyColumn::name(bool is_filtered) const {
  return fmt::format("{} x {} samples, {}", samples, bands,
                     is_filtered ? fmt::format("filter of {}", filter_width) : "no filter");
}

std::vector<Contestant> all_contestants(bool has_gl) {
  std::vector<Contestant> all;
  add_rays(all);
  if (has_gl) add_drawn(all);
  return all;
}

std::string Contestant::command(const std::string& scene, float radius) const {
  // What the program has no option for.
  if (is_embree_mode() || pattern != PatternKind::lloyd || table_resolution != 0) return {};
  std::string text =
      fmt::format("lkao render {} --radius {:g} --method {} --samples {}", scene, radius, method, ray_count);
  for (const auto& [option, value] : settings) text += fmt::format(" --{} {}", option, value);
  if (falloff == OwnFalloff::linear) text += " --falloff linear";
  if (levels) text += fmt::format(" --lod k={:g}", levels->k);
  return text + " -o ao.exr";
}

}  // namespace lkao::bench
