// OBJ and STL in, and what is refused whatever the type.
#include "scene/mesh_file.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scene/defects.h"
#include "scene/files.h"
#include "scene/load.h"

namespace lkao::scene {
namespace {

const std::vector<glm::vec3> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

// ---- any type ----

TEST(MeshFile, MissingFilesFoldersAndUnknownTypesAreRefused) {
  const TemporaryFolder folder;
  expect_refused(folder.path("missing.ply"), "no such file");
  expect_refused(folder.path(""), "is a directory");
  expect_refused(folder.write("a.xyz", "1 2 3\n"), "not a supported mesh type");
  expect_refused(folder.write("noextension", "1 2 3\n"), "not a supported mesh type");
  EXPECT_THROW(load("builtin:nothing"), std::runtime_error);
}

TEST(MeshFile, EmptyFilesAndGarbageAreRefused) {
  const TemporaryFolder folder;
  std::string garbage;
  for (int i = 0; i < 3000; ++i) garbage += static_cast<char>(i * 37 + 11);
  for (const char* extension : {"ply", "obj", "stl", "off", "gltf", "glb"}) {
    expect_refused(folder.write(std::string("empty.") + extension, ""), "empty");
    expect_refused(folder.write(std::string("garbage.") + extension, garbage), "");
  }
}

// ---- OBJ ----

TEST(Obj, PolygonsAreFannedAndCornersJoined) {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh_file(folder.write("a.obj",
                                                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
                                                "f 1/1/1 2/1/1 3/1/1 4/1/1\nf -4 -3 -2\nf 1 1 2\nl 1 2\np 3\n"));
  EXPECT_EQ(mesh.positions.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(corners(mesh, 0), (std::vector<glm::vec3>{kSquare[0], kSquare[1], kSquare[2]}));
  EXPECT_EQ(corners(mesh, 1), (std::vector<glm::vec3>{kSquare[0], kSquare[2], kSquare[3]}));
  EXPECT_EQ(corners(mesh, 2), corners(mesh, 0));
  EXPECT_EQ(corners(mesh, 3), (std::vector<glm::vec3>{kSquare[0], kSquare[0], kSquare[1]}));
}

TEST(Obj, TrianglesOfAllGroupsAreKept) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 300; ++i) {
    const std::string x = std::to_string(i);
    text += "o part" + x + "\ng g" + x + "\nusemtl m" + std::to_string(i % 3) + "\nv " + x + " 0 0\nv " + x +
            " 1 0\nv " + x + " 0 1\nf -3 -2 -1\n";
  }
  const Mesh mesh = read_mesh_file(folder.write("a.obj", text));
  EXPECT_EQ(mesh.triangles.size(), 300u);
  EXPECT_EQ(mesh.positions.size(), 900u);
}

TEST(Obj, ManyCornersMakeOnePolygon) {
  const TemporaryFolder folder;
  std::string text;
  std::string face = "f";
  for (int i = 1; i <= 2000; ++i) {
    text += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
    face += " " + std::to_string(i);
  }
  EXPECT_EQ(read_mesh_file(folder.write("a.obj", text + face + "\n")).triangles.size(), 1998u);
}

TEST(Obj, NanVerticesAreNeitherJoinedNorLost) {
  const TemporaryFolder folder;
  const Mesh mesh =
      read_mesh_file(folder.write("a.obj", "v nan 0 0\nv 1 0 0\nv 1 1 0\nv nan 0 0\nf 1 2 3\nf 4 2 3\nf 3 2 3\n"));
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(find_defects(mesh).non_finite_count, 2u);
}

TEST(Obj, BadIndicesAreRefused) {
  const TemporaryFolder folder;
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  expect_refused(folder.write("a.obj", points + "f 1 2 9\n"), "out of range");
  expect_refused(folder.write("a.obj", points + "f 1 2 -9\n"), "out of range");
  expect_refused(folder.write("a.obj", points + "f 1 2 0\n"), "");
  expect_refused(folder.write("a.obj", points), "no triangles");
  expect_refused(folder.write("a.obj", points + "l 1 2\n"), "no triangles");
}

// ---- STL ----

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

const std::string kTextFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n";

TEST(Stl, BinaryTrianglesAreAllKeptAndCornersJoined) {
  const TemporaryFolder folder;
  for (const char* title : {"binary", "solid, but binary all the same"}) {
    const Mesh mesh = read_mesh_file(folder.write("a.stl", binary_stl(title, 3)));
    EXPECT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(find_defects(mesh).zero_area_count, 1u);
  }
}

TEST(Stl, TextIsRead) {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh_file(folder.write("a.stl", "solid a\n" + kTextFacet + kTextFacet + "endsolid a\n"));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(corners(mesh, 1), (std::vector<glm::vec3>{kSquare[0], kSquare[1], kSquare[2]}));
}

TEST(Stl, EveryTruncationIsRefused) {
  const TemporaryFolder folder;
  const std::string binary = binary_stl("binary", 3);
  for (std::size_t size = 1; size < binary.size(); ++size) {
    ASSERT_FALSE(refusal_of(folder.write("cut.stl", binary.substr(0, size))).empty()) << size;
  }
  const std::string text = "solid a\n" + kTextFacet + kTextFacet;
  for (std::size_t size = 1; size <= text.size(); size += 3) {
    ASSERT_FALSE(refusal_of(folder.write("cut.stl", text.substr(0, size))).empty()) << size;
  }
  expect_refused(folder.write("cut.stl", binary.substr(0, binary.size() - 50)), "truncated");
  expect_refused(folder.write("cut.stl", "solid a\n" + kTextFacet + "endsolid a\nsolid b\n" + kTextFacet), "truncated");
}

}  // namespace
}  // namespace lkao::scene
