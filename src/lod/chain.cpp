#include "lod/chain.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace lkao::lod {
namespace {

void require_positive(const char* name, float value) {
  if (value > 0 && std::isfinite(value)) return;
  throw std::invalid_argument(fmt::format("{}: expected a finite number above 0, got {}", name, value));
}

void check_shape(const LevelRule& rule) {
  require_positive("k", rule.k);
  if (!(rule.growth > 1) || !std::isfinite(rule.growth)) {
    throw std::invalid_argument(fmt::format("growth: expected a finite number above 1, got {}", rule.growth));
  }
  if (rule.level_count < 1 || rule.level_count > kMaxLevelCount) {
    throw std::invalid_argument(fmt::format("level_count: expected 1 to {}, got {}", kMaxLevelCount, rule.level_count));
  }
}

// epsilon_i / epsilon_1.
double growth_until(const LevelRule& rule, int level) { return std::pow(double{rule.growth}, level - 1); }

}  // namespace

Chain empty_chain(const LevelRule& rule) {
  check_shape(rule);
  Chain chain{.k = rule.k, .growth = rule.growth, .levels = {}};
  chain.levels.resize(static_cast<std::size_t>(rule.level_count));
  if (rule.level_count > 1) require_positive("epsilon", rule.epsilon);
  for (int i = 1; i < rule.level_count; ++i) {
    Level& level = chain.levels[static_cast<std::size_t>(i)];
    level.epsilon = static_cast<float>(double{rule.epsilon} * growth_until(rule, i));
    level.r_min = static_cast<float>(double{rule.k} * double{level.epsilon});
    chain.levels[static_cast<std::size_t>(i - 1)].r_max = level.r_min;
    if (!std::isfinite(level.r_min) || !(level.r_min > 0)) {
      throw std::invalid_argument(
          fmt::format("epsilon: level {} would begin at the distance {}, got {}", i, level.r_min, rule.epsilon));
    }
  }
  chain.levels.back().r_max = std::numeric_limits<float>::infinity();
  return chain;
}

float automatic_epsilon(float radius, const LevelRule& rule) {
  constexpr double kLastLevelBegins = 0.5;  // share of the radius
  check_shape(rule);
  require_positive("radius", radius);
  const double last_growth = rule.level_count > 1 ? growth_until(rule, rule.level_count - 1) : 1.0;
  return static_cast<float>(kLastLevelBegins * double{radius} / (double{rule.k} * last_growth));
}

float automatic_epsilon(const scene::Mesh& mesh, float radius, const LevelRule& rule) {
  if (!std::isinf(radius)) return automatic_epsilon(radius, rule);
  const Bounds bounds = scene::bounds_of(mesh);
  return automatic_epsilon(static_cast<float>(glm::distance(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper))), rule);
}

}  // namespace lkao::lod
