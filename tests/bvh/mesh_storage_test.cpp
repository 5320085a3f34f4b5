// Hierarchies that refer to the host's own arrays.
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "equal_layouts.h"
#include "lkao/ambient_occlusion.h"
#include "support/laid_out.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

using tests::LaidOut;
using tests::Mesh;

const BuildOptions kRefer{.mesh_storage = MeshStorage::refer};

// Receivers on corners and on edges, where many rays are in doubt, and others.
std::vector<std::uint64_t> bits_near(const Mesh& mesh, const OccluderBvh& occluders, Kernel kernel) {
  std::vector<Receiver> receivers = tests::random_receivers(30, 1, 91);
  for (std::size_t i = 0; i < 60; ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y];
    receivers.push_back({.position = i % 2 == 0 ? a : 0.5f * (a + b), .normal = {0, 0, 1}});
  }
  const AmbientOcclusion ao(occluders, SamplePattern::standard(64), {.radius = 0.8f}, kernel);
  std::vector<std::uint64_t> words(receivers.size() * static_cast<std::size_t>(ao.pattern().word_count()));
  ao.query(receivers, {.mask_words = words});
  return words;
}

void expect_same_answers(const Mesh& mesh, const OccluderBvh& referring, const OccluderBvh& copying) {
  EXPECT_EQ(bits_near(mesh, referring, Kernel::simd), bits_near(mesh, copying, Kernel::simd));
  EXPECT_EQ(bits_near(mesh, referring, Kernel::scalar), bits_near(mesh, copying, Kernel::scalar));
  tests::expect_equal(referring.layout().nodes, copying.layout().nodes);
  tests::expect_equal(referring.layout().leaves, copying.layout().leaves);
}

template <typename Index>
void expect_same_in_any_layout() {
  const Mesh mesh = tests::random_soup(200, 0.4f, 92);
  const OccluderBvh copying(mesh.view());
  for (const auto& [offset, gap] : {std::pair(0, 0), std::pair(0, 4), std::pair(12, 20), std::pair(1, 3)}) {
    const LaidOut<Index> laid_out(mesh, static_cast<std::size_t>(offset), static_cast<std::size_t>(gap));
    expect_same_answers(mesh, OccluderBvh(laid_out.view(), kRefer), copying);
  }
}

TEST(MeshStorage, AnswersTheSameFromTheHostsArrays) {
  expect_same_in_any_layout<std::uint16_t>();
  expect_same_in_any_layout<std::uint32_t>();
  expect_same_in_any_layout<std::int32_t>();
}

TEST(MeshStorage, AnswersTheSameFromTheHostsDoubles) {
  const Mesh mesh = tests::random_soup(200, 0.4f, 93);
  const glm::dvec3 origin(4e6, -5e6, 1e5);
  std::vector<glm::dvec3> far;
  far.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) far.push_back(origin + glm::dvec3(p));
  const TriangleMesh view{{far, origin}, mesh.triangles};
  const OccluderBvh referring(view, kRefer);
  EXPECT_EQ(referring.origin(), origin);
  expect_same_answers(mesh, referring, OccluderBvh(view));
}

TEST(MeshStorage, CountsNoMemoryOfTheHosts) {
  const Mesh mesh = tests::random_soup(200, 0.4f, 94);
  const OccluderBvh referring(mesh.view(), kRefer), copying(mesh.view());
  EXPECT_EQ(referring.report().memory_bytes + mesh.positions.size() * sizeof(glm::vec3) +
                mesh.triangles.size() * sizeof(glm::uvec3),
            copying.report().memory_bytes);
}

// Only rays in doubt do.
TEST(MeshStorage, ReadsTheHostsArrays) {
  Mesh mesh = tests::random_soup(200, 0.4f, 95);
  const OccluderBvh referring(mesh.view(), kRefer);
  const std::vector<std::uint64_t> before = bits_near(mesh, referring, Kernel::scalar);
  const std::vector<glm::vec3> positions = mesh.positions;
  for (glm::vec3& p : mesh.positions) p = {9, 9, 9};
  const Mesh as_it_was{positions, mesh.triangles};
  EXPECT_NE(bits_near(as_it_was, referring, Kernel::scalar), before);
  mesh.positions = positions;
  EXPECT_EQ(bits_near(as_it_was, referring, Kernel::scalar), before);
}

TEST(MeshStorage, OfACopyOutlivesTheMesh) {
  auto mesh = std::make_unique<Mesh>(tests::random_soup(200, 0.4f, 96));
  const Mesh same = *mesh;
  OccluderBvh occluders(mesh->view());
  mesh.reset();
  expect_same_answers(same, occluders, OccluderBvh(same.view()));
  auto moved = std::make_unique<Mesh>(tests::random_soup(200, 0.4f, 97));
  const Mesh same_moved = *moved;
  occluders = occluders.refitted(moved->positions);
  moved.reset();
  expect_same_answers(same_moved, occluders, OccluderBvh(same.view()).refitted(same_moved.positions));
}

// The new positions, and the triangles of the build.
TEST(MeshStorage, StaysAsItIsInARefit) {
  const Mesh mesh = tests::random_soup(200, 0.4f, 98), moved = tests::random_soup(200, 0.4f, 99);
  auto positions = std::make_unique<std::vector<glm::vec3>>(mesh.positions);
  OccluderBvh referring({*positions, mesh.triangles}, kRefer);
  for (const double max_growth : {std::numeric_limits<double>::infinity(), 1.0}) {
    const OccluderBvh refitted = referring.refitted(moved.positions, {.max_growth = max_growth});
    EXPECT_EQ(refitted.report().growth == 1, max_growth == 1);
    EXPECT_EQ(refitted.report().memory_bytes,
              refitted.layout().nodes.size() * sizeof(bvh::Node) + refitted.layout().leaves.size() * sizeof(bvh::Leaf));
    expect_same_answers(moved, refitted,
                        OccluderBvh(mesh.view()).refitted(moved.positions, {.max_growth = max_growth}));
  }
  // A host that overwrites its positions, or lets them go, gives the hierarchy the new ones.
  referring = referring.refitted(moved.positions, {.max_growth = std::numeric_limits<double>::infinity()});
  positions.reset();
  EXPECT_EQ(bits_near(moved, referring, Kernel::scalar), bits_near(moved, OccluderBvh(moved.view()), Kernel::scalar));
}

TEST(MeshStorage, TakesNoIndexOutOfRange) {
  Mesh mesh = tests::closed_box();
  mesh.triangles[5].y = 8;
  EXPECT_THROW(OccluderBvh(mesh.view(), kRefer), std::invalid_argument);
}

}  // namespace
}  // namespace lkao
