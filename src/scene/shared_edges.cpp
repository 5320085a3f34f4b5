#include "scene/shared_edges.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <tuple>
#include <unordered_map>

#include "scene/facet.h"

namespace lkao::scene {

namespace {

constexpr std::size_t kMostPartners = 8;  // of one side of an edge: keeps the work in proportion to the mesh

using PositionKey = std::array<std::uint32_t, 3>;

struct PositionKeyHash {
  std::size_t operator()(const PositionKey& key) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t word : key) hash = (std::rotl(hash, 29) ^ word) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

// For each vertex the first one at the same position.
std::vector<std::uint32_t> first_vertices(const std::vector<glm::vec3>& positions) {
  std::unordered_map<PositionKey, std::uint32_t, PositionKeyHash> firsts;
  firsts.reserve(positions.size());
  std::vector<std::uint32_t> result(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const glm::vec3 p = positions[i] + 0.0f;  // -0 and +0 are one position
    const PositionKey key{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                          std::bit_cast<std::uint32_t>(p.z)};
    result[i] = firsts.emplace(key, i).first->second;
  }
  return result;
}

// An edge between two places; all its sides lie together once sorted, those that run upwards first.
struct Entry {
  std::uint32_t low, high;
  bool runs_down;
  EdgeSide side;

  auto key() const { return std::tuple(low, high, runs_down, side.triangle, side.from); }
  bool same_edge(const Entry& other) const { return low == other.low && high == other.high; }
};

std::vector<Entry> sorted_entries(const Mesh& mesh) {
  const std::vector<std::uint32_t> firsts = first_vertices(mesh.positions);
  std::vector<Entry> entries;
  entries.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!Facet(mesh, mesh.triangles[t]).is_usable()) continue;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const EdgeSide side{t, i};
      const std::uint32_t from = firsts[mesh.triangles[t][static_cast<int>(i)]];
      const std::uint32_t to = firsts[mesh.triangles[t][static_cast<int>(side.to())]];
      entries.push_back({std::min(from, to), std::max(from, to), from > to, side});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.key() < b.key(); });
  return entries;
}

}  // namespace

std::vector<SharedEdge> shared_edges(const Mesh& mesh) {
  const std::vector<Entry> entries = sorted_entries(mesh);
  std::vector<SharedEdge> edges;
  edges.reserve(entries.size() / 2);
  for (auto first = entries.begin(); first != entries.end();) {
    const auto end = std::find_if(first, entries.end(), [&](const Entry& e) { return !e.same_edge(*first); });
    const auto down = std::find_if(first, end, [](const Entry& e) { return e.runs_down; });
    for (auto up = first; up != down; ++up) {
      // Each begins with a partner of its own, so that a knot leaves none out.
      const auto count = static_cast<std::size_t>(end - down);
      const auto own = static_cast<std::size_t>(up - first);
      for (std::size_t i = 0; i < std::min(count, kMostPartners); ++i) {
        edges.push_back({{up->side, (down + static_cast<std::ptrdiff_t>((own + i) % count))->side}});
      }
    }
    first = end;
  }
  return edges;
}

}  // namespace lkao::scene
