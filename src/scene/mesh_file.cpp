#include "scene/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "scene/mesh_formats.h"

namespace lkao::scene {

namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

std::string read_bytes(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw std::runtime_error("no such file");
  if (std::filesystem::is_directory(status)) throw std::runtime_error("is a directory, not a mesh file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot be opened for reading");
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (in.bad()) throw std::runtime_error("cannot be read");
  if (bytes.empty()) throw std::runtime_error("the file is empty");
  return bytes;
}

void check_indices(const Mesh& mesh) {
  const std::size_t vertex_count = mesh.positions.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      if (mesh.triangles[t][corner] >= vertex_count) {
        throw std::runtime_error(fmt::format("triangle {} names vertex {}, but there are only {} vertices", t,
                                             mesh.triangles[t][corner], vertex_count));
      }
    }
  }
}

Mesh read_by_extension(const std::string& path) {
  const std::string extension = extension_of(path);
  const std::string bytes = read_bytes(path);
  if (extension == "ply") return read_ply(bytes);
  if (extension == "off") return read_off(bytes);
  if (extension == "obj" || extension == "stl" || extension == "gltf" || extension == "glb") {
    return read_through_assimp(path, bytes, extension);
  }
  throw std::runtime_error("not a supported mesh type (known: .obj .ply .stl .off .gltf .glb)");
}

}  // namespace

Mesh read_mesh_file(const std::string& path) {
  try {
    Mesh mesh = read_by_extension(path);
    check_indices(mesh);
    if (mesh.triangles.empty()) throw std::runtime_error("there are no triangles in it");
    return mesh;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

void add_polygon(Mesh& mesh, std::span<const std::uint32_t> polygon) {
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    mesh.triangles.emplace_back(polygon[0], polygon[i - 1], polygon[i]);
  }
}

double parse_number(std::string_view word) {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // Too small for a double is zero to us; too large is infinite, a defect that is counted later.
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(digits).c_str(), nullptr);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    throw std::runtime_error(fmt::format("\"{}\" is not a number", word.substr(0, 40)));
  }
  return value;
}

}  // namespace lkao::scene
