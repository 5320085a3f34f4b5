#include "cli/lod_option.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "cli/parse.h"
#include "lod/chain_file.h"
#include "lod/occluders.h"

namespace lkao::cli {
namespace {

void set_value(lod::LevelRule& rule, const std::string& key, const std::string& value) {
  if (key == "k") {
    rule.k = static_cast<float>(parse_positive_number(value));
  } else if (key == "levels") {
    rule.level_count = parse_integer(value, 1, lod::kMaxLevelCount);
  } else if (key == "epsilon") {
    rule.epsilon = static_cast<float>(parse_positive_number(value));
  } else if (key == "growth") {
    rule.growth = static_cast<float>(parse_positive_number(value));
    if (!(rule.growth > 1))
      throw std::invalid_argument(fmt::format("growth: expected a number above 1, got '{}'", value));
  } else {
    throw std::invalid_argument(fmt::format("expected k=, levels=, epsilon= or growth=, got '{}'", key));
  }
}

bool is_in_use(const lod::Level& level, const lod::Chain& chain, float radius) {
  const std::vector<lod::LevelInUse> in_use = lod::levels_in_use(chain, radius);
  return std::any_of(in_use.begin(), in_use.end(), [&](const auto& some) { return some.mesh == &level.mesh; });
}

}  // namespace

LodOption parse_lod(const std::string& text) {
  LodOption option;
  if (text.ends_with(".json")) {
    option.file = text;
    return option;
  }
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) {
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument(fmt::format("expected KEY=NUMBER,... or a file NAME.json, got '{}'", item));
    }
    set_value(option.rule, item.substr(0, equals), item.substr(equals + 1));
  }
  return option;
}

lod::Chain make_chain(const LodOption& option, const SceneInput& scene, float radius, ProgressBar& progress) {
  if (option.file.empty()) {
    lod::LevelRule rule = option.rule;
    if (rule.epsilon == 0) rule.epsilon = lod::automatic_epsilon(scene.mesh, radius, rule);
    return simplify_watched(scene.occluders(), rule, progress).chain;
  }
  progress.begin("loading " + option.file);
  lod::Chain chain = lod::load_chain(option.file, scene.mesh.origin);
  progress.clear();
  const scene::Mesh& original = chain.levels.front().mesh;
  if (original.positions != scene.mesh.positions || original.triangles != scene.mesh.triangles) {
    throw std::runtime_error(option.file + ": these are levels of another mesh than the scene's");
  }
  return chain;
}

lod::Simplified simplify_watched(const scene::Mesh& mesh, const lod::LevelRule& rule, ProgressBar& progress) {
  lod::Simplified simplified = lod::simplify(mesh, {.levels = rule}, progress.watch("simplifying"));
  progress.clear();
  return simplified;
}

void add_lod_row(Table& table, const lod::Chain& chain, float radius, double seconds) {
  std::string counts;
  for (const lod::Level& level : chain.levels) {
    counts += fmt::format("{}{}{}", counts.empty() ? "" : ", ", grouped(level.mesh.triangles.size()),
                          is_in_use(level, chain, radius) ? "" : " (not used)");
  }
  table.add("levels", fmt::format("{} triangles, from {:.3g} on simplified; {:.3f} s", counts,
                                  chain.levels.front().r_max, seconds));
}

Json lod_json(const lod::Chain& chain, float radius, double seconds) {
  Json levels = Json::array();
  for (const lod::Level& level : chain.levels) {
    levels.push_back({{"triangles", level.mesh.triangles.size()},
                      {"epsilon", level.epsilon},
                      {"r_min", level.r_min},
                      {"r_max", level.r_max},
                      {"in_use", is_in_use(level, chain, radius)}});
  }
  return {{"k", chain.k}, {"growth", chain.growth}, {"seconds", seconds}, {"levels", levels}};
}

}  // namespace lkao::cli
