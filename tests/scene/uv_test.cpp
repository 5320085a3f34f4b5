// Texture coordinates and materials of OBJ, PLY and OFF.
#include <gmock/gmock.h>

#include "scene/files.h"

namespace lkao::scene {
namespace {

using testing::ElementsAre;

constexpr glm::uvec3 kNoUvs(kNoUv);

MeshFile open_with_uvs(const std::string& name, const std::string& text, int uv_set = 0) {
  const TemporaryFolder folder;
  return open_mesh_file(folder.write(name, text), {.uv_set = uv_set});
}

// The texture coordinates of a triangle's corners.
std::vector<glm::vec2> uvs_of(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3& corners = mesh.uv_corners.at(triangle);
  return {mesh.uvs.at(corners.x), mesh.uvs.at(corners.y), mesh.uvs.at(corners.z)};
}

const std::string kObj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvt 1 1 0.5\nvt 0.5\nf 1/1 2/2 3/3 4/4\n";

TEST(Uvs, AreReadWhereTheyAreAskedForAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.obj", "usemtl red\n" + kObj);
  const MeshFile plain = open_mesh_file(path);
  EXPECT_EQ(plain.contents.uv_set_count, 1);
  EXPECT_TRUE(plain.mesh.uvs.empty() && plain.mesh.uv_corners.empty() && plain.mesh.materials.empty());
  EXPECT_TRUE(plain.contents.materials.empty());
  const MeshFile other = open_mesh_file(path, {.uv_set = 1});
  EXPECT_TRUE(other.mesh.uvs.empty() && other.mesh.uv_corners.empty()) << "it has no set 1";
  EXPECT_EQ(other.mesh.materials.size(), 2);
  EXPECT_THROW(open_mesh_file(path, {.uv_set = -1}), std::invalid_argument);
}

TEST(Uvs, OfObjBeginAtTheUpperLeft) {
  const Mesh mesh = open_with_uvs("a.obj", kObj).mesh;
  EXPECT_THAT(uvs_of(mesh, 0), ElementsAre(glm::vec2(0, 1), glm::vec2(1, 0.75f), glm::vec2(1, 0)));
  EXPECT_THAT(uvs_of(mesh, 1), ElementsAre(glm::vec2(0, 1), glm::vec2(1, 0), glm::vec2(0.5f, 1)));
  EXPECT_TRUE(mesh.materials.empty());
}

TEST(Uvs, OfObjCountBackAndMayBeMissing) {
  const std::string positions = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const Mesh mesh = open_with_uvs("a.obj", positions +
                                               "f 1 2 3\nvt 0 1\nvt nonsense\nvt 1 1\n"
                                               "f 1/-3 2/-1 3/9\nf 1/-3/1 2/-2 3/0\nf 1//1 2 3\n")
                        .mesh;
  ASSERT_EQ(mesh.uv_corners.size(), 4);
  EXPECT_EQ(mesh.uv_corners[0], kNoUvs);
  EXPECT_EQ(mesh.uv_corners[1], glm::uvec3(0, 2, kNoUv)) << "the last names what never comes";
  EXPECT_EQ(mesh.uv_corners[2], glm::uvec3(0, kNoUv, kNoUv)) << "the second is no number";
  EXPECT_EQ(mesh.uv_corners[3], kNoUvs);
  EXPECT_TRUE(open_with_uvs("a.obj", positions + "vt x\nf 1/1 2/1 3/1\n").mesh.uvs.empty());
}

TEST(Uvs, StayWithCornersOfCutPolygons) {
  // An arrowhead, which a fan around its first corner would cover wrongly.
  const Mesh mesh = open_with_uvs("a.obj",
                                  "v 4 0 0\nv 0 2 0\nv 1 0 0\nv 0 -2 0\nvt 4 0\nvt 0 2\nvt 1 0\nvt 0 -2\n"
                                  "f 2/2 3/3 4/4 1/1\n")
                        .mesh;
  ASSERT_EQ(mesh.triangles.size(), 2);
  for (std::size_t t = 0; t < 2; ++t) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec3& p = mesh.positions[mesh.triangles[t][i]];
      EXPECT_EQ(mesh.uvs.at(mesh.uv_corners[t][i]), glm::vec2(p.x, 1 - p.y));
    }
  }
}

