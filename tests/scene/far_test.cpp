// Files whose positions are far from zero keep what a float would lose.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "scene/files.h"

namespace lkao::scene {
namespace {

// A square of 0.1 units, that far away.
std::string square_text(const char* vertex, const glm::dvec3& place) {
  std::string text;
  for (const glm::dvec2& p : {glm::dvec2(0, 0), glm::dvec2(0.1, 0), glm::dvec2(0.1, 0.1), glm::dvec2(0, 0.1)}) {
    text += fmt::format("{}{:.17g} {:.17g} {:.17g}\n", vertex, place.x + p.x, place.y + p.y, place.z);
  }
  return text;
}

void expect_small_square(const Mesh& mesh, const glm::dvec3& place) {
  EXPECT_LT(glm::distance(glm::dvec3(mesh.positions[0]) + mesh.origin, place), 1e-7);
  EXPECT_NEAR(glm::distance(mesh.positions[0], mesh.positions[1]), 0.1f, 1e-7f);
  EXPECT_NEAR(glm::distance(mesh.positions[1], mesh.positions[2]), 0.1f, 1e-7f);
}

TEST(MeshFile, KeepsDetailFarAway) {
  const TemporaryFolder folder;
  const glm::dvec3 place(448262.32, 5413678.16, 112.4);
  expect_small_square(read_mesh_file(folder.write("a.off", "OFF 4 1 0\n" + square_text("", place) + "4 0 1 2 3\n")),
                      place);
  expect_small_square(
      read_mesh_file(folder.write("a.ply",
                                  "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
                                  "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
                                  "end_header\n" +
                                      square_text("", place) + "4 0 1 2 3\n")),
      place);
}

TEST(MeshFile, TakesAGivenOrigin) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.off", "OFF 3 1 0\n101 0 0\n102 0 0\n101 1 0\n3 0 1 2\n");
  const Mesh mesh = read_mesh_file(path, {.origin = glm::dvec3(100, 0, 0)});
  EXPECT_EQ(mesh.origin, glm::dvec3(100, 0, 0));
  EXPECT_EQ(mesh.positions[1], glm::vec3(2, 0, 0));
}

}  // namespace
}  // namespace lkao::scene
