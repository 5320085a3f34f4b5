// Closed scans and parts do not leak: from inside, each ray is blocked: 1e8 rays with a radius beyond the mesh, and
// 5e7 without end; with the environment variable LKAO_LEAK_RAYS so many without end, which takes its time, and with how
// many of the others leak from Embree, which is no matter of this test.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "hard_case.h"
#include "oracle.h"
#include "reference/embree_reference.h"
#include "shared_mesh.h"

namespace lkao::tests {
namespace {

constexpr int kRayCount = 1024;

struct ClosedMesh {
  const char* file;
  int placement_count;  // the first as in the file, the others turned at random
  int point_count;      // inside, for each placement
  int normal_count;     // random ones, for each point
};

// As many points as finding them affords.
constexpr ClosedMesh kMeshes[] = {
    {"armadillo.ply", 3, 300, 32},
    {"dragon.ply", 2, 150, 128},
    {"pathological/thingi_1514499.ply", 2, 100, 32},
    {"pathological/thingi_73416.ply", 2, 100, 32},
    {"pathological/thingi_79741.ply", 2, 100, 32},
    {"pathological/generic_twin_7081.ply", 2, 100, 32},
    {"pathological/offset1.ply", 2, 100, 32},
    {"pathological/self_intersect_a.ply", 2, 100, 32},
    {"pathological/adis16480_cad.ply", 2, 100, 32},
    {"pathological/boeing.ply", 2, 100, 32},
};

// True where every edge, after joining equal positions, belongs to an even number of triangles: then a ray that leaves
// a point with an odd number of crossings must have left a closed surface around it, however many there are.
bool is_closed(const Mesh& mesh) {
  using Point = std::array<float, 3>;
  std::map<Point, unsigned> numbers;
  std::vector<unsigned> joined;
  for (const glm::vec3& p : mesh.positions) {
    joined.push_back(numbers.try_emplace({p.x, p.y, p.z}, static_cast<unsigned>(numbers.size())).first->second);
  }
  std::vector<std::pair<unsigned, unsigned>> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const auto [from, to] = std::minmax(joined[t[i]], joined[t[(i + 1) % 3]]);
      if (from != to) edges.emplace_back(from, to);
    }
  }
  std::sort(edges.begin(), edges.end());
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    if ((next - edge) % 2 != 0) return false;
    edge = next;
  }
  return true;
}

// By the number of crossings of one ray, exactly. False too where the ray touches an edge.
bool is_inside(const Oracle& oracle, const glm::vec3& point, const glm::vec3& ray) {
  ReceiverRays rays;
  rays.origin = point;
  rays.x[0] = ray.x, rays.y[0] = ray.y, rays.z[0] = ray.z;
  const int count = oracle.crossing_count(rays, 0);
  return count > 0 && count % 2 != 0;
}

// Behind random faces, from next to them to deep inside.
std::vector<glm::vec3> points_inside(const Mesh& mesh, int count, lut::RandomStream& random) {
  const Oracle oracle(mesh.view(), Sidedness::two_sided);
  const float size = mesh_size(mesh);
  std::vector<glm::vec3> points;
  for (int i = 0; i < 30 * count && static_cast<int>(points.size()) < count; ++i) {
    const glm::uvec3& t = mesh.triangles[random.next_below(mesh.triangles.size())];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    if (normal == glm::dvec3(0)) continue;
    const double u = random.next_double(), v = (1 - u) * random.next_double();
    const double depth = static_cast<double>(size) * std::pow(10.0, -7.0 + 6.0 * random.next_double());
    const glm::vec3 point = a + u * (b - a) + v * (c - a) - depth * glm::normalize(normal);
    if (is_inside(oracle, point, 2 * size * random_direction(random))) points.push_back(point);
  }
  return points;
}

std::vector<Receiver> receivers_at(const std::vector<glm::vec3>& points, int normal_count, lut::RandomStream& random) {
  std::vector<Receiver> receivers;
  for (const glm::vec3& point : points) {
    for (int i = 0; i < normal_count; ++i) receivers.push_back({.position = point, .normal = random_direction(random)});
  }
  return receivers;
}

const char* wanted_endless_ray_count() { return std::getenv("LKAO_LEAK_RAYS"); }

// Without end, in all.
std::uint64_t endless_ray_count() {
  const char* const wanted = wanted_endless_ray_count();
  return wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 50'000'000;
}

