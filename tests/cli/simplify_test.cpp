#include <filesystem>

#include "cli/program.h"
#include "cli/small_mesh.h"
#include "lod/chain_file.h"
#include "scene/load.h"

namespace lkao::test {
namespace {

class Simplify : public ProgramTest {
 protected:
  Arguments simplify(const std::string& scene, const Arguments& more = {}) const {
    Arguments arguments = {"simplify", scene, "-o", path("chain.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(Simplify, WritesAChainThatLoads) {
  expect_success(simplify("builtin:disk", {"--epsilon", "0.01", "--levels", "3", "--k", "2.5", "--growth", "4"}));
  EXPECT_EQ(files(), (std::vector<std::string>{"chain.0.ply", "chain.1.ply", "chain.2.ply", "chain.json"}));
  const lod::Chain chain = lod::load_chain(path("chain.json"));
  ASSERT_EQ(chain.levels.size(), 3u);
  EXPECT_EQ(chain.k, 2.5f);
  EXPECT_FLOAT_EQ(chain.levels[1].epsilon, 0.01f);
  EXPECT_FLOAT_EQ(chain.levels[2].epsilon, 0.04f);
  EXPECT_FLOAT_EQ(chain.levels[2].r_min, 0.1f);
  const scene::Mesh original = scene::load("builtin:disk");
  EXPECT_EQ(chain.levels[0].mesh.triangles, original.triangles);
  EXPECT_LT(chain.levels[2].mesh.triangles.size(), original.triangles.size());
}

TEST_F(Simplify, JsonReportsWhatWasMeasured) {
  const ProgramResult result = expect_success(simplify("builtin:disk", {"--radius", "2", "--json", "-"}));
  const nlohmann::json json = nlohmann::json::parse(result.out);
  ASSERT_EQ(json["levels"].size(), 4u);
  EXPECT_EQ(json["levels"][0]["r_min"], 0);
  EXPECT_TRUE(json["levels"][3]["r_max"].is_null());
  EXPECT_NEAR(json["levels"][3]["r_min"], 1.0, 1e-6);  // half of the radius
  for (int i = 1; i < 4; ++i) {
    const nlohmann::json& level = json["levels"][static_cast<std::size_t>(i)];
    for (const char* way : {"from_original", "to_original"}) {
      EXPECT_LE(level[way]["maximum"].get<double>(), level["epsilon"].get<double>());
      EXPECT_LE(level[way]["rms"].get<double>(), level[way]["maximum"].get<double>());
    }
  }
  EXPECT_EQ(json["triangles"].get<int>(), json["simplified"]["triangles"].get<int>() +
                                              json["too_small"]["triangles"].get<int>() +
                                              json["duplicates_left_out"].get<int>());
}

TEST_F(Simplify, RadiiMayBeSharesOfTheScenesDiagonalOrInfinite) {
  const auto levels = [&](const std::string& radius) {
    const ProgramResult result = expect_success(simplify("builtin:disk", {"--radius", radius, "--json", "-"}));
    return nlohmann::json::parse(result.out)["levels"];
  };
  const nlohmann::json info = nlohmann::json::parse(expect_success({"info", "builtin:disk", "--json", "-"}).out);
  EXPECT_NEAR(levels("inf")[3]["r_min"].get<double>(), info["diagonal"].get<double>() / 2, 1e-5);
  EXPECT_NEAR(levels("5%")[3]["r_min"].get<double>(), 0.05 * info["diagonal"].get<double>() / 2, 1e-5);
}

TEST_F(Simplify, TheTableHasARowForEachLevel) {
  const std::string table = expect_success(simplify("builtin:disk", {"--radius", "2", "--levels", "2"})).out;
  for (const char* text : {"not manifold", "r min", "\n    0  ", "\n    1  ", "inf"}) {
    EXPECT_NE(table.find(text), std::string::npos) << text << table;
  }
  EXPECT_EQ(table.find("\n    2  "), std::string::npos);
}

TEST_F(Simplify, RejectsBadOptions) {
  expect_rejected(simplify("builtin:wall"), {"--radius or --epsilon", "(small)", "(large)"});
  expect_rejected(simplify("builtin:wall", {"--radius", "1", "--epsilon", "1"}), {"--epsilon", "--radius"});
  for (const char* bad : {"0", "-1", "nan"}) {
    expect_rejected(simplify("builtin:wall", {"--epsilon", bad}), {"--epsilon", "above 0"});
    expect_rejected(simplify("builtin:wall", {"--radius", "1", "--k", bad}), {"--k", "above 0"});
    expect_rejected(simplify("builtin:wall", {"--radius", "1", "--growth", bad}), {"--growth", "above 0"});
  }
  expect_rejected(simplify("builtin:wall", {"--radius", "1", "--growth", "1"}), {"--growth", "above 1"});
  expect_rejected(simplify("builtin:wall", {"--radius", "1", "--levels", "0"}), {"--levels", "1 to 16"});
  expect_rejected(simplify("builtin:wall", {"--radius", "1", "--levels", "99"}), {"--levels", "1 to 16"});
  expect_rejected(simplify("builtin:wall", {"--epsilon", "1e30", "--growth", "1e6"}), {"epsilon"});
}

TEST_F(Simplify, RejectsBadScenesAndOutputs) {
  expect_rejected(simplify(path("nowhere.ply"), {"--radius", "1"}), {"nowhere.ply"});
  expect_rejected({"simplify", "builtin:wall", "--radius", "1"}, {"--output"});
  expect_rejected({"simplify", "builtin:wall", "--radius", "1", "-o", path("chain.ply")}, {"--output", ".json"});
  expect_rejected({"simplify", "builtin:wall", "--radius", "1", "-o", path("no/chain.json")}, {"no/chain.json"});
  expect_rejected(simplify("builtin:wall", {"--radius", "1", "--json", path("chain.json")}), {"two outputs"});
  const std::string scene = write_file("chain.0.ply", roofed_square_ply());
  expect_rejected(simplify(scene, {"--radius", "1"}), {"chain.0.ply", "is an input"});
}

TEST_F(Simplify, LeavesAnOldChainAsItWas) {
  expect_success(simplify("builtin:disk", {"--radius", "1", "--levels", "2"}));
  expect_rejected(simplify(path("nowhere.ply"), {"--radius", "1", "--levels", "2"}), {"nowhere.ply"});
}

}  // namespace
}  // namespace lkao::test