TEST(Uvs, MaterialsOfObjAreNumberedByFirstUse) {
  const MeshFile file = open_with_uvs(
      "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl a a\nf 1 2 3\nusemtl b\nf 3 2 1\n");
  EXPECT_THAT(file.contents.materials, ElementsAre("b", "a a"));
  EXPECT_THAT(file.mesh.materials, ElementsAre(kNoMaterial, 0u, 1u, 0u));
  EXPECT_TRUE(file.mesh.uv_corners.empty());
}

std::string ply_text(const std::string& vertex_properties, const std::string& face_properties, const std::string& data,
                     const std::string& comments = "") {
  return "ply\nformat ascii 1.0\n" + comments +
         "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + vertex_properties +
         "element face 1\nproperty list uchar int vertex_indices\n" + face_properties + "end_header\n" + data;
}

TEST(Uvs, OfPlyVerticesHaveSeveralNames) {
  for (const auto& [u, v] : {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v")}) {
    const std::string properties = std::string("property float ") + v + "\nproperty double " + u + "\n";
    const Mesh mesh =
        open_with_uvs("a.ply", ply_text(properties, "", "0 0 0 0.25 1\n1 0 0 0 2\n1 1 0 1 3\n3 2 1 0\n")).mesh;
    EXPECT_THAT(uvs_of(mesh, 0), ElementsAre(glm::vec2(3, 0), glm::vec2(2, 1), glm::vec2(1, 0.75f))) << u;
  }
  EXPECT_TRUE(open_with_uvs("a.ply", ply_text("property float s\n", "", "0 0 0 1\n1 0 0 1\n1 1 0 1\n3 0 1 2\n"))
                  .mesh.uvs.empty())
      << "half of it is none";
}

TEST(Uvs, OfPlyFacesGoBeforeThoseOfVertices) {
  const std::string lists = "property list uchar float texcoord\nproperty int texnumber\n";
  const std::string textures = "comment TextureFile a.png\ncomment TextureFile the second.png\n";
  const MeshFile file =
      open_with_uvs("a.ply", ply_text("property float s\nproperty float t\n", lists,
                                      "0 0 0 9 9\n1 0 0 9 9\n1 1 0 9 9\n3 0 1 2 6 0 1 0.5 1 1 0 1\n", textures));
  EXPECT_THAT(uvs_of(file.mesh, 0), ElementsAre(glm::vec2(0, 0), glm::vec2(0.5f, 0), glm::vec2(1, 1)));
  EXPECT_THAT(file.contents.materials, ElementsAre("a.png", "the second.png"));
  EXPECT_THAT(file.mesh.materials, ElementsAre(1u));

  const MeshFile bad =
      open_with_uvs("a.ply", ply_text("", lists, "0 0 0\n1 0 0\n1 1 0\n3 0 1 2 4 0 1 0.5 1 7\n", textures));
  EXPECT_TRUE(bad.mesh.uvs.empty()) << "two numbers are missing";
  EXPECT_THAT(bad.mesh.materials, ElementsAre(kNoMaterial));
}

TEST(Uvs, OfOffStandLast) {
  const std::string face = "3 0 1 2\n";
  const Mesh plain = open_with_uvs("a.off", "STOFF 3 1 0\n0 0 0 0.5 1\n1 0 0 1 1\n1 1 0 0 0.25\n" + face).mesh;
  EXPECT_THAT(uvs_of(plain, 0), ElementsAre(glm::vec2(0.5f, 0), glm::vec2(1, 0), glm::vec2(0, 0.75f)));
  const Mesh coloured =
      open_with_uvs("a.off", "STCOFF\n3 1 0\n0 0 0 9 9 9 0.5 1\n1 0 0 9 9 9 9 1 1\n1 1 0 0 0.25\n" + face).mesh;
  EXPECT_THAT(uvs_of(coloured, 0), ElementsAre(glm::vec2(0.5f, 0), glm::vec2(1, 0), glm::vec2(0, 0.75f)));
  const Mesh in_one_line =
      open_with_uvs("a.off", "STCOFF 3 1 0 0 0 0 9 9 9 9 0.5 1 1 0 0 9 9 9 9 1 1 1 1 0 9 9 9 9 0 0.25 3 0 1 2").mesh;
  EXPECT_THAT(uvs_of(in_one_line, 0), ElementsAre(glm::vec2(0.5f, 0), glm::vec2(1, 0), glm::vec2(0, 0.75f)));
  EXPECT_TRUE(open_with_uvs("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n1 1 0\n" + face).mesh.uvs.empty());
}

}  // namespace
}  // namespace lkao::scene
