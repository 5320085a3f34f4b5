#include "scene/formats/gltf/triangles.h"

#include <stdexcept>

#include <fmt/format.h>

namespace lkao::scene::gltf {

namespace {

// The largest index of every type begins a new strip in graphics interfaces; glTF forbids it.
bool is_restart(std::uint32_t index) { return index == 0xffu || index == 0xffffu || index == 0xffffffffu; }

void check_indices(std::span<const std::uint32_t> indices, std::size_t vertex_count, const std::string& place) {
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < vertex_count) continue;
    throw std::runtime_error(fmt::format("{}: index {} names vertex {} of {}{}", place, i, indices[i], vertex_count,
                                         is_restart(indices[i]) ? ": glTF knows no primitive restart" : ""));
  }
}

}  // namespace

std::vector<glm::uvec3> make_triangles(Mode mode, std::span<const std::uint32_t> indices, std::size_t vertex_count,
                                       const std::string& place) {
  check_indices(indices, vertex_count, place);
  std::vector<glm::uvec3> triangles;
  if (mode == Mode::triangles) {
    if (indices.size() % 3 != 0) {
      throw std::runtime_error(fmt::format("{}: a list of triangles has {} indices", place, indices.size()));
    }
    triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i < indices.size(); i += 3)
      triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    return triangles;
  }
  for (std::size_t i = 2; i < indices.size(); ++i) {
    if (mode == Mode::triangle_fan) {
      triangles.emplace_back(indices[0], indices[i - 1], indices[i]);
    } else if (i % 2 == 0) {
      triangles.emplace_back(indices[i - 2], indices[i - 1], indices[i]);
    } else {
      triangles.emplace_back(indices[i - 1], indices[i - 2], indices[i]);
    }
  }
  return triangles;
}

}  // namespace lkao::scene::gltf
