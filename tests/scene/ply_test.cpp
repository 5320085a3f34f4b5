// PLY in: encodings, property types, polygons, strips, and every way for a file to be cut short.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scene/defects.h"
#include "scene/files.h"

namespace lkao::scene::ply_test {
namespace {

std::string header(const std::string& format, int vertex_count, int face_count) {
  return "ply\nformat " + format + " 1.0\ncomment a test\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(face_count) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

template <typename T>
std::string in_order(const T& value, bool big_endian) {
  std::string bytes = raw(value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

const std::vector<glm::vec3> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::string binary_square(bool big_endian, const std::vector<std::vector<int>>& faces,
                          const std::vector<glm::vec3>& positions = kSquare) {
  std::string bytes = header(big_endian ? "binary_big_endian" : "binary_little_endian",
                             static_cast<int>(positions.size()), static_cast<int>(faces.size()));
  for (const glm::vec3& p : positions) {
    for (int axis = 0; axis < 3; ++axis) bytes += in_order(p[axis], big_endian);
  }
  for (const std::vector<int>& face : faces) {
    bytes += static_cast<char>(face.size());
    for (int index : face) bytes += in_order(index, big_endian);
  }
  return bytes;
}

TEST(Ply, TextAndBothByteOrdersGiveTheSame) {
  const TemporaryFolder folder;
  const std::string text = header("ascii", 4, 2) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  for (const std::string& bytes :
       {text, binary_square(false, {{0, 1, 2}, {0, 2, 3}}), binary_square(true, {{0, 1, 2}, {0, 2, 3}})}) {
    const Mesh mesh = read_mesh_file(folder.write("a.ply", bytes));
    EXPECT_EQ(mesh.positions, kSquare);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
  }
}

TEST(Ply, PolygonsAreFannedAndDegenerateTrianglesKept) {
  const TemporaryFolder folder;
  const Mesh mesh =
      read_mesh_file(folder.write("a.ply", binary_square(false, {{0, 1, 2, 3}, {1, 1, 2}, {0, 1}, {2, 2, 2, 2}})));
  ASSERT_EQ(mesh.triangles.size(), 5u);
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
  EXPECT_EQ(mesh.triangles[2], glm::uvec3(1, 1, 2));
  EXPECT_EQ(find_defects(mesh).zero_area_count, 3u);
}

TEST(Ply, DataMayBeginWithAnyByte) {
  // A first coordinate whose lowest byte is a line feed, a blank or the like is data all the same.
  const TemporaryFolder folder;
  for (char byte : {'\n', '\r', ' ', '\t', '#', '\0'}) {
    std::vector<glm::vec3> positions = kSquare;
    const std::array<char, 4> bytes = {byte, byte, '\x40', '\x3f'};
    std::memcpy(&positions[0].x, bytes.data(), 4);
    const Mesh mesh = read_mesh_file(folder.write("a.ply", binary_square(false, {{0, 1, 2}}, positions)));
    EXPECT_EQ(mesh.positions, positions) << int{byte};
  }
}

TEST(Ply, OtherTypesOrdersAndElementsAreUnderstood) {
  const TemporaryFolder folder;
  const std::string text =
      "ply\r\nformat ascii 1.0\r\nelement material 1\r\nproperty list uchar int things\r\nelement vertex 3\r\n"
      "property uchar red\r\nproperty double z\r\nproperty double x\r\nproperty float64 y\r\n"
      "element face 1\r\nproperty uchar flag\r\nproperty list uint8 uint32 vertex_index\r\n"
      "property list uchar float texcoord\r\nend_header\r\n"
      "2 8 9\r\n255 3 1.5e-3 +2\r\n0 0 1 0\r\n0 0 0 1\r\n7 3 2 1 0 2 0.5 0.5\r\n";
  const Mesh mesh = read_mesh_file(folder.write("A.PLY", text));
  EXPECT_EQ(mesh.positions[0], glm::vec3(1.5e-3f, 2, 3));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(2, 1, 0));
}

TEST(Ply, StripsTurnEveryOtherTriangle) {
  const TemporaryFolder folder;
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 1 3 2\n";
  const Mesh mesh = read_mesh_file(folder.write("a.ply", text));
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(2, 1, 3));
  EXPECT_EQ(mesh.triangles[2], glm::uvec3(1, 3, 2));
}

TEST(Ply, NonFiniteVerticesStayAndAreCounted) {
  const TemporaryFolder folder;
  const std::string text = header("ascii", 4, 2) + "nan 0 0\n1 0 0\n1 -inf 0\n0 1 0\n3 0 1 3\n3 1 2 3\n";
  const Mesh mesh = read_mesh_file(folder.write("a.ply", text));
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_TRUE(std::isnan(mesh.positions[0].x));
  EXPECT_EQ(mesh.positions[2].y, -std::numeric_limits<float>::infinity());
  EXPECT_EQ(find_defects(mesh).non_finite_count, 2u);
}

TEST(Ply, EveryTruncationOfABinaryFileIsRefused) {
  const TemporaryFolder folder;
  for (bool big_endian : {false, true}) {
    const std::string whole = binary_square(big_endian, {{0, 1, 2}, {0, 1, 2, 3}});
    read_mesh_file(folder.write("whole.ply", whole));
    for (std::size_t size = 1; size < whole.size(); ++size) {
      const std::string message = refusal_of(folder.write("cut.ply", whole.substr(0, size)));
      ASSERT_FALSE(message.empty()) << size << " of " << whole.size() << " bytes";
    }
  }
}

TEST(Ply, TruncationIsNamedWithItsPlace) {
  const TemporaryFolder folder;
  const std::string whole = binary_square(false, {{0, 1, 2}, {0, 2, 3}});
  expect_refused(folder.write("a.ply", whole.substr(0, whole.size() - 1)), "truncated: the file ends in face 1 of 2");
  expect_refused(folder.write("a.ply", whole.substr(0, whole.size() - 30)),
                 "truncated: the file ends in vertex 3 of 4");
  expect_refused(folder.write("a.ply", header("ascii", 4, 2) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
                 "truncated: the file ends in face 1 of 2");
  expect_refused(folder.write("a.ply", header("ascii", 4, 2) + "0 0 0\n1 0"), "truncated: the file ends in vertex 1");
}

TEST(Ply, DamagedHeadersAreRefused) {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& bytes, const std::string& fault) {
    expect_refused(folder.write("a.ply", bytes), fault);
  };
  refuse("plx\n", "does not begin with \"ply\"");
  refuse("ply\nformat ascii 1.0\nelement vertex 3\n", "the header has no end");
  refuse("ply\nformat pdp_endian 1.0\nend_header\n", "unknown format \"pdp_endian\"");
  refuse("ply\nelement vertex 0\nend_header\n", "the format line is missing");
  refuse("ply\nformat ascii 1.0\nelement face 1\nend_header\n", "there is no element \"vertex\"");
  refuse("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "vertices have no y");
  refuse("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n0\n", "unknown property type \"half\"");
  refuse("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n", "-1 elements");
  // A count from a damaged header must not be believed before the data is there.
  refuse(header("binary_little_endian", 2000000000, 2000000000) + "abc", "truncated");
}

TEST(Ply, BadIndicesAndNumbersAreRefused) {
  const TemporaryFolder folder;
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  expect_refused(folder.write("a.ply", binary_square(false, {{0, 1, 2}, {0, 1, 4}})), "triangle 1 names vertex 4");
  expect_refused(folder.write("a.ply", binary_square(false, {{0, 1, -1}})), "face 0 names vertex -1");
  expect_refused(folder.write("a.ply", header("ascii", 4, 1) + points + "3 0 1 1.5\n"), "face 0 names vertex 1.5");
  expect_refused(folder.write("a.ply", header("ascii", 4, 1) + points + "3 0 x 2\n"), "\"x\" is not a number");
  expect_refused(folder.write("a.ply", header("ascii", 4, 0) + points), "no triangles");
}

TEST(Ply, LinesMayEndInAnyWay) {
  const TemporaryFolder folder;
  const std::string text = header("ascii", 4, 2) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  for (const char* end : {"\r", "\r\n"}) {
    const std::string marked = "\xef\xbb\xbf" + with_line_ends(text, end);
    EXPECT_EQ(read_mesh_file(folder.write("a.ply", marked)).triangles.size(), 2u);
    // Behind a header that ends in CR alone, an LF is data.
    std::vector<glm::vec3> positions = kSquare;
    const std::array<char, 4> bytes = {'\n', '\n', '\x40', '\x3f'};
    std::memcpy(&positions[0].x, bytes.data(), 4);
    const std::string binary = binary_square(false, {{0, 1, 2}}, positions);
    const std::size_t data = binary.find("end_header\n") + 11;
    const std::string ended = with_line_ends(binary.substr(0, data), end) + binary.substr(data);
    EXPECT_EQ(read_mesh_file(folder.write("a.ply", ended)).positions, positions);
  }
}

TEST(Ply, LinesOfAHeaderMayEndEachInItsOwnWay) {
  const TemporaryFolder folder;
  std::string bytes = binary_square(false, {{0, 1, 2}});
  bytes.replace(bytes.find('\n'), 1, "\r\n");
  bytes.replace(bytes.find("\nelement"), 1, "\r\n");
  EXPECT_EQ(read_mesh_file(folder.write("a.ply", bytes)).positions, kSquare);
  bytes.replace(bytes.find("\nelement face"), 1, "\r");
  EXPECT_EQ(read_mesh_file(folder.write("a.ply", bytes)).positions, kSquare);
}

TEST(Ply, TextMayHaveMoreOnALineOrFewerLines) {
  const TemporaryFolder folder;
  for (const char* records :
       {"0 0 0 9 9\n1 0 0\n1 1 0 255 255 255 255\n0 1 0\n3 0 1 2 0 0 0\n3 0 2 3 1\n",
        "0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 3 0 2 3\n", "0\n0\n0\n1 0 0\n1 1 0\n0 1\n0\n3 0\n1 2\n3 0 2 3"}) {
    const Mesh mesh = read_mesh_file(folder.write("a.ply", header("ascii", 4, 2) + records));
    EXPECT_EQ(mesh.positions, kSquare) << records;
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}})) << records;
  }
}

