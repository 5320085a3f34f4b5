// lkao bake --texture: maps as images, by material and UDIM tile, and what is said of texture coordinates.
#include <cmath>

#include <fmt/format.h>

#include "cli/program.h"
#include "image/image.h"

namespace lkao::test {
namespace {

// A floor of 2 x 2 at y = 0 that shows the whole texture, and a wall of 1 on its edge at x = -1 without any. v is up.
const char* const kFloorAndWall =
    "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 1 -1\nv -1 1 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl floor\nf 1/1 4/4 3/3 2/2\nusemtl wall\nf 1 5 6 4\n";

class Texture : public ProgramTest {
 protected:
  Arguments bake(const std::string& scene, const std::string& output, const Arguments& more = {}) const {
    Arguments arguments = {"bake",      path(scene), "-o",     path(output),     "--radius", "inf",
                           "--texture", "16",        "--json", path("out.json"), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  image::Image image(const std::string& name) const { return image::read_image(path(name)); }
};

TEST_F(Texture, AFloorIsDarkAtItsWall) {
  write_file("floor.obj", kFloorAndWall);
  expect_success(bake("floor.obj", "ao.exr", {"--samples", "1024"}));
  const image::Image map = image("ao.exr");
  ASSERT_EQ(map.width, 16);
  const auto visibility = [&](int x, int y) {
    return map.pixels[static_cast<std::size_t>((y * 16 + x) * map.channel_count() + map.channel("visibility"))];
  };
  for (int y = 6; y < 10; ++y) {
    // A wall of height h at distance d, as if it had no end: 1/2 (1 - d / sqrt(d^2 + h^2)) of the sky.
    for (const int x : {0, 2, 5}) {
      const double d = (x + 0.5) / 8;
      EXPECT_NEAR(1 - visibility(x, y), 0.5 * (1 - d / std::hypot(d, 1.0)), x == 0 ? 0.02 : 0.08) << x << ' ' << y;
    }
    for (int x = 1; x < 16; ++x) EXPECT_GE(visibility(x, y), visibility(x - 1, y) - 0.02f);
  }
  EXPECT_EQ(read_json("out.json")["materials"][0]["covered_texels"], 256);
  EXPECT_EQ(read_json("out.json")["materials"].size(), 1u) << "the wall has no texture coordinates";
}

TEST_F(Texture, PngHasTheVisibilityLinear) {
  write_file("floor.obj", kFloorAndWall);
  expect_success(bake("floor.obj", "ao.exr"));
  expect_success(bake("floor.obj", "ao.png"));
  const image::Image fine = image("ao.exr"), coarse = image("ao.png");
  EXPECT_EQ(coarse.channel_count(), 1);
  for (int i = 0; i < 16; ++i) {
    const auto pixel = static_cast<std::size_t>(16 * i + i);
    const auto stride = static_cast<std::size_t>(fine.channel_count());
    const float visibility = fine.pixels[pixel * stride + static_cast<std::size_t>(fine.channel("visibility"))];
    EXPECT_NEAR(coarse.pixels[pixel], visibility, 0.51 / 255);
  }
}

TEST_F(Texture, EachMaterialHasItsMap) {
  write_file("two.obj",
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 0 1 5\nvt 0 0\nvt 1 0\nvt 0 1\n"
             "usemtl a/b\nf 1/1 2/2 3/3\nusemtl c\nf 4/1 5/2 6/3\n");
  expect_success(bake("two.obj", "ao.png"));
  EXPECT_EQ(files(), (std::vector<std::string>{"ao.a_b.png", "ao.c.png", "out.json", "two.obj"}));
  EXPECT_EQ(read_json("out.json")["materials"][0]["name"], "a/b");
  expect_success(bake("two.obj", "one.png", {"--material", "c"}));
  EXPECT_TRUE(read_file("one.png") == read_file("ao.c.png"));
  expect_rejected(bake("two.obj", "x.png", {"--material", "d"}), {"--material", "'d'", "a/b, c"});

  // Together they lie over each other, which is said.
  const ProgramResult shared = run_program(bake("two.obj", "shared.png", {"--shared-map"}));
  EXPECT_EQ(shared.exit_code, 0);
  EXPECT_NE(shared.err.find("overlap"), std::string::npos) << shared.err;
  EXPECT_GT(read_json("out.json")["materials"][0]["overlapping_texels"], 100);
}

TEST_F(Texture, UdimTilesHaveFilesOfTheirOwn) {
  write_file("udim.obj",
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 0 1 5\nvt 0.1 0.1\nvt 0.9 0.1\nvt 0.1 0.9\n"
             "vt 1.1 2.1\nvt 1.9 2.1\nvt 1.1 2.9\nf 1/1 2/2 3/3\nf 4/4 5/5 6/6\n");
  expect_success(bake("udim.obj", "ao.png", {"--udim"}));
  EXPECT_EQ(files(), (std::vector<std::string>{"ao.1001.png", "ao.1022.png", "out.json", "udim.obj"}));
}

TEST_F(Texture, BentNormals) {
  write_file("floor.obj", kFloorAndWall);
  expect_success(bake("floor.obj", "ao.png", {"--bent-normals", "object"}));
  const image::Image bent = image("ao.bent.png");
  const auto pixel = static_cast<std::size_t>(8 * 16 + 0) * 3;
  EXPECT_GT(bent.pixels[pixel], 0.6f) << "away from the wall";
  EXPECT_GT(bent.pixels[pixel + 1], 0.8f) << "up";
  expect_success(bake("floor.obj", "ao.exr", {"--bent-normals", "tangent"}));
  EXPECT_GE(image("ao.exr").channel("bent.Z"), 0);
}

// A flat square, whose detailed form has a pit: a box without a lid, half a unit deep.
TEST_F(Texture, OfADetailedMesh) {
  write_file("flat.obj", "v 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 4/4 3/3 2/2\n");
  std::string pit = "v 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nv 1 0 1\nv 3 0 1\nv 3 0 3\nv 1 0 3\n";
  pit += "v 1 -.5 1\nv 3 -.5 1\nv 3 -.5 3\nv 1 -.5 3\nf 9 12 11 10\n";
  for (const char* sides :
       {"f 1 5 6 2\nf 5 9 10 6\n", "f 2 6 7 3\nf 6 10 11 7\n", "f 3 7 8 4\nf 7 11 12 8\n", "f 4 8 5 1\nf 8 12 9 5\n"}) {
    pit += sides;
  }
  write_file("pit.obj", pit);
  expect_success(bake("flat.obj", "ao.exr", {"--detailed", path("pit.obj"), "--extrusion", "0.6"}));
  const image::Image map = image("ao.exr");
  const auto visibility = [&](int x, int y) {
    return map.pixels[static_cast<std::size_t>((y * 16 + x) * map.channel_count() + map.channel("visibility"))];
  };
  EXPECT_EQ(visibility(1, 8), 1) << "beside the pit";
  EXPECT_NEAR(visibility(8, 8), 0.83, 0.03) << "in its middle";
  EXPECT_LT(visibility(5, 5), 0.8) << "in its corner";
  EXPECT_EQ(read_json("out.json")["materials"][0]["missed_points"], 0);
  expect_rejected(bake("flat.obj", "ao.exr", {"--detailed", path("pit.obj"), "--ground"}), {"--ground"});
  expect_rejected(bake("flat.obj", "ao.exr", {"--detailed", path("no.obj")}), {"no.obj"});
  expect_rejected(bake("flat.obj", "ao.exr", {"--extrusion", "1"}), {"--detailed"});
}

TEST_F(Texture, StrengthAndContrastAreAskedFor) {
  write_file("floor.obj", kFloorAndWall);
  expect_success(bake("floor.obj", "a.exr"));
  expect_success(bake("floor.obj", "b.exr", {"--strength", "2", "--contrast", "1.5"}));
  const image::Image a = image("a.exr"), b = image("b.exr");
  const auto channel = static_cast<std::size_t>(a.channel("visibility"));
  const auto index = static_cast<std::size_t>(8 * 16 + 2) * static_cast<std::size_t>(a.channel_count()) + channel;
  EXPECT_NEAR(1 - b.pixels[index], std::min(1.0, 2 * std::pow(1 - a.pixels[index], 1.5)), 1e-5);
}

TEST_F(Texture, PartsAreTheWhole) {
  write_file("floor.obj", kFloorAndWall);
  const Arguments more = {"--bent-normals", "object"};
  expect_success(bake("floor.obj", "ao.exr", more));
  const std::string whole = read_file("ao.exr");
  std::filesystem::remove(path("ao.exr"));
  for (const char* part : {"2/2", "1/2"}) {
    expect_success(bake("floor.obj", "ao.exr", {"--bent-normals", "object", "--part", part}));
  }
  expect_success({"merge", path("ao.exr.1of2.part"), path("ao.exr.2of2.part"), "--quiet"});
  EXPECT_TRUE(read_file("ao.exr") == whole);
}

TEST_F(Texture, WhatCannotBeIsRefused) {
  write_file("floor.obj", kFloorAndWall);
  write_file("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_rejected(bake("bare.obj", "ao.png"), {"bare.obj", "texture coordinates"});
  expect_rejected(bake("floor.obj", "ao.png", {"--uv", "1"}), {"floor.obj", "texture coordinates"});
  expect_rejected(bake("floor.obj", "ao.ply"), {"--output", ".png"});
  expect_rejected(bake("floor.obj", "ao.glb"), {"--output", "floor.obj"});
  expect_rejected(bake("floor.obj", "nowhere/ao.png"), {"nowhere"});
  expect_rejected(bake("floor.obj", "ao.png", {"--per", "face"}), {"--per"});
  for (const char* size : {"0", "x", "16x", "40000", "-1", "16x16x16"}) {
    Arguments arguments = {"bake", path("floor.obj"), "-o", path("ao.png"), "--radius", "1", "--texture", size};
    expect_rejected(arguments, {"--texture"});
  }
  expect_rejected({"bake", path("floor.obj"), "-o", path("ao.ply"), "--radius", "1", "--margin", "4"}, {"--texture"});
}

}  // namespace
}  // namespace lkao::test
