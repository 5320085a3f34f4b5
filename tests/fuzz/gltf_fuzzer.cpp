// The fuzz target of glTF and GLB: whatever the bytes, the reader returns a mesh or says what is wrong.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "fuzz/target.h"
#include "scene/formats/readers.h"
#include "scene/mesh.h"

namespace lkao::tests {
namespace {

using scene::FileMesh;

// Every number must be one of `count`, or `other`.
bool are_known(const std::vector<glm::uvec3>& triangles, std::size_t count, std::uint32_t other) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const glm::uvec3& t) {
    return (t.x < count || t.x == other) && (t.y < count || t.y == other) && (t.z < count || t.z == other);
  });
}

// Two texels of whatever the bytes of the image begin with.
scene::AlphaImage decode_alpha(const std::string&, std::string_view bytes, scene::AlphaOf) {
  if (bytes.size() < 4) throw std::runtime_error("an image of a few bytes");
  scene::AlphaImage image{.width = 2, .height = 1, .alphas = {}};
  for (const char c : bytes.substr(0, 2))
    image.alphas.push_back(static_cast<std::uint16_t>(257 * static_cast<unsigned char>(c)));
  return image;
}

// Of holes, looked up in each triangle.
std::string fault_of(const scene::Holes& holes, std::size_t triangle_count) {
  if (holes.numbers.size() != triangle_count) return fmt::format("holes for {} triangles", holes.numbers.size());
  for (std::size_t t = 0; t < triangle_count; ++t) {
    const double alpha = holes.alpha(t, {0.25, 0.5});
    if (!(alpha >= 0 && alpha <= 1)) return fmt::format("an alpha of {}", alpha);
  }
  return "";
}

// Empty where nothing is wrong with the mesh.
std::string fault_of(const FileMesh& mesh) {
  constexpr std::uint32_t kNone = scene::kNoNormal;  // no vertex has that number either
  if (!are_known(mesh.triangles, mesh.positions.size(), kNone)) return "a triangle names an unknown vertex";
  if (!are_known(mesh.normal_corners, mesh.normals.size(), kNone)) return "a corner names an unknown normal";
  if (!mesh.normal_corners.empty() && mesh.normal_corners.size() != mesh.triangles.size()) {
    return fmt::format("normals for {} of {} triangles", mesh.normal_corners.size(), mesh.triangles.size());
  }
  if (mesh.uv_corners.size() != mesh.triangles.size() || mesh.materials.size() != mesh.triangles.size()) {
    return fmt::format("texture coordinates for {}, materials for {} of {} triangles", mesh.uv_corners.size(),
                       mesh.materials.size(), mesh.triangles.size());
  }
  if (!are_known(mesh.uv_corners, mesh.uvs.size(), kNone)) return "a corner names unknown texture coordinates";
  if (mesh.objects.size() != mesh.triangles.size()) return "triangles of no object";
  if (mesh.holes) {
    if (const std::string fault = fault_of(*mesh.holes, mesh.triangles.size()); !fault.empty()) return fault;
  }
  return mesh.contents.cut_out_count > mesh.triangles.size() ? "more cut-outs than triangles" : "";
}

}  // namespace
}  // namespace lkao::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string fault;
  try {
    // In a folder that does not exist: nothing is beside the file.
    fault = lkao::tests::fault_of(
        lkao::scene::read_gltf("/nowhere/a.gltf", {reinterpret_cast<const char*>(data), size},
                               {.uv_set = 0, .objects = true, .decode_alpha = lkao::tests::decode_alpha}));
  } catch (const std::runtime_error& error) {
    const std::string_view line = error.what();
    if (line.empty() || line.size() > 400 || line.find('\n') != line.npos) {
      fault = fmt::format("a refusal that is not one short line: {}", line);
    }
  }
  if (!fault.empty()) {
    std::fprintf(stderr, "%s\n", fault.c_str());
    std::abort();
  }
  return 0;
}
