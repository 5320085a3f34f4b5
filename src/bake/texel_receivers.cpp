#include "bake/texel_receivers.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/cage.h"
#include "bake/edge_clearance.h"
#include "bake/surface_receiver.h"
#include "scene/facet.h"

namespace lkao::bake {
namespace {

// Of a texel: pieces smaller than this have one receiver, and parts of larger ones smaller than this have none.
constexpr double kLeastCell = 1e-6;

// A triangle with what its receivers need.
struct PlacedTriangle {
  Placement placement;
  std::array<glm::dvec2, 3> texels;
  scene::Facet facet;
  InscribedCircle circle;
  scene::TriangleNormals normals;

  PlacedTriangle(const TextureLayout& layout, const Placement& in_map)
      : placement(in_map),
        texels(layout.corners(in_map)),
        facet(layout.mesh(), layout.mesh().triangles[in_map.triangle]),
        circle(facet),
        normals(layout.normals().of(in_map.triangle)) {}

  // Of the corners at a point of the map, and clear of the edges.
  glm::dvec3 weights_at(const glm::dvec2& point, double clearance) const {
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const glm::dvec2 a = texels[0] - point, b = texels[1] - point, c = texels[2] - point;
    const glm::dvec3 areas(cross(b, c), cross(c, a), cross(a, b));
    const double sum = cross(texels[1] - texels[0], texels[2] - texels[0]);
    // Rounding puts points on an edge a little beyond it.
    const glm::dvec3 weights = glm::max(areas / sum, glm::dvec3(0.0));
    return keep_from_edges(weights / (weights.x + weights.y + weights.z), circle, clearance);
  }
};

class ReceiverMaker {
 public:
  ReceiverMaker(const TextureLayout& layout, const TileCoverage& coverage, double clearance,
                const TangentFrames* frames)
      : layout_(layout), coverage_(coverage), clearance_(clearance), frames_(frames) {}

  void add(const TexelPiece& piece) {
    use(coverage_.placements[piece.placement]);
    const glm::ivec2 texel = coverage_.tile.first + texel_place(piece.texel);
    if (piece.is_whole) {
      add_whole(piece, texel);
    } else {
      add_part(piece, texel);
    }
  }
  TexelReceivers take() { return std::move(made_); }

 private:
  // Neighbouring texels often have the same triangle.
  void use(const Placement& placement) {
    if (triangle_ && triangle_->placement.triangle == placement.triangle &&
        triangle_->placement.column == placement.column && triangle_->placement.row == placement.row) {
      return;
    }
    triangle_.emplace(layout_, placement);
  }

  void add_whole(const TexelPiece& piece, const glm::ivec2& texel) {
    const int grid = layout_.options().grid;
    for (int row = 0; row < grid; ++row) {
      for (int column = 0; column < grid; ++column) {
        const glm::dvec2 middle = (glm::dvec2(column, row) + 0.5) / static_cast<double>(grid);
        add_point(piece.texel, glm::dvec2(texel) + middle, 1.0 / (grid * grid));
      }
    }
  }

  void add_part(const TexelPiece& piece, const glm::ivec2& texel) {
    const Polygon polygon = polygon_in_texel(triangle_->texels, texel);
    const int grid = piece.area > kLeastCell ? layout_.options().edge_grid : 1;
    const double side = 1.0 / grid;
    const std::size_t count_before = made_.receivers.size();
    for (int row = 0; row < grid && grid > 1; ++row) {
      for (int column = 0; column < grid; ++column) {
        const glm::dvec2 lower = glm::dvec2(texel) + side * glm::dvec2(column, row);
        const Polygon part = polygon.within(lower, lower + side);
        const double area = part.area();
        if (area > kLeastCell) add_point(piece.texel, part.centroid(), area);
      }
    }
    if (made_.receivers.size() == count_before) add_point(piece.texel, polygon.centroid(), piece.area);
  }

  void add_point(std::uint32_t texel, const glm::dvec2& point, double weight) {
    const glm::dvec3 weights = triangle_->weights_at(point, clearance_);
    Receiver receiver = receiver_at(weights);
    if (layout_.options().inwards) {
      receiver.normal = -receiver.normal;
      receiver.geometric_normal = -receiver.geometric_normal;
    }
    made_.receivers.push_back(receiver);
    made_.texels.push_back(texel);
    made_.weights.push_back(static_cast<float>(weight));
    if (frames_ != nullptr) made_.frames.push_back(frames_->at(triangle_->placement.triangle, weights));
  }

  Receiver receiver_at(const glm::dvec3& weights) {
    if (const Cage* cage = layout_.options().cage) {
      if (const auto found = cage->receiver(triangle_->placement.triangle, weights, clearance_)) return *found;
      ++made_.missed_count;
    }
    Receiver receiver = receiver_on(triangle_->facet, triangle_->normals, weights);
    receiver.excluded_instance = object_of(layout_.mesh(), triangle_->placement.triangle);
    return receiver;
  }

  const TextureLayout& layout_;
  const TileCoverage& coverage_;
  double clearance_;
  const TangentFrames* frames_;
  std::optional<PlacedTriangle> triangle_;
  TexelReceivers made_;
};

}  // namespace

TexelReceivers make_receivers(const TextureLayout& layout, const TileCoverage& coverage, double clearance,
                              const TangentFrames* frames) {
  ReceiverMaker maker(layout, coverage, clearance, frames);
  for (const TexelPiece& piece : coverage.pieces) maker.add(piece);
  return maker.take();
}

}  // namespace lkao::bake
