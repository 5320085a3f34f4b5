#include "lod/spheres.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lod/nearest_point.h"
#include "lod/surface_samples.h"
#include "lod/triangle.h"
#include "lut/coordinates.h"
#include "lut/require.h"

namespace lkao::lod {
namespace {

// Of a sample, for clustering.
struct Place {
  glm::dvec3 point;
  double area;
};

// So many samples lie side by side in an average cluster.
constexpr double kSamplesPerSide = 2;
// Parts of fewer samples are not worth a thread.
constexpr std::size_t kSmallPart = 4096;

Triangle triangle_of(const glm::uvec3& corners, const PositionView& positions) {
  return {glm::dvec3(positions[corners.x]), glm::dvec3(positions[corners.y]), glm::dvec3(positions[corners.z])};
}

// 0 where it blocks nothing.
double usable_area(const Triangle& triangle) {
  for (const glm::dvec3& corner : {triangle.a, triangle.b, triangle.c}) {
    if (!lut::is_in_range(glm::vec3(corner))) return 0;
  }
  return area_of(triangle);
}

glm::dvec3 point_of(const Triangle& t, const glm::dvec2& corner) {
  return t.a + corner.x * (t.b - t.a) + corner.y * (t.c - t.a);
}

// The inverse of point_of().
glm::dvec2 corner_of(const Triangle& t, const glm::dvec3& point) {
  const glm::dvec3 u = t.b - t.a, v = t.c - t.a, off = point - t.a, normal = glm::cross(u, v);
  return glm::dvec2(glm::dot(glm::cross(off, v), normal), glm::dot(glm::cross(u, off), normal)) /
         glm::dot(normal, normal);
}

void add_samples(std::uint32_t index, const Triangle& triangle, double spacing, std::vector<SurfaceSample>& samples) {
  if (longest_side(triangle) <= spacing) {
    samples.push_back({index, 0, 1, glm::dvec2(1.0 / 3)});
    return;
  }
  const double area = area_of(triangle);
  sample_triangle(triangle, spacing, [&](const glm::dvec3& point, double part) {
    samples.push_back({index, 0, part / area, corner_of(triangle, point)});
    return true;
  });
}

std::vector<SurfaceSample> sample(const std::vector<glm::uvec3>& triangles, const PositionView& positions, int count) {
  double area = 0;
  for (const glm::uvec3& corners : triangles) area += usable_area(triangle_of(corners, positions));
  const double spacing = std::sqrt(area / count) / kSamplesPerSide;
  std::vector<SurfaceSample> samples;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle triangle = triangle_of(triangles[i], positions);
    if (usable_area(triangle) > 0) add_samples(i, triangle, spacing, samples);
  }
  return samples;
}

// Centres of parts of about the same area, each cut across its longest side: a start that covers the whole surface.
class FirstCentres {
 public:
  FirstCentres(std::span<const Place> places, std::size_t count) : places_(places), order_(places.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    centres_.resize(std::min(count, places.size()));
    if (!centres_.empty()) divide(order_, centres_);
  }
  std::vector<glm::dvec3> take() { return std::move(centres_); }

 private:
  void divide(std::span<std::uint32_t> part, std::span<glm::dvec3> centres) const {
    if (centres.size() == 1) {
      centres[0] = middle_of(part);
      return;
    }
    sort_along_longest_side(part);
    const std::size_t low_count = centres.size() / 2;
    const std::size_t cut = cut_of(part, low_count, centres.size());
    const auto low = [&] { divide(part.first(cut), centres.first(low_count)); };
    const auto high = [&] { divide(part.subspan(cut), centres.subspan(low_count)); };
    if (part.size() < kSmallPart) {
      low();
      high();
    } else {
      tbb::parallel_invoke(low, high);
    }
  }

  glm::dvec3 middle_of(std::span<const std::uint32_t> part) const {
    glm::dvec3 sum(0);
    double area = 0;
    for (const std::uint32_t i : part) {
      sum += places_[i].area * places_[i].point;
      area += places_[i].area;
    }
    return sum / area;
  }

  void sort_along_longest_side(std::span<std::uint32_t> part) const {
    glm::dvec3 lower(std::numeric_limits<double>::infinity()), upper = -lower;
    for (const std::uint32_t i : part) {
      lower = glm::min(lower, places_[i].point);
      upper = glm::max(upper, places_[i].point);
    }
    const glm::dvec3 size = upper - lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::sort(part.begin(), part.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(places_[a].point[axis], a) < std::pair(places_[b].point[axis], b);
    });
  }

  // Where the first samples have low_count of count shares of the area; each side keeps as many samples as centres.
  std::size_t cut_of(std::span<const std::uint32_t> part, std::size_t low_count, std::size_t count) const {
    double area = 0, below = 0;
    for (const std::uint32_t i : part) area += places_[i].area;
    const double wanted = area * static_cast<double>(low_count) / static_cast<double>(count);
    std::size_t cut = 0;
    while (cut < part.size() && below < wanted) below += places_[part[cut++]].area;
    return std::clamp(cut, low_count, part.size() - (count - low_count));
  }

