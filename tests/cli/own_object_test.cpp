// lkao bake --own-object: what other objects there are makes no difference.
#include "cli/program.h"
#include "cli/small_mesh.h"
#include "scene/gltf_builder.h"

namespace lkao::test {
namespace {

using scene::GltfBuilder;

// A floor of 2 x 2 at y = 0, which shows the whole texture, and a wall on its edge at x = -1.
const char* const kCorner =
    "o corner\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 1 -1\nv -1 1 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl floor\nf 1/1 4/4 3/3 2/2\nusemtl other\nf 1 5 6 4\n";
// Two roofs over it, of which each darkens the other.
const char* const kRoofs =
    "o low\nv -0.5 0.25 -0.5\nv 0.5 0.25 -0.5\nv 0.5 0.25 0.5\nv -0.5 0.25 0.5\nf 7 10 9 8\n"
    "o high\nv -0.5 0.5 -0.5\nv 0.5 0.5 -0.5\nv 0.5 0.5 0.5\nv -0.5 0.5 0.5\nf 11 14 13 12\n";

class OwnObject : public ProgramTest {
 protected:
  Arguments bake(const std::string& scene, const std::string& output, const Arguments& more = {}) const {
    Arguments arguments = {"bake", scene, "-o", path(output), "--radius", "5", "--samples", "64", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  double mean(const std::string& scene, const Arguments& more = {}) const {
    Arguments arguments = bake(scene, "mean.ply", more);
    arguments.insert(arguments.end(), {"--json", "-"});
    return nlohmann::json::parse(expect_success(arguments).out)["occlusion_mean"];
  }
};

TEST_F(OwnObject, TwoCloseBoxesAreOpen) {
  GltfBuilder parts = scene::gltf_cube();
  parts.document["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {1.25, 0, 0}}}};
  parts.document["scenes"][0]["nodes"] = {0, 1};
  const std::string model = write_file("boxes.glb", parts.glb());
  EXPECT_GT(mean(model), 0.03);
  EXPECT_EQ(mean(model, {"--own-object"}), 0);
  EXPECT_EQ(mean(model, {"--own-object", "--per", "face"}), 0);
  EXPECT_EQ(mean(model, {"--own-object", "--filter", "least-squares"}), 0);
  EXPECT_EQ(mean(model, {"--own-object", "--kernel", "table"}), 0);
}

TEST_F(OwnObject, AnObjectIsBakedAsIfItWereAlone) {
  const std::string alone = write_file("alone.obj", kCorner);
  const std::string both = write_file("both.obj", std::string(kCorner) + kRoofs);
  expect_success(bake(alone, "alone.exr", {"--texture", "16"}));
  expect_success(bake(both, "both.exr", {"--texture", "16"}));
  expect_success(bake(both, "own.exr", {"--texture", "16", "--own-object"}));
  EXPECT_EQ(read_file("own.exr"), read_file("alone.exr"));
  EXPECT_NE(read_file("both.exr"), read_file("alone.exr"));

  // Vertices of the first object, 19 bytes each.
  const auto values = [&](const std::string& scene, const char* output, const Arguments& more) {
    expect_success(bake(scene, output, more));
    const std::string bytes = read_file(output);
    return bytes.substr(bytes.find("end_header\n") + 11, 6 * 19);
  };
  EXPECT_EQ(values(both, "own.ply", {"--own-object"}), values(alone, "alone.ply", {}));
  EXPECT_NE(values(both, "both.ply", {}), values(alone, "alone.ply", {}));
}

TEST_F(OwnObject, PartsAreTheWhole) {
  const std::string scene = write_file("both.obj", std::string(kCorner) + kRoofs);
  expect_success(bake(scene, "whole.ply", {"--own-object"}));
  for (const char* const part : {"1/3", "2/3", "3/3"}) {
    expect_success(bake(scene, "out.ply", {"--own-object", "--part", part}));
  }
  expect_success({"merge", path("out.ply.1of3.part"), path("out.ply.2of3.part"), path("out.ply.3of3.part"), "--quiet"});
  EXPECT_EQ(read_file("out.ply"), read_file("whole.ply"));
}

TEST_F(OwnObject, IsRefusedWhereThereAreNone) {
  const std::string square = write_file("square.ply", roofed_square_ply());
  const std::string objects = write_file("both.obj", std::string(kCorner) + kRoofs);
  expect_rejected(bake(square, "out.ply", {"--own-object"}), {"--own-object", "square.ply names no objects"});
  expect_rejected(bake("builtin:wall", "out.ply", {"--own-object"}), {"--own-object", "builtin:wall names no objects"});
  expect_rejected(bake(objects, "out.ply", {"--own-object", "--ground"}), {"--own-object", "--ground"});
  expect_rejected(bake(objects, "out.ply", {"--own-object", "--blockers", square}), {"--own-object", "--blockers"});
  expect_rejected(bake(objects, "out.png", {"--own-object", "--texture", "16", "--detailed", square}),
                  {"--own-object", "--detailed"});
}

}  // namespace
}  // namespace lkao::test
