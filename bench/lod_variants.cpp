#include "bench/lod_variants.h"

#include <limits>

#include "lod/occluders.h"
#include "lod/simplify.h"

namespace lkao::bench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Without the first `skipped` simplified levels, and ranges for another k.
LodVariant variant_of(const lod::Chain& chain, std::size_t skipped, float k) {
  const auto first = chain.levels.begin() + 1 + static_cast<std::ptrdiff_t>(skipped);
  const int level_count = 1 + static_cast<int>(chain.levels.end() - first);
  LodVariant variant{k, first->epsilon, lod::empty_chain({first->epsilon, k, chain.growth, level_count})};
  variant.chain.levels[0].mesh = chain.levels[0].mesh;
  for (std::size_t i = 1; i < variant.chain.levels.size(); ++i) {
    variant.chain.levels[i].mesh = chain.levels[i + skipped].mesh;
  }
  return variant;
}

}  // namespace

std::vector<LodVariant> make_lod_variants(const scene::Mesh& mesh, float radius, int level_count,
                                          const std::vector<float>& ks) {
  // A third of the automatic epsilon, and one level more: the chain without its first level is the automatic one.
  lod::LevelRule rule{.epsilon = 0, .level_count = level_count};
  rule.epsilon = lod::automatic_epsilon(radius, rule) / rule.growth;
  ++rule.level_count;
  const lod::Chain chain = lod::simplify(mesh, {.levels = rule}).chain;
  std::vector<LodVariant> variants;
  variants.push_back({0, 0, {.k = 0, .growth = 0, .levels = {{mesh, 0, 0, kInfinity}}}});
  for (const std::size_t skipped : {std::size_t{0}, std::size_t{1}}) {
    for (const float k : ks) variants.push_back(variant_of(chain, skipped, k));
  }
  return variants;
}

std::size_t triangle_count(const LodVariant& variant, float radius) {
  std::size_t count = 0;
  for (const lod::LevelInUse& level : lod::levels_in_use(variant.chain, radius)) {
    count += level.mesh->triangles.size();
  }
  return count;
}

}  // namespace lkao::bench
