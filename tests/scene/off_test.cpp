// OFF in: every way to lay out its numbers.
#include <gtest/gtest.h>

#include "scene/files.h"

namespace lkao::scene::off_test {
namespace {

TEST(Off, IsReadWithCommentsColoursAndBigPolygons) {
  const TemporaryFolder folder;
  std::string text = "# a comment\nOFF\n\n14 2 0 # counts\n";
  std::string face = "12";
  for (int i = 0; i < 14; ++i) text += std::to_string(i) + " " + std::to_string(i * i) + " 0\n# between\n";
  for (int i = 0; i < 12; ++i) face += " " + std::to_string(i);
  const Mesh mesh = read_mesh_file(folder.write("a.off", text + face + " 255 0 0\n3 13 12 0"));
  EXPECT_EQ(mesh.positions.size(), 14u);
  ASSERT_EQ(mesh.triangles.size(), 11u);
  EXPECT_EQ(mesh.triangles[9], glm::uvec3(0, 10, 11));
  EXPECT_EQ(mesh.triangles[10], glm::uvec3(13, 12, 0));
}

TEST(Off, CountsMayFollowOnTheSameLine) {
  const TemporaryFolder folder;
  const Mesh mesh =
      read_mesh_file(folder.write("a.off", "NOFF 3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 2 0 0 0 1\n3 0 1 2\n"));
  EXPECT_EQ(mesh.positions[2], glm::vec3(0, 2, 0));
}

TEST(Off, FaultsAreNamed) {
  const TemporaryFolder folder;
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n";
  const auto refuse = [&](const std::string& bytes, const std::string& fault) {
    expect_refused(folder.write("a.off", bytes), fault);
  };
  refuse("OFF\n3 2 0\n" + points + "3 0 1 2\n", "truncated: 1 of 2 faces");
  refuse("OFF\n4 1 0\n" + points, "truncated: 3 of 4 vertices");
  refuse("OFF\n3 1 0\n0 0 0\n1 0\n", "vertex 1 has 2 of 3 coordinates");
  refuse("OFF\n3 1 0\n" + points + "3 0 1", "face 0 has 2 of 3 corners");
  refuse("OFF\n3 1 0\n" + points + "3 0 1 3\n", "face 0 names vertex 3, but there are only 3 vertices");
  refuse("OFF\n3 1 0\n" + points + "3 0 1 -1\n", "index is -1");
  refuse("OFF\n3 0 0\n" + points, "no triangles");
  refuse("OFF", "no counts");
  refuse("OFF BINARY\n", "binary OFF");
  refuse("hello\n", "the word OFF is missing");
}

const char kPoints[] = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

// A square of two triangles, as `bytes` write it.
void expect_square(const std::string& bytes) {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh_file(folder.write("a.off", bytes));
  EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})) << bytes;
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}})) << bytes;
}

TEST(Off, CountsMayStandAnywhere) {
  const std::string body = std::string(kPoints) + "3 0 1 2\n3 0 2 3\n";
  for (const char* counts : {"OFF\n4 2 0\n", "OFF\n4 2\n", "off\n4 2 0\n", "OFF4 2 0\n", "  OFF4 2\n", "OFF 4 2 0\n",
                             "OFF\n4\n2\n0\n", "OFF\n4\n2\n", "OFF 4\n2\n0\n", "# word\n\nOFF # kind\n4 2 0 # counts\n",
                             "4 2 0\n", "\xef\xbb\xbfOFF\n4 2 0\n"}) {
    expect_square(counts + body);
  }
}

TEST(Off, RecordsMayGoOverLinesOrShareOne) {
  expect_square("OFF 4 2 0\n0\n0\n0\n1 0\n0\n1 1 0\n0 1\n0\n3\n0\n1\n2\n3\n0 2\n3\n");
  expect_square("OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 1 0\n3 0 1 2 255 0 0\n3 0 2 3\n");
  expect_square("COFF 4 2 0\n0 0 0 9 9 9 9 1 0 0 9 9 9 9\n1 1 0 9 9 9 9 0 1 0 9 9 9 9\n3 0 1 2\n3 0 2 3");
}

TEST(Off, ColoursMayBeOfAnyNumber) {
  expect_square("COFF\n4 2 0\n0 0 0 255 0 0\n1 0 0 1 1 1 1\n1 1 0\n0 1 0 7\n3 0 1 2 1 1 1\n3 0 2 3 0.5\n");
}

TEST(Off, LinesMayEndInAnyWay) {
  const std::string text = "OFF\n4 2 0\n" + std::string(kPoints) + "3 0 1 2\n3 0 2 3\n";
  for (const char* end : {"\r", "\r\n"}) expect_square(with_line_ends(text, end));
}

TEST(Off, NormalsAreReadAndFourthCoordinatesDivide) {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh_file(folder.write(
      "a.off",
      "STCN4OFF 3 1 0\n0 0 0 2 0 0 3 1 1 1 1 0 0\n2 0 0 2 0 0 1 1 1 1 1 0 0\n2 2 0 2 0 0 0 1 1 1 1 0 0\n3 0 1 2\n"));
  EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
  ASSERT_EQ(mesh.normals.size(), 3u);
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.normal_corners[0], glm::uvec3(0, 1, kNoNormal)) << "the third has no length";
}

}  // namespace
}  // namespace lkao::scene::off_test
