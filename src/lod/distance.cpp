#include "lod/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lod/surface_samples.h"
#include "scene/embree.h"

namespace lkao::lod {
namespace {

using scene::embree::Device;
using scene::embree::Geometry;
using scene::embree::Scene;

// One for all surfaces: there are thousands of small ones, and a device is expensive.
RTCDevice shared_device() {
  static const Device kDevice(rtcNewDevice(nullptr));
  if (!kDevice) throw std::runtime_error("Embree gives no device");
  return kDevice.get();
}

void check(const char* step) {
  const RTCError error = rtcGetDeviceError(shared_device());
  if (error != RTC_ERROR_NONE) throw std::runtime_error(fmt::format("Embree, {}: error {}", step, int{error}));
}

Triangle triangle_at(const scene::Mesh& mesh, std::uint32_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

// What Embree gets: boxes around the triangles. Long needles are cut across into several, since a box around a whole
// one holds everything nearby.
struct Boxes {
  std::vector<RTCBounds> bounds;
  std::vector<std::uint32_t> triangle;  // of each box
};

RTCBounds bounds_of(std::span<const glm::dvec3> points) {
  glm::dvec3 lower = points[0], upper = points[0];
  for (const glm::dvec3& p : points) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  const glm::vec3 l(lower), u(upper);  // rounding is within the margin of the search
  return {l.x, l.y, l.z, 0, u.x, u.y, u.z, 0};
}

void add_boxes(Boxes& boxes, const Triangle& triangle, std::uint32_t number) {
  constexpr double kMostBoxes = 32;
  const Triangle t = longest_side_first(triangle);
  const glm::dvec3 side = t.b - t.a;
  const double squared_side = glm::dot(side, side);
  const double aspect = squared_side / (2 * area_of(t));
  const int count = static_cast<int>(std::clamp(aspect / 4, 1.0, kMostBoxes));
  const double foot = glm::dot(t.c - t.a, side) / squared_side;  // of the height over the longest side
  const auto top = [&](double x) {
    return x < foot ? glm::mix(t.a, t.c, x / foot) : glm::mix(t.c, t.b, foot < 1 ? (x - foot) / (1 - foot) : 1.0);
  };
  for (int i = 0; i < count; ++i) {
    const double begin = static_cast<double>(i) / count, end = static_cast<double>(i + 1) / count;
    const glm::dvec3 tip = top(glm::clamp(foot, begin, end));
    const glm::dvec3 corners[] = {t.a + begin * side, t.a + end * side, top(begin), top(end), tip};
    boxes.bounds.push_back(bounds_of(corners));
    boxes.triangle.push_back(number);
  }
}

void give_bounds(const RTCBoundsFunctionArguments* arguments) {
  *arguments->bounds_o = static_cast<const Boxes*>(arguments->geometryUserPtr)->bounds[arguments->primID];
}

struct Search {
  const scene::Mesh& mesh;
  std::span<const std::uint32_t> triangle_of_box;
  glm::dvec3 point;
  float margin;                                           // more than what rounding can hide from Embree's boxes
  double best = std::numeric_limits<double>::infinity();  // squared
  std::uint32_t triangle = 0;
  bool found = false;
};

// What both kinds of search hand to Embree.
void run_query(RTCScene scene, Search& search, float radius, RTCPointQueryFunction visit) {
  const glm::vec3 rounded(search.point);
  RTCPointQuery query{};
  query.x = rounded.x;
  query.y = rounded.y;
  query.z = rounded.z;
  query.radius = radius;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene, &query, &context, visit, &search);
}

bool visit_until_near(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  if (arguments->query->radius == 0) return false;
  const std::uint32_t number = search.triangle_of_box[arguments->primID];
  const Triangle triangle = triangle_at(search.mesh, number);
  if (!(squared_distance(search.point, triangle) <= search.best)) return false;
  search.found = true;
  arguments->query->radius = 0;
  return true;
}

bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  const std::uint32_t number = search.triangle_of_box[arguments->primID];
  const Triangle triangle = triangle_at(search.mesh, number);
  const double squared = squared_distance(search.point, triangle);
  if (!(squared < search.best)) return false;
  search.best = squared;
  search.triangle = number;
  const float radius = static_cast<float>(std::sqrt(squared)) * 1.000001f + search.margin;
  if (!(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

}  // namespace

struct Surface::Data {
  scene::Mesh mesh;
  Boxes boxes;
  Scene scene;

  Search search(const glm::dvec3& point) const {
    const double largest = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    return {
        .mesh = mesh, .triangle_of_box = boxes.triangle, .point = point, .margin = static_cast<float>(largest * 4e-7)};
  }
};

Surface::Surface(const scene::Mesh& mesh) : data_(std::make_unique<Data>()) {
  data_->mesh = mesh;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    add_boxes(data_->boxes, triangle_at(mesh, t), t);
  }
  const RTCDevice device = shared_device();
  const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  check("new geometry");
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(data_->boxes.bounds.size()));
  rtcSetGeometryUserData(geometry.get(), &data_->boxes);
  rtcSetGeometryBoundsFunction(geometry.get(), give_bounds, nullptr);
  rtcCommitGeometry(geometry.get());
  data_->scene.reset(rtcNewScene(device));
  check("new scene");
  rtcSetSceneFlags(data_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(data_->scene.get(), geometry.get());
  // Isolated: while it waits for the build, this thread must not begin another part.
  tbb::this_task_arena::isolate([this] { rtcCommitScene(data_->scene.get()); });
  check("scene build");
}

Surface::~Surface() = default;
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;

Surface::Nearest Surface::nearest(const glm::dvec3& point, double limit) const {
  Search search = data_->search(point);
  run_query(data_->scene.get(), search, static_cast<float>(limit) * 1.000001f + search.margin, visit_triangle);
  return {std::sqrt(search.best), search.triangle};
}

Surface::Nearest Surface::nearest_from(const glm::dvec3& point, std::uint32_t guess) const {
  Search search = data_->search(point);
  search.best = squared_distance(point, triangle_at(search.mesh, guess));
  search.triangle = guess;
  const float radius = static_cast<float>(std::sqrt(search.best)) * 1.000001f + search.margin;
  run_query(data_->scene.get(), search, radius, visit_triangle);
  return {std::sqrt(search.best), search.triangle};
}

bool Surface::is_within(const glm::dvec3& point, double distance) const {
  Search search = data_->search(point);
  search.best = distance * distance;
  run_query(data_->scene.get(), search, static_cast<float>(distance) * 1.000001f + search.margin, visit_until_near);
  return search.found;
}

double Distance::rms() const { return area > 0 ? std::sqrt(squared_sum / area) : 0; }

void Distance::add(const Distance& part) {
  maximum = std::max(maximum, part.maximum);
  bound = std::max(bound, part.bound);
  squared_sum += part.squared_sum;
  area += part.area;
  sample_count += part.sample_count;
}

std::vector<Distance> triangle_distances(const scene::Mesh& from, const Surface& to, const Sampling& sampling,
                                         std::span<const std::uint8_t> coincident) {
  // Each vertex is looked at once, with the first triangle that needs it.
  constexpr std::uint32_t kNobody = 0xffffffffu;
  std::vector<std::uint32_t> owner(from.positions.size(), kNobody);
  for (std::uint32_t t = 0; t < from.triangles.size(); ++t) {
    if (!coincident.empty() && coincident[t] != 0) continue;
    for (int i = 0; i < 3; ++i) {
      if (owner[from.triangles[t][i]] == kNobody) owner[from.triangles[t][i]] = t;
    }
  }
  std::vector<Distance> distances(from.triangles.size());
  // `guess`: the nearest triangle of the sample before is often near to the next one.
  const auto measure = [&](std::uint32_t t, std::uint32_t& guess) {
    const Triangle triangle = triangle_at(from, t);
    Distance& distance = distances[t];
    distance.area = area_of(triangle);
    if (!coincident.empty() && coincident[t] != 0) return;
    const auto take = [&](const glm::dvec3& point, double area) {
      const Surface::Nearest nearest = guess == kNobody ? to.nearest(point) : to.nearest_from(point, guess);
      const double length = nearest.distance;
      guess = nearest.triangle;
      distance.maximum = std::max(distance.maximum, length);
      distance.squared_sum += area * length * length;
      ++distance.sample_count;
      return true;
    };
    const double spacing = spacing_for(triangle, sampling);
    sample_triangle(triangle, spacing, take);
    // Every point of the triangle is this near to one of its samples.
    const double reach = std::min(kCoverPerSpacing * spacing, longest_side(triangle));
    distance.bound = distance.maximum + reach;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t vertex = from.triangles[t][i];
      if (owner[vertex] == t) take(glm::dvec3(from.positions[vertex]), 0);
    }
  };
  using Range = tbb::blocked_range<std::uint32_t>;
  const auto measure_range = [&](const Range& range) {
    std::uint32_t guess = kNobody;
    for (std::uint32_t t = range.begin(); t < range.end(); ++t) measure(t, guess);
  };
  const Range all(0, static_cast<std::uint32_t>(from.triangles.size()), 64);
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(all, measure_range); });
  return distances;
}

Distance sum(std::span<const Distance> distances) {
  Distance total;
  for (const Distance& distance : distances) total.add(distance);
  return total;
}

double area_of(const scene::Mesh& mesh) {
  double area = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) area += area_of(triangle_at(mesh, t));
  return area;
}

}  // namespace lkao::lod
