// Awkward real meshes against the exact oracle: needles, duplicates, holes, self-intersections, far from the origin.
#include <algorithm>
#include <ostream>

#include <gtest/gtest.h>

#include "check.h"
#include "shared_mesh.h"

namespace lkao::tests {
namespace {

// A mesh of the shared folder with its two AO radii, of which the second is the larger.
struct SharedMesh {
  const char* name;
  float small_radius;
  float large_radius;
};

void PrintTo(const SharedMesh& mesh, std::ostream* out) { *out << mesh.name; }

class PathologicalMesh : public testing::TestWithParam<SharedMesh> {};

TEST_P(PathologicalMesh, IsAnsweredExactly) {
  const std::string file = std::string("pathological/") + GetParam().name + ".ply";
  if (!has_shared_mesh(file)) GTEST_SKIP() << missing_shared_mesh(file);
  HardCase hard_case{read_shared_mesh(file), usual_pattern()};
  const float size = mesh_size(hard_case.mesh);
  // The brute force shall end within seconds.
  const auto count = static_cast<int>(std::clamp<std::size_t>(400'000 / hard_case.mesh.triangles.size(), 16, 40));
  add_usual_groups(hard_case, count, 1, {GetParam().small_radius / size, GetParam().large_radius / size, 3.0f});
  check(GetParam().name, hard_case);
}

INSTANTIATE_TEST_SUITE_P(HardCases, PathologicalMesh,
                         testing::Values(SharedMesh{"thingi_1514499", 2, 6}, SharedMesh{"thingi_73416", 1.5f, 5},
                                         SharedMesh{"thingi_79741", 1, 4}, SharedMesh{"generic_twin_7081", 100, 400},
                                         SharedMesh{"offset1", 20, 80}, SharedMesh{"self_intersect_a", 0.05f, 0.2f},
                                         SharedMesh{"truck", 0.05f, 0.2f},
                                         SharedMesh{"elephant_with_holes", 0.03f, 0.1f},
                                         SharedMesh{"adis16480_cad", 0.001f, 0.004f}, SharedMesh{"boeing", 0.4f, 1.2f}),
                         [](const auto& mesh) { return std::string(mesh.param.name); });

}  // namespace
}  // namespace lkao::tests
