#include "bake/split_vertices.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace lkao::bake {
namespace {

// NaN, too, is equal to itself.
bool is_same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

}  // namespace

std::vector<float> split_vertices(scene::Mesh& mesh, const Places& places, std::span<const float> values) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<float> of_vertices(mesh.positions.size(), std::numeric_limits<float>::quiet_NaN());
  std::vector<bool> has_value(mesh.positions.size(), false);
  std::vector<std::uint32_t> next(mesh.positions.size(), kNone);  // the vertex split from this one
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const float value = values[places.of_corner[t][i]];
      std::uint32_t vertex = mesh.triangles[t][i];
      while (has_value[vertex] && !is_same(of_vertices[vertex], value) && next[vertex] != kNone) vertex = next[vertex];
      if (has_value[vertex] && !is_same(of_vertices[vertex], value)) {
        const std::size_t count = mesh.positions.size();
        if (count == kNone) throw std::length_error("split_vertices: more than 2^32 - 1 vertices");
        next[vertex] = static_cast<std::uint32_t>(count);
        vertex = next[vertex];
        mesh.positions.push_back(glm::vec3(mesh.positions[mesh.triangles[t][i]]));
        of_vertices.push_back(value);
        has_value.push_back(true);
        next.push_back(kNone);
      }
      of_vertices[vertex] = value;
      has_value[vertex] = true;
      mesh.triangles[t][i] = vertex;
    }
  }
  return of_vertices;
}

}  // namespace lkao::bake
