// OBJ as programs write it.
#include <gtest/gtest.h>

#include "alpha_files.h"
#include "scene/defects.h"
#include "scene/files.h"

namespace lkao::scene::obj_test {
namespace {

using Corners = std::vector<glm::vec3>;

const Corners kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class Obj : public testing::Test {
 protected:
  MeshFile open(const std::string& text, const ReadOptions& options = {}) const {
    return open_mesh_file(folder_.write("a.obj", text), options);
  }
  Mesh read(const std::string& text) const { return open(text).mesh; }
  void refuse(const std::string& text, const std::string& fault) const {
    expect_refused(folder_.write("a.obj", text), fault);
  }

  const TemporaryFolder folder_;
};

TEST_F(Obj, FacesNameTheirVerticesByNumber) {
  const Mesh mesh =
      read(kPoints + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -4 -3 -2\nf 1 1 2\nl 1 2\np 3\nf 1 2\n");
  EXPECT_EQ(mesh.positions, kSquare);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 0, 1}}));
}

TEST_F(Obj, VerticesKeepTheirNumbersUsedOrNot) {
  const Mesh mesh = read("v 9 9 9\n" + kPoints + "v 0 0 0\nf 2 3 4\nf 6 4 5\n");
  EXPECT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.positions[0], glm::vec3(9));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{1, 2, 3}, {5, 3, 4}}));
}

TEST_F(Obj, TrianglesOfAllGroupsAreKept) {
  std::string text;
  for (int i = 0; i < 300; ++i) {
    const std::string x = std::to_string(i);
    text += "o part" + x + "\ng g" + x + "\nusemtl m" + std::to_string(i % 3) + "\nv " + x + " 0 0\nv " + x +
            " 1 0\nv " + x + " 0 1\nf -3 -2 -1\n";
  }
  const Mesh mesh = read(text);
  EXPECT_EQ(mesh.triangles.size(), 300u);
  EXPECT_EQ(mesh.positions.size(), 900u);
}

TEST_F(Obj, LinesMayLookLikeAnything) {
  for (const std::string text : {
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n",
           "\xef\xbb\xbfv 0 0 0\rv 1 0 0\rv 1 1 0\rf 1 2 3",
           "v 0 0 0\r\nv 1 0 0\r\n\r\nv 1 1 0\r\nf 1 2 3\r\n",
           "v 0 0 0\nv 1 0 0\rv 1 1 0\r\nf 1 2 3",
           "# v 7 7 7\n  v 0 0 0\n\tv 1 0 0 # v 7 7 7\n \t v\t1  1\t0\t\n  f 1 2 3#4\n",
           "v .0 -.0 0.\nv 1e0 +0 0E+5\nv +1. 1.0e+00 .0e3\nfo 1 2 3\n",
           "v 0 \\\n0 0\nv 1 0\\\r\n 0\nv 1 1 \\ \n \\\n 0\nf 1 2\\\n 3\n",
           "# C:\\\nv 0 0 0\nmtllib C:\\\nv 1 0 0\ng a\\\nv 1 1 0\nusemtl b\\\nf 1 2 3\n",
           "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 1 0 0 1\nf 1 2 3\n",
           "v 0 0 0 7 red\nv 1 0 0 -nan(ind)\nv 1 1 0 #\nf 1 2 3\n",
           "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\n",
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt\nvt 0\nvt 0 0\nvt 0 0 0\nvt x\nvp 1\nhello\n3 4\nf 1/1/ 2/9 3/\n",
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1// 2/0/0 3//-9\n",
       }) {
    const Mesh mesh = read(text);
    EXPECT_EQ(mesh.positions, (Corners{kSquare[0], kSquare[1], kSquare[2]})) << text;
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}})) << text;
  }
}

TEST_F(Obj, ManyCornersMakeOnePolygon) {
  std::string text;
  std::string face = "f";
  for (int i = 1; i <= 2000; ++i) {
    text += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
    face += " " + std::to_string(i);
  }
  EXPECT_EQ(read(text + face + "\n").triangles.size(), 1998u);
}

