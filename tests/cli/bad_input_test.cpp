// Bad input of every kind: one line, exit code 2, no file.
#include <filesystem>
#include <limits>

#include "cli/program.h"
#include "cli/small_mesh.h"

namespace lkao::test {
namespace {

class BadInput : public ProgramTest {
 protected:
  // A rendering that would be good, with `more` behind it.
  Arguments render(const std::string& scene, const Arguments& more = {}) const {
    Arguments arguments = {"render", scene, "-o", path("out.exr"), "--size", "8x6", "--json", path("out.json")};
    if (more.empty() || more.front() != "--radius") arguments.insert(arguments.end(), {"--radius", "1"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Arguments bake(const std::string& scene) const {
    return {"bake", scene, "-o", path("out.ply"), "--radius", "1", "--samples", "64"};
  }
  // By every subcommand that computes.
  void expect_scene_rejected(const std::string& scene, const std::vector<std::string>& words) const {
    expect_rejected(render(scene), words);
    expect_rejected(bake(scene), words);
  }
};

TEST_F(BadInput, UnknownSubcommand) { expect_rejected({"paint", "x.ply"}, {"'paint'", "render, bake, compare, info"}); }
TEST_F(BadInput, UnknownOption) {
  expect_rejected(render("builtin:wall", {"--shiny"}), {"--shiny"});
  expect_rejected({"--shiny"}, {"--shiny"});
}
TEST_F(BadInput, SurplusArgument) { expect_rejected(render("builtin:wall", {"another.ply"}), {"another.ply"}); }
TEST_F(BadInput, OptionWithoutValue) { expect_rejected(render("builtin:wall", {"--samples"}), {"--samples"}); }
TEST_F(BadInput, OptionGivenTwice) {
  expect_rejected(render("builtin:wall", {"--seed", "1", "--seed", "2"}), {"--seed"});
}

TEST_F(BadInput, MissingScene) {
  expect_rejected({"render", "-o", path("out.exr"), "--radius", "1"}, {"scene is required"});
  expect_rejected({"bake", "-o", path("out.ply"), "--radius", "1"}, {"scene is required"});
}
TEST_F(BadInput, MissingOutput) { expect_rejected({"render", "builtin:wall", "--radius", "1"}, {"--output"}); }
TEST_F(BadInput, MissingRadiusSuggestsSome) {
  expect_rejected({"render", "builtin:wall", "-o", path("out.exr")}, {"--radius is required", "(small)", "(large)"});
  expect_rejected({"bake", "builtin:wall", "-o", path("out.ply")}, {"--radius is required", "(small)", "(large)"});
}

TEST_F(BadInput, Radius) {
  for (const char* radius : {"0", "-1", "nan", "-inf", "1e999", "", "0%", "inf%", "5 %"}) {
    expect_rejected(render("builtin:wall", {"--radius", radius}), {"--radius", "above 0, or inf"});
  }
}
TEST_F(BadInput, InfiniteRadiusOfRaysOfSeveralLengthsInATable) {
  for (const char* kernel : {"table", "nearest"}) {
    const Arguments more = {"--radius", "inf", "--falloff", "linear", "--kernel", kernel};
    expect_rejected(render("builtin:wall", more), {"--radius inf", "--falloff linear", kernel});
    Arguments bake = {"bake", "builtin:wall", "-o", path("out.ply")};
    bake.insert(bake.end(), more.begin(), more.end());
    expect_rejected(bake, {"--radius inf", "--falloff linear", kernel});
  }
}
TEST_F(BadInput, SampleCount) {
  for (const char* samples : {"0", "-64", "1025", "64.5"}) {
    expect_rejected(render("builtin:wall", {"--samples", samples}), {"--samples", "from 1 to 1024"});
  }
}
TEST_F(BadInput, Weighting) {
  expect_rejected(render("builtin:wall", {"--weighting", "even"}), {"--weighting", "cosine or uniform", "even"});
}
TEST_F(BadInput, MinDistance) {
  expect_rejected(render("builtin:wall", {"--min-distance", "-1"}), {"--min-distance", "at least 0"});
  expect_rejected(render("builtin:wall", {"--min-distance", "1e6"}), {"min_distance", "less than the radius"});
}
TEST_F(BadInput, Size) {
  for (const char* size : {"0x6", "8x0", "8", "99999x99999"}) {
    const Arguments arguments = {"render", "builtin:wall", "-o", path("out.exr"), "--radius", "1", "--size", size};
    expect_rejected(arguments, {"--size", size});
  }
}
TEST_F(BadInput, Threads) {
  for (const char* threads : {"0", "-1"}) {
    expect_rejected(render("builtin:wall", {"--threads", threads}), {"--threads", threads});
  }
}
TEST_F(BadInput, Choices) {
  expect_rejected(render("builtin:wall", {"--falloff", "cubic"}), {"--falloff", "cubic", "smooth"});
  expect_rejected(render("builtin:wall", {"--sided", "both"}), {"--sided", "both"});
  expect_rejected(render("builtin:wall", {"--method", "gpu"}), {"--method", "gpu", "bvh or embree or raster"});
}
TEST_F(BadInput, Camera) {
  expect_rejected(render("builtin:wall", {"--eye", "1,2,3", "--target", "1,2,3"}), {"--eye", "--target", "same"});
  expect_rejected(render("builtin:wall", {"--eye", "0,1,0", "--target", "0,0,0"}), {"up"});
  expect_rejected(render("builtin:wall", {"--up", "0,0,0"}), {"up"});
  expect_rejected(render("builtin:wall", {"--eye", "1,2"}), {"--eye", "1,2"});
  expect_rejected(render("builtin:wall", {"--eye", "0,0,1e999"}), {"--eye"});
  expect_rejected(render("builtin:wall", {"--fov", "180"}), {"--fov", "180"});
}

TEST_F(BadInput, MissingFile) { expect_scene_rejected(path("nowhere.ply"), {"nowhere.ply"}); }
TEST_F(BadInput, Directory) {
  std::filesystem::create_directory(path("folder.ply"));
  expect_scene_rejected(path("folder.ply"), {"folder.ply", "directory"});
}
TEST_F(BadInput, UnsupportedType) {
  expect_scene_rejected(write_file("scene.txt", "not a mesh\n"), {"scene.txt"});
  expect_scene_rejected(write_file("scene", "not a mesh\n"), {"scene"});
}
TEST_F(BadInput, EmptyFile) {
  for (const char* name : {"a.ply", "a.obj", "a.stl", "a.off", "a.gltf", "a.glb"}) {
    expect_rejected(render(write_file(name, "")), {name});
  }
}
TEST_F(BadInput, TruncatedMesh) {
  const std::string whole = roofed_square_ply();
  for (const std::size_t size : {whole.size() - 1, whole.size() - 20, whole.size() / 2, std::size_t{10}}) {
    expect_rejected(render(write_file("short.ply", whole.substr(0, size))), {"short.ply"});
  }
}
TEST_F(BadInput, IndexOutOfRange) {
  expect_scene_rejected(write_file("wild.ply", ply_bytes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 7}})),
                        {"wild.ply"});
}
TEST_F(BadInput, NoTriangles) {
  expect_scene_rejected(write_file("points.ply", ply_bytes({{0, 0, 0}, {1, 0, 0}}, {})), {"points.ply"});
}
TEST_F(BadInput, NoTrianglesLeft) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string bytes =
      ply_bytes({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {nan, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 0, 4}});
  expect_scene_rejected(write_file("bad.ply", bytes), {"bad.ply", "no triangles left", "2 zero-area", "1 non-finite"});
}
TEST_F(BadInput, UnknownBuiltinScene) { expect_scene_rejected("builtin:castle", {"castle", "wall"}); }

TEST_F(BadInput, UnwritableOutput) {
  write_file("file", "");
  std::filesystem::create_directory(path("folder.exr"));
  // "/proc" can be written to by nobody, not even by root.
  for (const std::string& output :
       {path("no/such/out.exr"), path("file/out.exr"), path("folder.exr"), std::string("/proc/out.exr")}) {
    expect_rejected({"render", "builtin:wall", "--radius", "1", "-o", output}, {output, "write"});
  }
  expect_rejected({"bake", "builtin:wall", "--radius", "1", "-o", path("no/out.ply")}, {path("no/out.ply")});
  expect_rejected({"info", "builtin:wall", "--json", path("no/out.json")}, {path("no/out.json")});
  expect_rejected({"render", "builtin:wall", "--radius", "1", "-o", path("out.exr"), "--json", path("no/out.json")},
                  {path("no/out.json")});
}
TEST_F(BadInput, UnwritableOutputIsFoundBeforeTheSceneIsRead) {
  expect_rejected({"render", path("nowhere.ply"), "--radius", "1", "-o", path("no/out.exr")}, {path("no/out.exr")});
}
TEST_F(BadInput, UnsupportedOutputEnding) {
  for (const char* name : {"out.jpg", "out", "out.exr.txt"}) {
    expect_rejected({"render", "builtin:wall", "--radius", "1", "-o", path(name)}, {name});
  }
  expect_rejected({"bake", "builtin:wall", "--radius", "1", "-o", path("out.glb")}, {"out.glb", ".ply or .obj"});
  expect_rejected(render("builtin:wall", {"--preview", path("out.jpg")}), {"--preview", "out.jpg"});
}
TEST_F(BadInput, LayersInAPng) {
  expect_rejected({"render", "builtin:wall", "--radius", "1", "-o", path("out.png"), "--depth"}, {"out.png", ".exr"});
}
TEST_F(BadInput, OneFileForTwoOutputs) {
  expect_rejected({"render", "builtin:wall", "--radius", "1", "-o", path("a.png"), "--preview", path("./a.png")},
                  {"two outputs"});
}
TEST_F(BadInput, OutputOverInput) {
  const std::string scene = write_file("square.ply", roofed_square_ply());
  expect_rejected({"bake", scene, "--radius", "1", "-o", path("./square.ply")}, {"is an input"});
}
TEST_F(BadInput, LeavesAnOldOutputAsItWas) {
  write_file("out.exr", "an old image");
  expect_rejected(render(path("nowhere.ply")), {"nowhere.ply"});
  EXPECT_EQ(read_file("out.exr"), "an old image");
}

}  // namespace
}  // namespace lkao::test
