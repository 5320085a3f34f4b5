#include "scene/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scene/formats/file_bytes.h"
#include "scene/formats/readers.h"

namespace lkao::scene {

namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

// Nothing where there is no such file; names may have been written on Windows.
std::optional<std::string> read_beside(const std::string& path, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path beside = std::filesystem::path(path).parent_path() / name;
  std::error_code error;
  if (!std::filesystem::is_regular_file(beside, error)) return std::nullopt;
  try {
    return std::string(read_file(beside.string()).view());
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

void check_indices(const FileMesh& mesh) {
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

FileMesh read_by_extension(const std::string& path, const ReadOptions& options) {
  const std::optional<int>& uv_set = options.uv_set;
  const std::string extension = extension_of(path);
  const FileBytes file = read_file(path);
  const std::string_view bytes = file.view();
  if (bytes.empty()) throw std::runtime_error("the file is empty");
  if (extension == "ply") return read_ply(bytes, uv_set);
  if (extension == "off") return read_off(bytes, uv_set);
  if (extension == "stl") return read_stl(bytes);
  if (extension == "obj") {
    return read_obj(bytes, [&](const std::string& name) { return read_beside(path, name); },
                    {uv_set, options.objects, options.decode_alpha});
  }
  if (extension == "gltf" || extension == "glb") {
    return read_gltf(path, bytes, {uv_set, options.objects, options.decode_alpha});
  }
  throw std::runtime_error("not a supported mesh type (known: .obj .ply .stl .off .gltf .glb)");
}

glm::dvec3 origin_of(const FileMesh& file) {
  return file.origin != glm::dvec3(0.0) ? file.origin : choose_origin({file.positions, glm::dvec3(0.0)});
}

// Corners with numbers of values that are not there, or not usable, get `none`.
template <typename Value, typename IsUsable>
void leave_out_unusable(std::vector<glm::uvec3>& corners, const std::vector<Value>& values, std::uint32_t none,
                        const IsUsable& is_usable) {
  for (glm::uvec3& numbers : corners) {
    for (int i = 0; i < 3; ++i) {
      if (numbers[i] >= values.size() || !is_usable(values[numbers[i]])) numbers[i] = none;
    }
  }
}

// Normals of length one; corners with another have none.
void take_normals(FileMesh& file, Mesh& mesh) {
  bool has_any = false;
  for (glm::vec3& normal : file.normals) {
    const double length = glm::length(glm::dvec3(normal));
    const bool is_usable = length > 0 && std::isfinite(length);
    normal = is_usable ? glm::vec3(glm::dvec3(normal) / length) : glm::vec3(0.0f);
    has_any = has_any || is_usable;
  }
  if (!has_any) return;
  leave_out_unusable(file.normal_corners, file.normals, kNoNormal,
                     [](const glm::vec3& normal) { return normal != glm::vec3(0.0f); });
  mesh.normals = std::move(file.normals);
  mesh.normal_corners = std::move(file.normal_corners);
}

void take_uvs(FileMesh& file, Mesh& mesh) {
  const auto is_finite = [](const glm::vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); };
  if (std::none_of(file.uvs.begin(), file.uvs.end(), is_finite)) return;
  leave_out_unusable(file.uv_corners, file.uvs, kNoUv, is_finite);
  mesh.uvs = std::move(file.uvs);
  mesh.uv_corners = std::move(file.uv_corners);
}

}  // namespace

MeshFile open_mesh_file(const std::string& path, const ReadOptions& options) {
  if (options.uv_set && *options.uv_set < 0) {
    throw std::invalid_argument(fmt::format("open_mesh_file: uv_set is {}, which is negative", *options.uv_set));
  }
  try {
    FileMesh file = read_by_extension(path, options);
    check_indices(file);
    if (file.triangles.empty()) throw std::runtime_error("there are no triangles in it");
    cut_polygons(file);
    MeshFile result{.mesh = {}, .contents = std::move(file.contents)};
    result.mesh.origin = options.origin ? *options.origin : origin_of(file);
    // Where the file names the same one, positions stay as they are, bit for bit.
    const glm::dvec3 shift = file.origin - result.mesh.origin;
    result.mesh.positions.reserve(file.positions.size());
    for (const glm::dvec3& p : file.positions) result.mesh.positions.emplace_back(p + shift);
    result.mesh.triangles = std::move(file.triangles);
    take_normals(file, result.mesh);
    take_uvs(file, result.mesh);
    result.mesh.materials = std::move(file.materials);
    result.mesh.objects = std::move(file.objects);
    result.mesh.holes = std::move(file.holes);
    return result;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

Mesh read_mesh_file(const std::string& path, const ReadOptions& options) { return open_mesh_file(path, options).mesh; }

}  // namespace lkao::scene