  std::span<const Place> places_;
  std::vector<std::uint32_t> order_;
  std::vector<glm::dvec3> centres_;
};

// One round: the nearest centre of each sample. False where nothing has changed.
bool assign(std::span<const Place> places, std::span<const glm::dvec3> centres, std::span<SurfaceSample> samples) {
  const NearestPoint nearest(centres);
  std::vector<std::uint8_t> has_changed(samples.size());
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
    const std::uint32_t sphere = nearest.to(places[i].point);
    has_changed[i] = sphere != samples[i].sphere;
    samples[i].sphere = sphere;
  });
  return std::find(has_changed.begin(), has_changed.end(), 1) != has_changed.end();
}

// Centres move to the middle of their samples; those without any stay.
void move_centres(std::span<const Place> places, std::span<const SurfaceSample> samples,
                  std::span<glm::dvec3> centres) {
  std::vector<glm::dvec4> sums(centres.size(), glm::dvec4(0));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sums[samples[i].sphere] += places[i].area * glm::dvec4(places[i].point, 1);
  }
  for (std::size_t k = 0; k < centres.size(); ++k) {
    if (sums[k].w > 0) centres[k] = glm::dvec3(sums[k]) / sums[k].w;
  }
}

void cluster(std::span<const Place> places, const SphereOptions& options, std::span<SurfaceSample> samples) {
  std::vector<glm::dvec3> centres = FirstCentres(places, static_cast<std::size_t>(options.count)).take();
  if (centres.empty()) return;
  for (SurfaceSample& sample : samples) sample.sphere = static_cast<std::uint32_t>(centres.size());
  assign(places, centres, samples);
  for (int i = 0; i < options.iteration_count; ++i) {
    move_centres(places, samples, centres);
    if (!assign(places, centres, samples)) return;
  }
}

// Puts samples of a sphere side by side, and numbers spheres without gaps. The first of each, and one more.
std::vector<std::size_t> order_by_sphere(std::vector<SurfaceSample>& samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const SurfaceSample& a, const SurfaceSample& b) { return a.sphere < b.sphere; });
  std::vector<std::size_t> first;
  std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].sphere != last) first.push_back(i);
    last = samples[i].sphere;
    samples[i].sphere = static_cast<std::uint32_t>(first.size() - 1);
  }
  first.push_back(samples.size());
  return first;
}

void check(const TriangleMesh& mesh, const SphereOptions& options) {
  lut::require(options.count >= 1, "count", "at least 1", options.count);
  lut::require(options.iteration_count >= 0, "iteration_count", "at least 0", options.iteration_count);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 corners = mesh.triangles[i];
    for (const std::uint32_t corner : {corners.x, corners.y, corners.z}) {
      if (corner < mesh.positions.size()) continue;
      throw std::invalid_argument(
          fmt::format("triangle {} has index {}, but there are {} positions", i, corner, mesh.positions.size()));
    }
  }
}

}  // namespace

MeshSpheres::MeshSpheres(const TriangleMesh& mesh, const SphereOptions& options)
    : position_count_(mesh.positions.size()) {
  check(mesh, options);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) triangles_.push_back(mesh.triangles[i]);
  samples_ = sample(triangles_, mesh.positions, options.count);
  std::vector<Place> places;
  for (const SurfaceSample& sample : samples_) {
    const Triangle triangle = triangle_of(triangles_[sample.triangle], mesh.positions);
    places.push_back({point_of(triangle, sample.corner), sample.share * area_of(triangle)});
  }
  cluster(places, options, samples_);
  first_ = order_by_sphere(samples_);
}

std::vector<glm::vec4> MeshSpheres::at(const PositionView& positions) const {
  if (positions.size() != position_count_) {
    throw std::invalid_argument(
        fmt::format("positions must be {}, as the mesh had, not {}", position_count_, positions.size()));
  }
  std::vector<glm::vec4> spheres(count(), glm::vec4(0));
  tbb::parallel_for(std::size_t{0}, count(), [&](std::size_t k) {
    glm::dvec4 sum(0);
    for (std::size_t i = first_[k]; i < first_[k + 1]; ++i) {
      const Triangle triangle = triangle_of(triangles_[samples_[i].triangle], positions);
      const double area = samples_[i].share * usable_area(triangle);
      if (area > 0) sum += area * glm::dvec4(point_of(triangle, samples_[i].corner), 1);
    }
    if (sum.w > 0) spheres[k] = glm::vec4(glm::dvec3(sum) / sum.w, std::sqrt(sum.w / (4 * std::numbers::pi)));
  });
  return spheres;
}

}  // namespace lkao::lod
