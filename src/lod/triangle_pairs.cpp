#include "lod/triangle_pairs.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_sort.h>
#include <glm/geometric.hpp>

namespace lkao::lod {
namespace {

// Beyond this many triangles on both sides, an edge is left as a border of all of them.
constexpr std::size_t kMostPairsTried = 4096;

struct EdgeUse {
  std::uint64_t vertices;  // the lower number in the upper half
  HalfEdge half_edge;
  bool forward;  // from the lower to the higher number

  bool operator<(const EdgeUse& other) const {
    return vertices != other.vertices ? vertices < other.vertices : half_edge < other.half_edge;
  }
};

std::vector<EdgeUse> sorted_edge_uses(std::span<const glm::uvec3> triangles) {
  std::vector<EdgeUse> uses(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = triangles[t][i], to = triangles[t][(i + 1) % 3];
      const std::uint64_t low = std::min(from, to), high = std::max(from, to);
      const std::size_t edge = 3 * t + static_cast<std::size_t>(i);
      uses[edge] = {low << 32 | high, static_cast<HalfEdge>(edge), from < to};
    }
  }
  tbb::parallel_sort(uses.begin(), uses.end());
  return uses;
}

class Pairing {
 public:
  Pairing(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles)
      : positions_(positions), triangles_(triangles) {
    pairs_.partner.assign(3 * triangles.size(), kNoHalfEdge);
  }

  TrianglePairs run() {
    const std::vector<EdgeUse> uses = sorted_edge_uses(triangles_);
    for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
      while (last < uses.size() && uses[last].vertices == uses[first].vertices) ++last;
      pair_edge(std::span(uses).subspan(first, last - first));
    }
    return std::move(pairs_);
  }

 private:
  void pair_edge(std::span<const EdgeUse> uses) {
    if (uses.size() == 1) return;  // the surface ends there
    if (uses.size() == 2 && uses[0].forward == uses[1].forward) {
      ++pairs_.wrong_winding_count;
    } else if (uses.size() == 2) {
      join(uses[0].half_edge, uses[1].half_edge);
    } else {
      ++pairs_.crowded_edge_count;
      pair_crowd(uses);
    }
  }

  void pair_crowd(std::span<const EdgeUse> uses) {
    struct Candidate {
      double cosine;
      HalfEdge forward, backward;
    };
    const auto forward_count = static_cast<std::size_t>(std::ranges::count(uses, true, &EdgeUse::forward));
    if (forward_count * (uses.size() - forward_count) > kMostPairsTried) return;
    std::vector<Candidate> candidates;
    for (const EdgeUse& a : uses) {
      for (const EdgeUse& b : uses) {
        if (!a.forward || b.forward) continue;
        const double cosine = glm::dot(normal_at(a.half_edge), normal_at(b.half_edge));
        candidates.push_back({cosine, a.half_edge, b.half_edge});
      }
    }
    std::ranges::stable_sort(candidates, std::greater(), &Candidate::cosine);
    for (const Candidate& candidate : candidates) {
      if (is_free(candidate.forward) && is_free(candidate.backward)) join(candidate.forward, candidate.backward);
    }
  }

  glm::dvec3 normal_at(HalfEdge edge) const {
    const glm::uvec3& triangle = triangles_[edge / 3];
    const glm::dvec3 a(positions_[triangle.x]), b(positions_[triangle.y]), c(positions_[triangle.z]);
    return glm::normalize(glm::cross(b - a, c - a));
  }

  bool is_free(HalfEdge edge) const { return pairs_.partner[edge] == kNoHalfEdge; }
  void join(HalfEdge a, HalfEdge b) {
    pairs_.partner[a] = b;
    pairs_.partner[b] = a;
  }

  std::span<const glm::vec3> positions_;
  std::span<const glm::uvec3> triangles_;
  TrianglePairs pairs_;
};

}  // namespace

TrianglePairs pair_triangles(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
  return Pairing(positions, triangles).run();
}

}  // namespace lkao::lod
