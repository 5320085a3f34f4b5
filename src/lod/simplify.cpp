#include "lod/simplify.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "lod/part_levels.h"
#include "lod/parts.h"
#include "lod/surface_samples.h"
#include "lut/mesh_views.h"
#include "lut/progress_sum.h"

namespace lkao::lod {
namespace {

// How many samples may verify a level, about; triangles too large for the spacing get this many at least.
constexpr double kSampleBudget = 2e6;
constexpr double kLeastSamplesOfLarge = 16;

void check_mesh(const scene::Mesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("mesh: there are no triangles in it");
  lut::check_indices(mesh.triangles, mesh.positions.size());
}

class Simplification {
 public:
  Simplification(const scene::Mesh& mesh, const SimplifyOptions& options)
      : options_(options), scene_(split_into_parts(mesh)), results_(scene_.parts.size()) {
    result_.chain = empty_chain(options.levels);
    result_.report.levels.resize(result_.chain.levels.size());
    result_.chain.levels[0].mesh = mesh;
    count_parts(mesh);
    set_goals(mesh);
  }

  Simplified run(const Progress& progress) {
    simplify_parts(progress);
    for (std::size_t i = 0; i < goals_.size(); ++i) gather_level(i);
    for (const PartResult& part : results_) result_.report.refused_count += part.refused_count;
    return std::move(result_);
  }

 private:
  bool is_small(const Part& part) const { return part.mesh.triangles.size() < options_.min_part_triangle_count; }

  void count_parts(const scene::Mesh& mesh) {
    SimplifyReport& report = result_.report;
    report.triangle_count = mesh.triangles.size();
    report.zero_area_count = scene_.zero_area_count;
    report.non_finite_count = scene_.non_finite_count;
    report.duplicate_count = scene_.duplicate_count;
    report.wrong_winding_edge_count = scene_.wrong_winding_edge_count;
    report.crowded_edge_count = scene_.crowded_edge_count;
    report.split_vertex_count = scene_.split_vertex_count;
    for (const Part& part : scene_.parts) {
      ++(is_small(part) ? report.small_part_count : report.simplified_part_count);
      (is_small(part) ? report.small_part_triangle_count : report.simplified_part_triangle_count) +=
          part.mesh.triangles.size();
    }
  }

  void set_goals(const scene::Mesh& mesh) {
    LevelReport& original = result_.report.levels[0];
    original.triangle_count = mesh.triangles.size();
    for (const Part& part : scene_.parts) original.area += area_of(part.mesh);
    const double most_per_triangle =
        std::max(kLeastSamplesOfLarge, kSampleBudget / static_cast<double>(mesh.triangles.size()));
    for (std::size_t i = 1; i < result_.chain.levels.size(); ++i) {
      const double epsilon = result_.chain.levels[i].epsilon;
      goals_.push_back({epsilon, {.spacing = epsilon / 2, .most_per_triangle = most_per_triangle}});
      result_.report.levels[i].spacing = goals_.back().sampling.spacing;
    }
  }

  // The largest parts first, so that none of them is left over at the end.
  void simplify_parts(const Progress& progress) {
    std::vector<std::uint32_t> order(scene_.parts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::greater(),
                             [&](std::uint32_t part) { return scene_.parts[part].mesh.triangles.size(); });
    lut::ProgressSum sum(progress, result_.report.simplified_part_triangle_count);
    tbb::parallel_for(
        std::size_t{0}, order.size(), [&](std::size_t i) { simplify_part_at(order[i], sum); },
        tbb::simple_partitioner());
  }

  void simplify_part_at(std::uint32_t number, lut::ProgressSum& sum) {
    const Part& part = scene_.parts[number];
    if (goals_.empty()) return;
    if (is_small(part)) {
      results_[number].levels.assign(goals_.size(), unsimplified(part.mesh));
      return;
    }
    std::size_t left = part.mesh.triangles.size();
    const PartDecimater::OnRemoved on_removed = [&](std::size_t count) {
      sum.add(std::min(count, left));
      left -= std::min(count, left);
    };
    results_[number] = simplify_part(part.mesh, goals_, on_removed);
    sum.add(left);
  }

  // The parts in their order, over the vertices that are left, each once.
  void gather_level(std::size_t goal) {
    constexpr std::uint32_t kNoNumber = 0xffffffffu;
    scene::Mesh& mesh = result_.chain.levels[goal + 1].mesh;
    mesh.origin = result_.chain.levels[0].mesh.origin;
    LevelReport& report = result_.report.levels[goal + 1];
    std::vector<std::uint32_t> number(scene_.positions.size(), kNoNumber);
    for (std::size_t p = 0; p < results_.size(); ++p) {
      const PartLevel& level = results_[p].levels[goal];
      for (const SimplifiedTriangle& triangle : level.triangles) {
        glm::uvec3 corners{};
        for (int i = 0; i < 3; ++i) {
          const std::uint32_t vertex = scene_.parts[p].scene_vertices[triangle.corners[i]];
          if (number[vertex] == kNoNumber) {
            number[vertex] = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(scene_.positions[vertex]);
          }
          corners[i] = number[vertex];
        }
        mesh.triangles.push_back(corners);
      }
      report.from_original.add(level.from_original);
      report.to_original.add(level.to_original);
      report.redone_part_count += level.redo_count > 0;
      report.fallen_back_part_count += level.fell_back;
      report.thread_seconds += level.seconds;
    }
    report.triangle_count = mesh.triangles.size();
    report.area = report.to_original.area;
  }

  const SimplifyOptions& options_;
  SceneParts scene_;
  std::vector<PartResult> results_;
  std::vector<PartGoal> goals_;
  Simplified result_;
};

}  // namespace

Simplified simplify(const scene::Mesh& mesh, const SimplifyOptions& options, const Progress& progress) {
  check_mesh(mesh);
  return Simplification(mesh, options).run(progress);
}

}  // namespace lkao::lod