TEST_F(Obj, NanVerticesAreNeitherJoinedNorLost) {
  const Mesh mesh = read("v nan 0 0\nv 1 0 0\nv 1 1 0\nv -1.#IND 0 0\nf 1 2 3\nf 4 2 3\nf 3 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(find_defects(mesh).non_finite_count, 2u);
}

TEST_F(Obj, PositionsAreReadInDouble) {
  const Mesh mesh = read("v 5413678.16 448262.32 0\nv 5413678.17 448262.32 0\nv 5413678.16 448262.33 0\nf 1 2 3\n");
  EXPECT_NEAR(mesh.positions[1].x - mesh.positions[0].x, 0.01, 1e-8);
  EXPECT_NEAR(mesh.positions[0].x + mesh.origin.x, 5413678.16, 1e-8);
}

TEST_F(Obj, NormalsBelongToCorners) {
  const Mesh mesh = read(kPoints + "f 1 2 3\nf 1//1 2//2 3\nvn 0 0 2\nvn nothing\nvn 3 0 0\nf 1/7/-1 2//3 3//1 4//9\n");
  ASSERT_EQ(mesh.normal_corners.size(), mesh.triangles.size());
  EXPECT_EQ(mesh.normal_corners[0], glm::uvec3(kNoNormal));
  EXPECT_EQ(mesh.normal_corners[1], glm::uvec3(0, kNoNormal, kNoNormal));
  EXPECT_EQ(mesh.normal_corners[2], glm::uvec3(2, 2, 0));
  EXPECT_EQ(mesh.normal_corners[3], glm::uvec3(2, 0, kNoNormal));
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_TRUE(read(kPoints + "f 1//1 2//1 3//1\n").normal_corners.empty());
}

TEST_F(Obj, FaultsAreNamedWithTheirLine) {
  refuse(kPoints + "f 1 2 9\n", "line 5: vertex 9 is out of range: there are 4");
  refuse("f 1 2 3\nf 1 2 9\n" + kPoints, "line 2: vertex 9 is out of range: there are 4");
  refuse(kPoints + "f 1 2 -9\nv 1 1 1\n", "line 5: vertex -9 is out of range: there are 4 so far");
  refuse(kPoints + "f 1 2 0\n", "line 5: vertex 0 is out of range");
  refuse(kPoints + "f 1 2 99999999999999999999\n", "line 5: vertex 9223372036854775807 is out of range");
  refuse("v 0 0 0\r\n\r\nv 1 0\r\n", "line 3: a vertex has 2 of 3 coordinates");
  refuse("v 0 0 0\rv 1 0 x\r", "line 2: \"x\" is not a number");
  refuse("v 0 0 1,5\n", "line 1: \"1,5\" is not a number");
  refuse(kPoints + "f 1 2 /3\n", "line 5: \"/3\" is not a corner of a face");
  refuse(kPoints + "f 1 2 3/1/1/1\n", "line 5: \"3/1/1/1\" is not a corner of a face");
  refuse(kPoints + "f 1 2 3" + std::string(1, '\0'), "it is not text");
  refuse(kPoints, "no triangles");
  refuse(kPoints + "l 1 2\n", "no triangles");
}

TEST_F(Obj, SurfacesThatAreLeftOutAreSaid) {
  const Contents contents =
      open(kPoints + "vt 0\nf 1 2 3\ncstype bspline\nsurf 0 1 0 1 1 2 3 4\nsurf 0 1\nend\n").contents;
  EXPECT_EQ(contents.remarks, std::vector<std::string>{"2 free-form surfaces are left out"});
  EXPECT_EQ(contents.uv_set_count, 1u);
  EXPECT_TRUE(open(kPoints + "f 1 2 3\n").contents.remarks.empty());
}

TEST_F(Obj, HolesByTransparencyAreSaid) {
  folder_.write("of trees.mtl",
                "newmtl leaves # of oaks\r\nKd 1 1 1\r\nmap_d a.png\r\nnewmtl bark\r\nd 1\r\nd x\r\nTr 1\r\n");
  folder_.write("glass.mtl", "\xef\xbb\xbfnewmtl pane 1#2\nd -halo 0.5\nnewmtl other\nTr .2\n");
  const Contents contents = open("mtllib of trees.mtl\nmtllib missing.mtl glass.mtl\n" + kPoints +
                                 "f 1 2 3\nusemtl leaves\nf 1 2 3 4\nusemtl bark\nf 1 2 3\nusemtl  pane 1#2\t# thin\n"
                                 "f 1 2 3\nusemtl leaves\nf 1 2 3\n")
                                .contents;
  EXPECT_EQ(contents.cut_out_count, 4u);
  EXPECT_EQ(
      contents.remarks,
      (std::vector<std::string>{"material \"leaves\" has holes by transparency: its 3 triangles block as if whole",
                                "material \"pane 1#2\" has holes by transparency: its 1 triangles block as if whole"}));
}

// A quad, cut in two, with a mask that leaves its left half; what has no holes; and a pane.
TEST_F(Obj, HolesAreReadWhereTheyAreAskedFor) {
  folder_.write("the mask.img", alpha_file(2, 1, {'\xff', '\0'}));
  folder_.write("a.mtl",
                "newmtl leaf\nmap_d -s 1 1 1 -mm 0 1 -clamp on -imfchan m the mask.img\nnewmtl bark\nd 1\n"
                "newmtl pane\nTr 0.75\nmap_d the mask.img\n");
  const std::string text = "mtllib a.mtl\n" + kPoints + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl bark\nf 1 2 3\n" +
                           "usemtl leaf\nf 1/1 2/2 3/3 4/4\nusemtl pane\nf 1/1 2/9 3\n";
  const MeshFile file =
      open_mesh_file(folder_.write("a.obj", text), {.decode_alpha = [](auto name, auto bytes, AlphaOf what) {
                       EXPECT_EQ(what, AlphaOf::alpha_or_grey);
                       return decode_alpha_file(name, bytes);
                     }});
  ASSERT_NE(file.mesh.holes, nullptr);
  const Holes& holes = *file.mesh.holes;
  EXPECT_EQ(holes.numbers, (std::vector<std::uint32_t>{kWhole, 0, 1, 2}));
  EXPECT_TRUE(file.mesh.uvs.empty());
  EXPECT_TRUE(file.mesh.materials.empty());
  for (const std::size_t triangle : {1u, 2u}) {
    const glm::uvec3& corners = file.mesh.triangles[triangle];
    for (int i = 0; i < 60; ++i) {
      const glm::dvec2 place(0.1 + 0.1 * (i % 8), 0.1 * (i / 8));  // NOLINT(bugprone-integer-division)
      if (place.x + place.y >= 1) continue;
      const double x = (1 - place.x - place.y) * double{file.mesh.positions[corners.x].x} +
                       place.x * double{file.mesh.positions[corners.y].x} +
                       place.y * double{file.mesh.positions[corners.z].x};
      if (x > 0.24 && x < 0.76) continue;
      EXPECT_EQ(holes.blocks(triangle, glm::vec2(place)), x < 0.5) << x;
    }
  }
  // Corners without texture coordinates are at 0, the image's corner, which is smooth across its borders here.
  EXPECT_NEAR(holes.alpha(3, {0.3, 0.3}), 0.25 * 0.5, 1e-6);
  EXPECT_EQ(holes.materials[0].texture->wraps, (TextureWraps{TextureWrap::clamp, TextureWrap::clamp}));
  EXPECT_EQ(file.contents.cut_out_count, 3u);
  ASSERT_EQ(file.contents.remarks.size(), 2u);
  EXPECT_EQ(
      file.contents.remarks[0],
      "material \"leaf\" is half-transparent: its 2 triangles block each ray with the probability of their alpha");
  EXPECT_EQ(open(text).mesh.holes, nullptr);
}

TEST_F(Obj, MapsOfHolesMayBeScaledAndMoved) {
  folder_.write("mask.img", alpha_file(2, 1, {'\xff', '\0'}));
  folder_.write("a.mtl",
                "newmtl leaf\nmap_d -s 2 -1 -o 0.25 1.5 mask.img\nnewmtl other\nmap_d -o 3 mask.img\n"
                "newmtl last\nmap_d mask.img\n");
  const std::string text = "mtllib a.mtl\n" + kPoints + "vt 0 0\nvt 1 0\nvt 0 1\n";
  const std::string face = "f 1/1 2/2 3/3\n";
  const MeshFile file =
      open(text + "usemtl leaf\n" + face + "usemtl last\n" + face + "usemtl other\nf 1 2/2 3\n" + face,
           {.decode_alpha = decode_alpha_file});
  ASSERT_NE(file.mesh.holes, nullptr);
  using Uvs = std::array<glm::vec2, 3>;
  const std::vector<HoleTriangle>& triangles = file.mesh.holes->triangles;
  ASSERT_EQ(triangles.size(), 4u);
  EXPECT_EQ(triangles[0].uvs, (Uvs{glm::vec2(0.25f, -0.5f), glm::vec2(2.25f, -0.5f), glm::vec2(0.25f, 0.5f)}));
  EXPECT_EQ(triangles[1].uvs, (Uvs{glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(0, 0)}));
  EXPECT_EQ(triangles[2].uvs, (Uvs{glm::vec2(0), glm::vec2(4, 1), glm::vec2(0)}));
  EXPECT_EQ(triangles[3].uvs, (Uvs{glm::vec2(3, 1), glm::vec2(4, 1), glm::vec2(3, 0)}));
  EXPECT_EQ(file.contents.remarks.size(), 3u);  // that each is half-transparent
}

TEST_F(Obj, OptionsOfMapsThatAreNotObeyedAreSaid) {
  folder_.write("mask.img", alpha_file(2, 1, {'\xff', '\0'}));
  folder_.write("a.mtl",
                "newmtl a\nmap_d -mm 0 2 -t 0 0.1 -blendu off mask.img\nnewmtl b\nmap_d -imfchan r mask.img\n"
                "newmtl c\nmap_d -mm 0 1 -t 0 0 0 -imfchan m mask.img\nnewmtl unused\nmap_d -mm 1 1 mask.img\n");
  const std::string text = "mtllib a.mtl\n" + kPoints + "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n";
  const MeshFile file = open(text, {.decode_alpha = decode_alpha_file});
  ASSERT_EQ(file.contents.remarks.size(), 4u);
  EXPECT_EQ(file.contents.remarks[0], "map_d: -mm, -t of material \"a\" and of 1 more are not obeyed");
}

TEST_F(Obj, ImagesOfHolesThatCannotBeReadAreSaid) {
  folder_.write("short.img", "x");
  folder_.write("a.mtl", "newmtl a\nmap_d no.img\nnewmtl b\nmap_d short.img\nd 0.5\nnewmtl c\nmap_d no.img\n");
  const MeshFile file =
      open("mtllib a.mtl\n" + kPoints + "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n", {.decode_alpha = decode_alpha_file});
  EXPECT_EQ(
      file.contents.remarks,
      (std::vector<std::string>{
          "cannot read 'no.img': there is no such file: it counts as opaque, in material \"a\"",
          "cannot read 'short.img': it is short: it counts as opaque, in material \"b\"",
          "material \"b\" is half-transparent: its 1 triangles block each ray with the probability of their alpha"}));
  ASSERT_NE(file.mesh.holes, nullptr);
  EXPECT_EQ(file.mesh.holes->numbers, (std::vector<std::uint32_t>{kWhole, 0}));
  EXPECT_EQ(file.mesh.holes->alpha(1, {0.5, 0.2}), 0.5);
}

TEST_F(Obj, ObjectsAreWhatStandsUnderOneName) {
  const auto objects = [&](const std::string& text) {
    return open_mesh_file(folder_.write("a.obj", kPoints + text), {.objects = true});
  };
  const std::string groups = "g a\nf 1 2 3\ng b\nf 1 2 3 4\ng a\nf 1 2 3\n";
  EXPECT_EQ(objects(groups).mesh.objects, (std::vector<std::uint32_t>{1, 2, 2, 1}));
  EXPECT_EQ(objects("f 1 2 3\no x\n" + groups + "o y\nf 2 3 4\n").mesh.objects,
            (std::vector<std::uint32_t>{0, 1, 1, 1, 1, 2}));
  EXPECT_EQ(objects(groups).contents.object_count, 3u);
  EXPECT_TRUE(objects("f 1 2 3\n").mesh.objects.empty());
  EXPECT_TRUE(open(kPoints + groups).mesh.objects.empty());
}

TEST_F(Obj, MaterialFilesAreNoReasonToRefuse) {
  folder_.write("a.mtl", std::string("newmtl \0\xff\nd\nd nothing\nmap_d\nTr\naniso 0.7\nnewmtl", 47));
  EXPECT_EQ(open("mtllib a.mtl\nmtllib\nmtllib .\nmtllib /dev/zero\nusemtl\n" + kPoints + "f 1 2 3\n")
                .contents.remarks.size(),
            0u);
}

}  // namespace
}  // namespace lkao::scene::obj_test
