// Small files for the tests of mesh reading.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scene/mesh_file.h"

namespace lkao::scene {

// A folder of this process' own, gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "lkao_scene_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  // Writes the file and returns its path.
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream out(path(name), std::ios::binary);
    out << bytes;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

// The bytes of a value as they lie in memory.
template <typename T>
std::string raw(const T& value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

// A text of lines that end in LF, with another end for each.
inline std::string with_line_ends(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

// What read_mesh_file says of a file that it must refuse; an empty string (and a failure) where it takes it.
inline std::string refusal_of(const std::string& path) {
  try {
    const Mesh mesh = read_mesh_file(path);
    ADD_FAILURE() << path << " was taken, with " << mesh.triangles.size() << " triangles";
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

// Expects one line that begins with the file's path and contains `fault`.
inline void expect_refused(const std::string& path, const std::string& fault) {
  const std::string message = refusal_of(path);
  EXPECT_TRUE(message.starts_with(path + ": ")) << message;
  EXPECT_NE(message.find(fault, path.size()), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

// Corner positions of a triangle, whatever the vertices' numbers.
inline std::vector<glm::vec3> corners(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3& t = mesh.triangles.at(triangle);
  return {mesh.positions.at(t.x), mesh.positions.at(t.y), mesh.positions.at(t.z)};
}

}  // namespace lkao::scene
