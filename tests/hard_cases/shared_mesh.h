// The meshes of the shared folder, which may be missing.
#pragma once

#include <filesystem>
#include <string>

#include "scene/mesh_file.h"
#include "support/meshes.h"

namespace lkao::tests {

inline std::filesystem::path shared_mesh_path(const std::string& file) {
  return std::filesystem::path(LKAO_SHARED_DIR) / "scenes" / file;
}

inline bool has_shared_mesh(const std::string& file) { return std::filesystem::exists(shared_mesh_path(file)); }

inline std::string missing_shared_mesh(const std::string& file) {
  return "NOT TESTED: the shared scene " + file +
         " is missing (looked in " LKAO_SHARED_DIR
         "; set the environment variable or the CMake variable LKAO_SHARED_DIR)";
}

inline Mesh read_shared_mesh(const std::string& file) {
  scene::Mesh mesh = scene::read_mesh_file(shared_mesh_path(file).string());
  return {std::move(mesh.positions), std::move(mesh.triangles)};
}

}  // namespace lkao::tests
