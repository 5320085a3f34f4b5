// Real meshes: what the report promises holds for them too.
#include <filesystem>

#include <gtest/gtest.h>

#include "lod/simplify.h"
#include "scene/mesh_file.h"

namespace lkao::lod {
namespace {

struct Row {
  const char* file;
  float radius;
  double most_of_level_3;  // of the triangles
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.file; }

class SharedSceneLevels : public testing::TestWithParam<Row> {};

TEST_P(SharedSceneLevels, KeepToTheirEpsilonsAndLoseTriangles) {
  const Row& row = GetParam();
  const std::filesystem::path path = std::filesystem::path(LKAO_SHARED_DIR) / "scenes" / row.file;
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "NOT TESTED: the shared scene " << row.file << " is missing (looked in " << LKAO_SHARED_DIR
                 << "; set the environment variable or the CMake variable LKAO_SHARED_DIR)";
  }
  const scene::Mesh mesh = scene::read_mesh_file(path.string());
  SimplifyOptions options;
  options.levels.epsilon = automatic_epsilon(row.radius, options.levels);
  const Simplified result = simplify(mesh, options);
  const SimplifyReport& report = result.report;
  EXPECT_EQ(report.triangle_count, mesh.triangles.size());
  EXPECT_EQ(report.triangle_count, report.zero_area_count + report.non_finite_count + report.duplicate_count +
                                       report.small_part_triangle_count + report.simplified_part_triangle_count);
  for (std::size_t i = 1; i < result.chain.levels.size(); ++i) {
    const double epsilon = result.chain.levels[i].epsilon;
    EXPECT_LE(report.levels[i].from_original.maximum, epsilon);
    EXPECT_LE(report.levels[i].to_original.maximum, epsilon);
    EXPECT_LE(report.levels[i].triangle_count, report.levels[i - 1].triangle_count);
    EXPECT_GT(report.levels[i].area, 0.8 * report.levels[0].area);
  }
  EXPECT_LE(static_cast<double>(report.levels[3].triangle_count),
            row.most_of_level_3 * static_cast<double>(report.triangle_count));
}

INSTANTIATE_TEST_SUITE_P(Some, SharedSceneLevels,
                         testing::Values(Row{"bunny.ply", 0.04f, 0.01}, Row{"pathological/truck.ply", 0.2f, 0.9},
                                         Row{"pathological/offset1.ply", 80, 0.9},
                                         Row{"pathological/elephant_with_holes.ply", 0.1f, 0.5},
                                         Row{"pathological/adis16480_cad.ply", 0.004f, 0.7}),
                         [](const testing::TestParamInfo<Row>& scene) {
                           return std::filesystem::path(scene.param.file).stem().string();
                         });

}  // namespace
}  // namespace lkao::lod