TEST(Ply, NormalsAreRead) {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh_file(
      folder.write("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 4\nproperty float nx\nproperty float x\nproperty float y\n"
                   "property float z\nproperty float ny\nproperty float nz\nelement face 1\n"
                   "property list uchar int vertex_indices\nend_header\n0 0 0 0 0 2\n0 1 0 0 0 0\nnan 1 1 0 0 1\n0 0 1 "
                   "0 3 4\n4 0 1 2 3\n"));
  EXPECT_EQ(mesh.positions, kSquare);
  ASSERT_EQ(mesh.normals.size(), 4u);
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0.6f, 0.8f));
  EXPECT_EQ(mesh.normal_corners, (std::vector<glm::uvec3>{{0, kNoNormal, kNoNormal}, {0, kNoNormal, 3}}));
}

TEST(Ply, AnOriginInACommentIsThatOfTheMesh) {
  const TemporaryFolder folder;
  std::string text = header("ascii", 3, 1) + "0 0 0.25\n1 0 0\n1 1 0\n3 0 1 2\n";
  text.insert(text.find("comment"), "comment origin 448262 5413678 112\n");
  const Mesh mesh = read_mesh_file(folder.write("a.ply", text));
  EXPECT_EQ(mesh.origin, glm::dvec3(448262, 5413678, 112));
  EXPECT_EQ(mesh.positions[0], glm::vec3(0, 0, 0.25f));
  const Mesh moved = read_mesh_file(folder.path("a.ply"), {.origin = glm::dvec3(448260, 5413678, 112)});
  EXPECT_EQ(moved.positions[0], glm::vec3(2, 0, 0.25f));
  text.replace(text.find("448262"), 6, "of the");
  EXPECT_EQ(read_mesh_file(folder.write("a.ply", text)).origin, glm::dvec3(0)) << "an ordinary comment";
}

}  // namespace
}  // namespace lkao::scene::ply_test
