// The fuzz target of the text formats: whatever the bytes, a reader returns a mesh or says what is wrong, within memory
// that is bounded by the size of the file. The first byte chooses the format.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "fuzz/target.h"
#include "scene/formats/readers.h"

namespace lkao::tests {
namespace {

using scene::FileMesh;

// One texel.
scene::AlphaImage decode_alpha(const std::string&, std::string_view bytes, scene::AlphaOf) {
  if (bytes.empty()) throw std::runtime_error("an image of no bytes");
  return {.width = 1, .height = 1, .alphas = {static_cast<std::uint16_t>(257 * static_cast<unsigned char>(bytes[0]))}};
}

FileMesh read(std::uint8_t format, std::string_view bytes) {
  switch (format % 4) {
    case 0:
      // The file is its own material library too, and its own image.
      return scene::read_obj(bytes, [&](const std::string&) { return std::string(bytes); },
                             {.uv_set = 0, .objects = true, .decode_alpha = decode_alpha});
    case 1:
      return scene::read_stl(bytes);
    case 2:
      return scene::read_ply(bytes, 0);
    default:
      return scene::read_off(bytes, 0);
  }
}

bool has_known_vertices(const FileMesh& mesh) {
  for (const glm::uvec3& t : mesh.triangles) {
    if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) return false;
  }
  return true;
}

std::size_t memory_of(const FileMesh& mesh) {
  const auto size_of = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
  return size_of(mesh.positions) + size_of(mesh.triangles) + size_of(mesh.normals) + size_of(mesh.normal_corners) +
         size_of(mesh.fans) + size_of(mesh.uvs) + size_of(mesh.uv_corners) + size_of(mesh.materials);
}

// Empty where nothing is wrong with the mesh.
std::string fault_of(FileMesh& mesh, std::size_t file_size) {
  const std::size_t memory_limit = 1000 + 100 * file_size;
  if (memory_of(mesh) > memory_limit) return fmt::format("{} bytes of mesh from {}", memory_of(mesh), file_size);
  if (!mesh.normal_corners.empty() && mesh.normal_corners.size() != mesh.triangles.size()) {
    return fmt::format("normals for {} of {} triangles", mesh.normal_corners.size(), mesh.triangles.size());
  }
  for (const std::size_t count : {mesh.uv_corners.size(), mesh.materials.size()}) {
    if (count != 0 && count != mesh.triangles.size()) {
      return fmt::format("texture coordinates or materials for {} of {} triangles", count, mesh.triangles.size());
    }
  }
  if (!has_known_vertices(mesh)) return "";
  const std::size_t triangle_count = mesh.triangles.size();
  cut_polygons(mesh);
  if (mesh.triangles.size() != triangle_count) return "cutting polygons changed the number of triangles";
  return has_known_vertices(mesh) ? "" : "a cut polygon has a corner that it had not";
}

}  // namespace
}  // namespace lkao::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::string fault;
  try {
    lkao::scene::FileMesh mesh =
        lkao::tests::read(data[0], std::string_view(reinterpret_cast<const char*>(data) + 1, size - 1));
    fault = lkao::tests::fault_of(mesh, size);
  } catch (const std::runtime_error& error) {
    const std::string_view line = error.what();
    if (line.empty()) fault = "a refusal without a word";
  }
  if (!fault.empty()) {
    std::fprintf(stderr, "%s\n", fault.c_str());
    std::abort();
  }
  return 0;
}
