// What is refused whatever the type.
#include "scene/mesh_file.h"

#include <gtest/gtest.h>

#include "scene/files.h"
#include "scene/load.h"

namespace lkao::scene {
namespace {

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

}  // namespace
}  // namespace lkao::scene
