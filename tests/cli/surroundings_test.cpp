// --ground, --blockers and --flip: what blocks beside the scene, and files that are inside out.
#include <cmath>
#include <cstring>

#include "cli/program.h"
#include "cli/small_mesh.h"
#include "image/image.h"

namespace lkao::test {
namespace {

class Surroundings : public ProgramTest {
 protected:
  Arguments with(Arguments arguments, const Arguments& more) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Arguments bake(const std::string& scene, const Arguments& more = {}) const {
    return with(
        {"bake", scene, "-o", path("out.ply"), "--radius", "inf", "--samples", "1024", "--json", path("out.json")},
        more);
  }
  Arguments render(const std::string& scene, const Arguments& more = {}) const {
    return with({"render", scene, "-o", path("out.exr"), "--size", "32x24", "--radius", "0.8", "--samples", "64",
                 "--depth", "--json", path("out.json")},
                more);
  }
  double mean(const Arguments& arguments) const {
    expect_success(arguments);
    return read_json("out.json")["occlusion_mean"];
  }
  std::size_t seen(const Arguments& arguments) const {
    expect_success(arguments);
    return read_json("out.json")["receivers"];
  }
  // A triangle as large as a roof.
  std::string plate(const std::string& name, float height) const {
    return write_file(name, ply_bytes({{-9, height, -9}, {9, height, -9}, {0, height, 9}}, {{0, 2, 1}}));
  }
  std::string square() const { return write_file("square.ply", roofed_square_ply()); }
};

TEST_F(Surroundings, WallsSeeHalfOfTheGround) {
  const std::string wall = write_file("wall.ply", ply_bytes({{0, 1, 0}, {1, 1, 0}, {0, 2, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(mean(bake(wall)), 0);
  EXPECT_NEAR(mean(bake(wall, {"--ground"})), 0.5, 0.02);
  EXPECT_EQ(read_json("out.json")["vertices"], 3);
  EXPECT_EQ(read_json("out.json")["triangles"], 1);
  EXPECT_EQ(read_json("out.json")["occluders"]["triangles"], 3);
  EXPECT_EQ(read_json("out.json")["occluders"]["ground"], true);
}

TEST_F(Surroundings, UpSaysWhereTheGroundIs) {
  const std::string floor = write_file("floor.ply", ply_bytes({{0, 1, 0}, {1, 1, 0}, {0, 1, 1}}, {{0, 2, 1}}));
  EXPECT_EQ(mean(bake(floor, {"--ground"})), 0);
  EXPECT_GT(mean(bake(floor, {"--ground", "--up", "0,-1,0"})), 0.99);
  EXPECT_NEAR(mean(bake(floor, {"--ground", "--up", "1,0,0"})), 0.5, 0.02);
  expect_rejected(bake(floor, {"--ground", "--up", "0,0,0"}), {"up"});
}

TEST_F(Surroundings, TheGroundIsSeenAndReceives) {
  const std::size_t alone = seen(render(square()));
  EXPECT_GT(seen(render(square(), {"--ground"})), alone + 100);
}

TEST_F(Surroundings, ReachEveryMethod) {
  const Arguments more = {"--ground",   "--blockers",      plate("a.ply", 0.75f),
                          "--blockers", plate("b.ply", 2), "--reference"};
  const std::string scene = square();
  const double plain = mean(render(scene));
  const double expected = mean(render(scene, more));
  EXPECT_GT(expected, plain + 0.1);
  EXPECT_EQ(read_json("out.json")["reference"]["mismatched_rays"], 0);
  EXPECT_EQ(read_json("out.json")["occluders"]["triangles"], 3 + 2 + 2);
  EXPECT_EQ(read_json("out.json")["occluders"]["blockers"].size(), 2);
  EXPECT_EQ(mean(render(scene, with(more, {"--method", "embree"}))), expected);
  EXPECT_EQ(mean(render(scene, with(more, {"--kernel", "table"}))), expected);
  EXPECT_EQ(mean(render(scene, with(more, {"--lod", "k=1000000,epsilon=0.01"}))), expected);
}

TEST_F(Surroundings, CamerasLookThroughBlockers) {
  const auto depths = [&](const Arguments& arguments) {
    expect_success(arguments);
    const image::Image image = image::read_image(path("out.exr"));
    std::vector<float> values;
    for (auto i = static_cast<std::size_t>(image.channel("depth.Z")); i < image.pixels.size();
         i += static_cast<std::size_t>(image.channel_count())) {
      values.push_back(image.pixels[i]);
    }
    return values;
  };
  const std::string scene = square();
  const std::vector<float> before = depths(render(scene));
  EXPECT_EQ(depths(render(scene, {"--blockers", plate("roof.ply", 0.75f)})), before);
}

TEST_F(Surroundings, BlockersGetNothing) {
  const std::string floor = write_file("floor.ply", ply_bytes({{0, 1, 0}, {1, 1, 0}, {0, 1, 1}}, {{0, 2, 1}}));
  EXPECT_GT(mean(bake(floor, {"--blockers", plate("roof.ply", 1.001f)})), 0.99);
  EXPECT_EQ(read_json("out.json")["vertices"], 3);
}

TEST_F(Surroundings, FlipTurnsBacksToTheFront) {
  // Under a roof that faces down; turned round, both are seen from their backs.
  const std::string scene = write_file(
      "room.ply", ply_bytes({{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}, {-99, 0.1f, -99}, {99, 0.1f, -99}, {0, 0.1f, 99}},
                            {{0, 2, 1}, {3, 4, 5}}));
  EXPECT_NEAR(mean(bake(scene, {"--sided", "one"})), 0.5, 0.05);  // the floor is dark, the roof is not
  EXPECT_FALSE(read_json("out.json").contains("flipped"));
  EXPECT_EQ(mean(bake(scene, {"--sided", "one", "--flip"})), 0);
  EXPECT_EQ(read_json("out.json")["flipped"], true);
}

TEST_F(Surroundings, BadInputIsOneLine) {
  const std::string scene = square();
  expect_rejected(render(scene, {"--blockers", path("nowhere.ply")}), {"nowhere.ply"});
  expect_rejected(bake(scene, {"--blockers", plate("out.ply", 1)}), {"out.ply", "is an input"});
  write_file("chain.json", "{}");
  for (const Arguments& more : {Arguments{"--ground"}, {"--flip"}, {"--blockers", plate("a.ply", 1)}}) {
    expect_rejected(render(scene, with(more, {"--lod", path("chain.json")})), {"chain.json", more.front()});
  }
}

TEST_F(Surroundings, MostlyBlockedIsTold) {
  const auto err = [&](const std::string& radius) {
    const ProgramResult result = run_program(
        {"render", "builtin:box", "-o", path("out.exr"), "--size", "32x24", "--radius", radius, "--samples", "64"});
    EXPECT_EQ(result.exit_code, 0);
    return result.err;
  };
  const std::string told = err("3.4");  // a little less than the diagonal
  EXPECT_NE(told.find("fully blocked: is the mesh inside out (--flip)"), std::string::npos) << told;
  EXPECT_EQ(err("3.5"), "");  // a room is dark
  EXPECT_EQ(err("inf"), "");
  EXPECT_EQ(err("0.5"), "");
}

}  // namespace
}  // namespace lkao::test
