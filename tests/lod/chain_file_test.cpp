#include "lod/chain_file.h"

#include <filesystem>
#include <stdexcept>

#include <gtest/gtest.h>

#include "image/temporary_folder.h"
#include "lod/meshes.h"
#include "lod/simplify.h"

namespace lkao::lod {
namespace {

class ChainFile : public testing::Test {
 protected:
  void SetUp() override {
    chain_ = simplify(wavy_grid(12), {.levels = {.epsilon = 0.0123f, .k = 2.7f, .growth = 2.9f}}).chain;
    path_ = folder_ / "waves.json";
    write_chain(chain_, path_, chain_files(path_, chain_.levels.size()));
    document_ = image::bytes_of(path_);
  }

  // The document with `old` replaced is refused in one line that names the file and `fault`.
  void expect_refused(const std::string& old, const std::string& replacement, const std::string& fault) const {
    const std::size_t place = document_.find(old);
    ASSERT_NE(place, std::string::npos) << old;
    std::string changed = document_;
    changed.replace(place, old.size(), replacement);
    image::put(path_, changed);
    expect_refused(path_, fault);
  }
  static void expect_refused(const std::string& path, const std::string& fault) {
    try {
      load_chain(path);
      ADD_FAILURE() << "taken; expected " << fault;
    } catch (const std::runtime_error& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(path + ": ")) << message;
      EXPECT_NE(message.find(fault), std::string::npos) << message << " / " << fault;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }

  image::TemporaryFolder folder_;
  std::string path_;
  std::string document_;
  Chain chain_;
};

TEST_F(ChainFile, ComesBackBitForBit) {
  const Chain loaded = load_chain(path_);
  EXPECT_EQ(loaded.k, chain_.k);
  EXPECT_EQ(loaded.growth, chain_.growth);
  ASSERT_EQ(loaded.levels.size(), chain_.levels.size());
  for (std::size_t i = 0; i < loaded.levels.size(); ++i) {
    EXPECT_EQ(loaded.levels[i].epsilon, chain_.levels[i].epsilon);
    EXPECT_EQ(loaded.levels[i].r_min, chain_.levels[i].r_min);
    EXPECT_EQ(loaded.levels[i].r_max, chain_.levels[i].r_max);
    EXPECT_EQ(loaded.levels[i].mesh.positions, chain_.levels[i].mesh.positions);
    EXPECT_EQ(loaded.levels[i].mesh.triangles, chain_.levels[i].mesh.triangles);
  }
}

// Of a scene far from zero: all levels are taken relative to one origin, the scene's.
TEST_F(ChainFile, LevelsHaveTheSameOrigin) {
  const auto far_triangle = [](const char* x) {
    return std::string(
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
               "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n") +
           x + " 5413678 0\n448263 5413678 0\n448262 5413679 0\n3 0 1 2\n";
  };
  image::put(folder_ / "far.0.ply", far_triangle("448262"));
  image::put(folder_ / "far.1.ply", far_triangle("448102"));  // alone it would choose another
  const std::string path = folder_ / "far.json";
  image::put(path, R"({"format": "lkao levels of detail", "version": 1, "k": 3, "growth": 3, "levels": [
      {"mesh": "far.0.ply", "vertices": 3, "triangles": 1, "epsilon": 0, "r_min": 0, "r_max": 3},
      {"mesh": "far.1.ply", "vertices": 3, "triangles": 1, "epsilon": 1, "r_min": 3, "r_max": null}]})");
  for (const std::optional<glm::dvec3> origin : {std::optional<glm::dvec3>{}, {glm::dvec3(448000, 5413000, 0)}}) {
    const Chain chain = load_chain(path, origin);
    EXPECT_NE(chain.levels[0].mesh.origin, glm::dvec3(0));
    if (origin) {
      EXPECT_EQ(chain.levels[0].mesh.origin, *origin);
    }
    EXPECT_EQ(chain.levels[1].mesh.origin, chain.levels[0].mesh.origin);
    EXPECT_EQ(chain.levels[1].mesh.positions[1], chain.levels[0].mesh.positions[1]);
  }
}

