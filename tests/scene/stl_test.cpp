// STL, text and binary, as programs write it.
#include <cmath>

#include <gtest/gtest.h>

#include "scene/defects.h"
#include "scene/files.h"

namespace lkao::scene::stl_test {
namespace {

using Corners = std::vector<glm::vec3>;

const Corners kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::string binary_stl(const std::string& title, std::uint32_t triangle_count) {
  std::string bytes = title + std::string(80 - title.size(), ' ') + raw(triangle_count);
  for (std::uint32_t t = 0; t < triangle_count; ++t) {
    bytes += raw(glm::vec3(0, 0, 1));
    // The last triangle has no area.
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      bytes += raw(t + 1 < triangle_count ? kSquare[corner] : kSquare[t]);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n";

std::string upper_case(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
  return text;
}

class Stl : public testing::Test {
 protected:
  Mesh read(const std::string& bytes) const { return read_mesh_file(folder_.write("a.stl", bytes)); }
  void refuse(const std::string& bytes, const std::string& fault) const {
    expect_refused(folder_.write("a.stl", bytes), fault);
  }

  const TemporaryFolder folder_;
};

TEST_F(Stl, BinaryTrianglesAreAllKeptAndCornersJoined) {
  for (const char* title : {"binary", "solid, but binary all the same"}) {
    const Mesh mesh = read(binary_stl(title, 3));
    EXPECT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(find_defects(mesh).zero_area_count, 1u);
  }
}

TEST_F(Stl, TheCountSaysWhereBinaryTrianglesEnd) {
  for (const std::string title : {"binary", "solid facet"}) {
    EXPECT_EQ(read(binary_stl(title, 3) + "\r\n").triangles.size(), 3u);
    EXPECT_EQ(read(binary_stl(title, 3) + std::string(1000, 'x')).triangles.size(), 3u);
  }
  std::string bytes = binary_stl("binary", 3);
  bytes.replace(80, 4, raw(std::uint32_t{0}));
  refuse(bytes, "its header promises no triangles, but there is room for 3");
  bytes.replace(80, 4, raw(std::uint32_t{0xffffffff}));
  refuse(bytes, "234 bytes, but the 4294967295 triangles of its header take 214748364834");
  refuse(binary_stl("binary", 0), "no triangles");
}

TEST_F(Stl, NanCornersAreNeverJoined) {
  std::string bytes = binary_stl("binary", 2);
  for (std::size_t triangle : {0u, 1u}) bytes.replace(84 + 50 * triangle + 12, 4, raw(std::nanf("")));
  const Mesh mesh = read(bytes);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(find_defects(mesh).non_finite_count, 2u);
}

TEST_F(Stl, TextMayLookLikeAnything) {
  const std::string text = "solid a\n" + kFacet + kFacet + "endsolid a\n";
  for (const std::string& variant : {
           text,
           upper_case(text),
           replaced(text, "\n", "\r"),
           replaced(text, "\n", "\r\n"),
           replaced(text, "\n", "\n \t"),
           "\xef\xbb\xbf \n\n" + text,
           replaced(text, "end", "end "),
           replaced(text, "endsolid a\n", "endsolid"),
           replaced(text, "0 0 1", "-nan(ind) -1.#IND nan"),
           replaced(text, "normal 0 0 1", "normal"),
           replaced(text, " normal 0 0 1", ""),
           replaced(text, " a\n", "\n"),
           replaced(text, " a\n", " facet vertex endsolid \xe4 0 1,5\n"),
           replaced(text, "facet n", "colour 1 0 0\nfacet n"),
           "solid a\n" + kFacet + "endsolid a\n\nsolid b\n" + kFacet + "endsolid b\n",
           "solid a\nendsolid a\n" + text,
           kFacet + kFacet,
           replaced(text, "vertex 1 1 0\n", "vertex 1.0E+00 .1e1 -0\n"),
       }) {
    const Mesh mesh = read(variant);
    ASSERT_EQ(mesh.triangles.size(), 2u) << variant;
    EXPECT_EQ(corners(mesh, 1), (Corners{kSquare[0], kSquare[1], kSquare[2]})) << variant;
    EXPECT_EQ(mesh.positions.size(), 3u) << variant;
  }
}

TEST_F(Stl, LoopsMayHaveMoreCornersThanThree) {
  const Mesh mesh = read(
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 1 0\nvertex 0 2 0\nvertex .5 1 0\nendloop\n"
      "endfacet\nendsolid");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (std::size_t t = 0; t < 2; ++t) {
    const Corners p = corners(mesh, t);
    EXPECT_GT((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x), 0);
  }
}

TEST_F(Stl, EveryTruncationIsRefused) {
  const std::string binary = binary_stl("binary", 3);
  for (std::size_t size = 1; size < binary.size(); ++size) {
    ASSERT_FALSE(refusal_of(folder_.write("a.stl", binary.substr(0, size))).empty()) << size;
  }
  const std::string text = "solid a\n" + kFacet + kFacet;
  for (std::size_t size = 1; size <= text.size(); size += 3) {
    ASSERT_FALSE(refusal_of(folder_.write("a.stl", text.substr(0, size))).empty()) << size;
  }
  refuse(binary.substr(0, binary.size() - 50), "truncated");
  refuse("solid a\n" + kFacet + "endsolid a\nsolid b\n" + kFacet, "truncated");
}

TEST_F(Stl, FaultsAreNamedWithTheirLine) {
  const auto refuse_facet = [&](const std::string& from, const std::string& to, const std::string& fault) {
    refuse("solid a\n" + kFacet + replaced(kFacet, from, to) + "endsolid a\n", fault);
  };
  refuse_facet("1 1 0", "1 x 0", "line 13: \"x\" is not a number");
  refuse_facet("vertex 1 1 0", "vertex 1 1", "line 14: \"endloop\" is not a number");
  refuse_facet("outer loop\n", "", "line 10: \"vertex\" in a facet");
  refuse_facet("endloop\n", "", "line 14: \"endfacet\" in a loop");
  refuse_facet("endfacet\n", "", "line 15: \"endsolid\" in a facet");
  refuse_facet("facet normal 0 0 1\n", "", "line 9: \"outer\" outside of a facet");
  refuse("hello\n", "neither text nor as long as a binary one");
}

}  // namespace
}  // namespace lkao::scene::stl_test
