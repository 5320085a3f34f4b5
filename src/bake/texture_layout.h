// Where the triangles of a mesh lie in textures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "bake/texture_options.h"
#include "scene/corner_normals.h"
#include "scene/shared_edges.h"

namespace lkao::bake {

// A triangle as one unit square of texture coordinates shows it: that of [column, column + 1] x [row, row + 1].
struct Placement {
  std::uint32_t triangle;
  int column, row;
};

class TextureLayout {
 public:
  // Throws std::invalid_argument where an option is out of range, or no triangle to bake has texture coordinates (or
  // none in a UDIM tile): nothing is unwrapped here. The normals and their mesh must outlive it.
  TextureLayout(const scene::CornerNormals& normals, const TextureOptions& options);

  const scene::CornerNormals& normals() const { return normals_; }
  const scene::Mesh& mesh() const { return normals_.mesh(); }
  const TextureOptions& options() const { return options_; }
  const TextureReport& report() const { return report_; }  // the counts of triangles

  // UDIM numbers of the maps, ascending; one 0 where there are no UDIM tiles.
  const std::vector<int>& udims() const { return udims_; }

  // False for triangles that are not baked.
  bool has(std::uint32_t triangle) const { return squares_[triangle].count() > 0; }
  // The texture shows the triangle the wrong way round, as seen from its front.
  bool is_mirrored(std::uint32_t triangle) const { return is_mirrored_[triangle]; }
  glm::dvec2 uv(std::uint32_t triangle, std::uint32_t corner) const;
  // Of both sides, at both ends.
  bool has_same_uvs(const scene::SharedEdge& edge) const;

  // Of which something may lie in rows [first_row, end_row) of texels, in the order of the triangles.
  std::vector<Placement> placements(std::size_t map, int first_row, int end_row) const;
  // In texels of the map; partly outside of it, perhaps.
  std::array<glm::dvec2, 3> corners(const Placement& placement) const;
  // The same for any texture coordinates that are seen by that square.
  glm::dvec2 in_texels(const glm::dvec2& uv, int column, int row) const;
  // What a square is shown in; none beyond a clamped edge, or all UDIM tiles.
  std::optional<std::size_t> map_of(int column, int row) const;

 private:
  // Unit squares of texture coordinates, ends included.
  struct Squares {
    int first_column = 0, last_column = -1, first_row = 0, last_row = -1;

    std::size_t count() const {
      return static_cast<std::size_t>(last_column - first_column + 1) *
             static_cast<std::size_t>(last_row - first_row + 1);
    }
  };

  bool is_chosen(std::uint32_t triangle) const;
  bool has_uvs(std::uint32_t triangle) const;
  Squares squares_of(std::uint32_t triangle) const;
  void place(std::uint32_t triangle);
  void find_udims();

  const scene::CornerNormals& normals_;
  TextureOptions options_;
  TextureReport report_;
  std::vector<Squares> squares_;  // of each triangle; none where it is not baked
  std::vector<bool> is_mirrored_;
  std::vector<int> udims_ = {0};
};

}  // namespace lkao::bake
