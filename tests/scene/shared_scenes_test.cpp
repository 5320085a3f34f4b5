// The shared scenes, against the table of their README.
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "scene/defects.h"
#include "scene/mesh_file.h"

namespace lkao::scene {
namespace {

struct Row {
  const char* file;
  std::size_t triangle_count;
  std::size_t vertex_count;
  std::size_t zero_area_count;
  std::size_t duplicate_count;
  std::size_t unused_vertex_count;
};

// The file alone: the tests' names must not hold addresses.
void PrintTo(const Row& row, std::ostream* out) { *out << row.file; }

class SharedScene : public testing::TestWithParam<Row> {};

TEST_P(SharedScene, MatchesItsTable) {
  const Row& row = GetParam();
  const std::filesystem::path path = std::filesystem::path(LKAO_SHARED_DIR) / "scenes" / row.file;
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "NOT TESTED: the shared scene " << row.file << " is missing (looked in " << LKAO_SHARED_DIR
                 << "; set the environment variable or the CMake variable LKAO_SHARED_DIR)";
  }
  const Mesh mesh = read_mesh_file(path.string());
  EXPECT_EQ(mesh.triangles.size(), row.triangle_count);
  EXPECT_EQ(mesh.positions.size(), row.vertex_count);
  const Defects defects = find_defects(mesh);
  EXPECT_EQ(defects.non_finite_count, 0u);
  EXPECT_EQ(defects.zero_area_count, row.zero_area_count);
  EXPECT_EQ(defects.duplicate_count, row.duplicate_count);
  EXPECT_EQ(defects.unused_vertex_count, row.unused_vertex_count);
}

INSTANTIATE_TEST_SUITE_P(
    All, SharedScene,
    testing::Values(Row{"sibenik.ply", 75284, 40981, 9, 218, 2}, Row{"conference.ply", 331179, 194399, 53627, 1047, 0},
                    Row{"sponza_crytek.ply", 262267, 145185, 1, 70, 0}, Row{"dragon.ply", 871414, 437645, 108, 0, 0},
                    Row{"armadillo.ply", 86482, 43243, 0, 0, 0}, Row{"bunny.ply", 69451, 35947, 0, 0, 1113},
                    Row{"candela_city.ply", 427002, 276689, 0, 20625, 0},
                    Row{"black_forest.ply", 1086350, 1212527, 9, 20804, 0},
                    Row{"littlest_tokyo.ply", 141802, 100942, 2, 395, 0},
                    Row{"pathological/offset1.ply", 4418, 2287, 42, 11, 0},
                    Row{"pathological/generic_twin_7081.ply", 19704, 9874, 0, 0, 0},
                    Row{"pathological/thingi_1514499.ply", 26700, 13350, 0, 0, 0},
                    Row{"pathological/thingi_73416.ply", 76840, 38396, 0, 0, 0},
                    Row{"pathological/thingi_79741.ply", 14740, 7372, 0, 0, 0},
                    Row{"pathological/self_intersect_a.ply", 17160, 8582, 0, 0, 0},
                    Row{"pathological/truck.ply", 4770, 2956, 0, 0, 0},
                    Row{"pathological/elephant_with_holes.ply", 4463, 2798, 0, 0, 0},
                    Row{"pathological/adis16480_cad.ply", 7436, 3672, 0, 0, 0},
                    Row{"pathological/boeing.ply", 2564, 2741, 0, 0, 0}),
    [](const testing::TestParamInfo<Row>& scene) { return std::filesystem::path(scene.param.file).stem().string(); });

}  // namespace
}  // namespace lkao::scene