std::uint64_t leak_count(const QueryReport& report) { return report.ray_count - report.blocked_ray_count; }

// At least as many rays as asked for: so many receivers at a time that memory stays small.
QueryReport query_endless(const OccluderBvh& occluders, const std::vector<glm::vec3>& points, std::uint64_t ray_count,
                          lut::RandomStream& random) {
  const AmbientOcclusion ao(occluders, SamplePattern::standard(kRayCount),
                            {.radius = std::numeric_limits<float>::infinity(), .surface_offset = 0});
  QueryReport sum;
  while (!points.empty() && sum.ray_count < ray_count) {
    const std::uint64_t rest = (ray_count - sum.ray_count) / (points.size() * kRayCount) + 1;
    const std::vector<Receiver> receivers =
        receivers_at(points, static_cast<int>(std::min<std::uint64_t>(rest, 64)), random);
    sum += ao.query(receivers, {}, sum.receiver_count);
  }
  return sum;
}

struct RayCounts {
  std::uint64_t bounded = 0, endless = 0;
};

// Prints the row of one placement and returns its rays, of which `endless_count` or more have no end.
RayCounts expect_no_leak(const ClosedMesh& closed, const Mesh& mesh, int placement, std::uint64_t endless_count,
                         lut::RandomStream& random) {
  const std::vector<glm::vec3> points = points_inside(mesh, closed.point_count, random);
  EXPECT_EQ(points.size(), static_cast<std::size_t>(closed.point_count));
  const std::vector<Receiver> receivers = receivers_at(points, closed.normal_count, random);
  const OccluderBvh occluders(mesh.view(), {.spatial_splits = placement % 2 == 0});
  const AmbientOcclusion ao(occluders, SamplePattern::standard(kRayCount),
                            {.radius = 2 * mesh_size(mesh), .surface_offset = 0});
  const QueryReport report = ao.query(receivers, {});
  EXPECT_EQ(report.ray_count, receivers.size() * kRayCount);
  EXPECT_EQ(leak_count(report), 0u);
  const QueryReport endless = query_endless(occluders, points, endless_count, random);
  EXPECT_EQ(leak_count(endless), 0u);
  fmt::print("{:>36} {:>2} {:>10} {:>11} | {:>4} {:>7}", closed.file, placement, report.ray_count, endless.ray_count,
             leak_count(report), leak_count(endless));
  for (bool robust : {false, true}) {
    if (wanted_endless_ray_count() == nullptr || placement > 0) break;  // Embree takes most of the time
    const reference::EmbreeReference embree({mesh.positions, mesh.triangles}, {.robust = robust});
    fmt::print(" | {:>14}", leak_count(embree.query(ao, receivers, {})));
  }
  fmt::print("\n");
  return {report.ray_count, endless.ray_count};
}

TEST(ClosedScans, HundredMillionRaysDoNotLeak) {
  RayCounts counts;
  std::uint64_t placement_count = 0;
  for (const ClosedMesh& closed : kMeshes) placement_count += static_cast<std::uint64_t>(closed.placement_count);
  const std::uint64_t endless_count = endless_ray_count() / placement_count + 1;
  lut::RandomStream random(91);
  for (const ClosedMesh& closed : kMeshes) {
    if (!has_shared_mesh(closed.file)) GTEST_SKIP() << missing_shared_mesh(closed.file);
    const Mesh mesh = read_shared_mesh(closed.file);
    ASSERT_TRUE(is_closed(mesh)) << closed.file;
    if (counts.bounded == 0) {
      fmt::print(
          "rays that leak: scan, placement, rays, and without end | lkao, without end | Embree default | robust\n");
    }
    for (int placement = 0; placement < closed.placement_count; ++placement) {
      SCOPED_TRACE(fmt::format("{}, placement {}", closed.file, placement));
      const glm::quat turn = placement == 0 ? glm::quat(1, 0, 0, 0) : random_rotation(random);
      Mesh placed = mesh;
      for (glm::vec3& p : placed.positions) p = turn * p;
      const RayCounts placed_counts = expect_no_leak(closed, placed, placement, endless_count, random);
      counts.bounded += placed_counts.bounded;
      counts.endless += placed_counts.endless;
    }
  }
  fmt::print("{} rays beyond the mesh, {} without end\n", counts.bounded, counts.endless);
  EXPECT_GE(counts.bounded, 100'000'000u);
  EXPECT_GE(counts.endless, endless_ray_count());
}

}  // namespace
}  // namespace lkao::tests