TEST_F(ChainFile, OfAFarSceneComesBackBitForBit) {
  scene::Mesh mesh = wavy_grid(12);
  mesh.origin = {448262, 5413678, 0};
  const Chain chain = simplify(mesh, {.levels = {.epsilon = 0.0123f}}).chain;
  const std::string path = folder_ / "far.json";
  write_chain(chain, path, chain_files(path, chain.levels.size()));
  const Chain loaded = load_chain(path, mesh.origin);
  ASSERT_EQ(loaded.levels.size(), chain.levels.size());
  for (std::size_t i = 0; i < loaded.levels.size(); ++i) {
    EXPECT_EQ(loaded.levels[i].mesh.origin, mesh.origin);
    EXPECT_EQ(loaded.levels[i].mesh.positions, chain.levels[i].mesh.positions);
  }
}

TEST_F(ChainFile, MayMoveAsAWhole) {
  const std::string other = folder_ / "moved";
  std::filesystem::create_directory(other);
  for (const std::string& file : chain_files(path_, chain_.levels.size())) {
    std::filesystem::rename(file, std::filesystem::path(other) / std::filesystem::path(file).filename());
  }
  EXPECT_EQ(load_chain(other + "/waves.json").levels.size(), chain_.levels.size());
}

TEST_F(ChainFile, FilesStandBesideTheDocument) {
  EXPECT_EQ(chain_files("a/b.json", 2), (std::vector<std::string>{"a/b.json", "a/b.0.ply", "a/b.1.ply"}));
  for (const char* name : {"a.ply", "a", ".json", "a/.json", ""}) {
    EXPECT_THROW(chain_files(name, 2), std::invalid_argument) << name;
  }
}

TEST_F(ChainFile, BadDocumentsAreRefused) {
  expect_refused("\"version\": 1", "\"version\": 7", "version: expected 1");
  expect_refused("lkao levels", "other levels", "format");
  expect_refused("\"k\": ", "\"kay\": ", "k: expected a number");
  expect_refused("\"levels\": [", "\"levels\": 3, \"x\": [", "levels: expected an array");
  expect_refused("\"epsilon\": 0.0,", "\"epsilon\": 1.0,", "levels[0].epsilon");
  expect_refused("\"r_min\": 0.0,", "\"r_min\": 0.5,", "levels[0].r_min");
  expect_refused("\"r_max\": null", "\"r_max\": 1e9", "null");
  expect_refused("\"mesh\": \"waves.1.ply\"", "\"mesh\": 1", "levels[1].mesh");
  expect_refused("\"mesh\": \"waves.1.ply\"", "\"mesh\": \"gone.ply\"", "gone.ply");
  expect_refused("\"mesh\": \"waves.2.ply\"", "\"mesh\": \"waves.0.ply\"", "levels[2].");
  expect_refused("}", "", "not a JSON document");
  image::put(path_, "");
  expect_refused(path_, "not a JSON document");
}

TEST_F(ChainFile, MissingAndTruncatedFilesAreRefused) {
  expect_refused(folder_ / "none.json", "no such file");
  std::filesystem::create_directory(folder_ / "dir.json");
  expect_refused(folder_ / "dir.json", "is a directory");
  const std::string mesh = folder_ / "waves.0.ply";
  image::put(mesh, image::bytes_of(mesh).substr(0, 700));
  expect_refused(path_, "waves.0.ply");
}

TEST_F(ChainFile, AnUnwritablePlaceIsNamed) {
  const std::string path = folder_ / "none/waves.json";
  try {
    write_chain(chain_, path, chain_files(path, chain_.levels.size()));
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("none/waves.0.ply"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lkao::lod
