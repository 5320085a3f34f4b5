#include "lod/part_levels.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include <glm/geometric.hpp>

namespace lkao::lod {
namespace {

// A part is not simplified beyond this share of its size, nor of its width, however large epsilon is: small and thin
// things keep a shape, and so their occlusion. A ball keeps a dozen triangles, a straight wire its thickness.
constexpr double kMostOfSize = 1.0 / 8;
// What the decimater is told of epsilon, so that what it does not sample seldom lies beyond.
constexpr double kShareOfEpsilon = 0.9;
constexpr int kMostRedos = 8;
// Remembered of where is near to the part.
constexpr std::size_t kCellsPerTriangle = 4;

bool same_triangle(const glm::uvec3& a, const glm::uvec3& b) {
  return a == b || a == glm::uvec3(b.y, b.z, b.x) || a == glm::uvec3(b.z, b.x, b.y);
}

class Simplifier {
 public:
  Simplifier(const scene::Mesh& part, std::span<const PartGoal> goals, const PartDecimater::OnRemoved& on_removed)
      : part_(part), goals_(goals), on_removed_(on_removed), surface_(part) {
    const Bounds bounds = scene::bounds_of(part);
    lower_ = bounds.lower;
    const double size = glm::distance(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper));
    most_tolerance_ = kMostOfSize * std::min(size, area_of(part) / size);
  }

  PartResult run() {
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      const auto start = std::chrono::steady_clock::now();
      result_.levels.push_back(make_level(i));
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      result_.levels.back().seconds = seconds.count();
    }
    return std::move(result_);
  }

 private:
  double tolerance(std::size_t level) const {
    return std::min(kShareOfEpsilon * goals_[level].epsilon, most_tolerance_);
  }

  PartLevel make_level(std::size_t i) {
    if (i > 0 && tolerance(i) == tolerance(i - 1)) return result_.levels[i - 1];
    PartLevel before = i > 0 ? result_.levels[i - 1] : unsimplified(part_);
    before.redo_count = 0;
    before.fell_back = false;
    begin_with(before);
    PartLevel level;
    std::vector<std::uint8_t> locked;  // vertices; empty: none
    const NearCells original(surface_, tolerance(i), lower_, kCellsPerTriangle * part_.triangles.size());
    for (; level.redo_count <= kMostRedos; ++level.redo_count) {
      PartDecimater decimater(base_mesh_, on_removed_);
      if (i == 0) result_.refused_count = decimater.refused_count();
      decimater.decimate(original, before.from_original.maximum, locked);
      level.triangles = decimater.triangles();
      for (SimplifiedTriangle& triangle : level.triangles) triangle.origin = before.triangles[triangle.origin].origin;
      if (verify(goals_[i], level, locked)) return level;
    }
    before.redo_count = kMostRedos;
    before.fell_back = true;
    return before;
  }

  // From now on `base` is what is simplified further.
  void begin_with(const PartLevel& base) {
    base_mesh_ = mesh_of(base);
    base_surface_ = std::make_unique<Surface>(base_mesh_);
  }

  // Over all vertices of the part.
  scene::Mesh mesh_of(const PartLevel& level) const {
    scene::Mesh mesh{.positions = part_.positions, .triangles = {}};
    for (const SimplifiedTriangle& triangle : level.triangles) mesh.triangles.push_back(triangle.corners);
    return mesh;
  }

  // Measures both distances; true where they are within epsilon. Else adds to `locked` what keeps the offending places
  // as they are in the base.
  bool verify(const PartGoal& goal, PartLevel& level, std::vector<std::uint8_t>& locked) {
    std::vector<std::uint8_t> kept(part_.triangles.size(), 0);      // of the original: still there
    std::vector<std::uint8_t> kept_now(level.triangles.size(), 0);  // the same, of the simplified
    for (std::size_t t = 0; t < level.triangles.size(); ++t) {
      const SimplifiedTriangle& triangle = level.triangles[t];
      kept_now[t] = same_triangle(triangle.corners, part_.triangles[triangle.origin]);
      kept[triangle.origin] = kept_now[t];
    }
    const scene::Mesh simplified = mesh_of(level);
    const Surface surface(simplified);
    Sampling sampling = goal.sampling;
    const auto from_original = triangle_distances(part_, surface, sampling, kept);
    sampling.most_per_triangle *=
        static_cast<double>(part_.triangles.size()) / static_cast<double>(simplified.triangles.size());
    const auto to_original = triangle_distances(simplified, surface_, sampling, kept_now);
    level.from_original = sum(from_original);
    level.to_original = sum(to_original);
    if (level.from_original.maximum <= goal.epsilon && level.to_original.maximum <= goal.epsilon) return true;

    std::vector<std::uint8_t> is_corner(part_.positions.size(), 0);
    for (std::size_t t = 0; t < from_original.size(); ++t) {
      if (!(from_original[t].maximum > goal.epsilon)) continue;
      mark(is_corner, base_mesh_.triangles[base_surface_->nearest(middle_of(part_.triangles[t])).triangle]);
    }
    for (std::size_t t = 0; t < to_original.size(); ++t) {
      if (to_original[t].maximum > goal.epsilon) mark(is_corner, simplified.triangles[t]);
    }
    locked.resize(part_.positions.size(), 0);
    lock_around(is_corner, locked);
    return false;
  }

  glm::dvec3 middle_of(const glm::uvec3& triangle) const {
    const auto corner = [&](int i) { return glm::dvec3(part_.positions[triangle[i]]); };
    return (corner(0) + corner(1) + corner(2)) / 3.0;
  }

  static void mark(std::vector<std::uint8_t>& marks, const glm::uvec3& triangle) {
    for (int i = 0; i < 3; ++i) marks[triangle[i]] = 1;
  }

  // A triangle cannot change while its corners are locked, so none can come to these vertices but those there now.
  void lock_around(const std::vector<std::uint8_t>& is_corner, std::vector<std::uint8_t>& locked) const {
    for (const glm::uvec3& triangle : base_mesh_.triangles) {
      if (is_corner[triangle.x] || is_corner[triangle.y] || is_corner[triangle.z]) mark(locked, triangle);
    }
  }

  const scene::Mesh& part_;
  std::span<const PartGoal> goals_;
  const PartDecimater::OnRemoved& on_removed_;
  Surface surface_;      // of the part
  glm::dvec3 lower_{0};  // corner of its box
  double most_tolerance_ = 0;
  scene::Mesh base_mesh_;
  std::unique_ptr<Surface> base_surface_;
  PartResult result_;
};

}  // namespace

PartResult simplify_part(const scene::Mesh& part, std::span<const PartGoal> goals,
                         const PartDecimater::OnRemoved& on_removed) {
  return Simplifier(part, goals, on_removed).run();
}

PartLevel unsimplified(const scene::Mesh& part) {
  PartLevel level;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) level.triangles.push_back({part.triangles[t], t});
  level.from_original.area = level.to_original.area = area_of(part);
  return level;
}

}  // namespace lkao::lod
