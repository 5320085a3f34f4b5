#include "bake/texture_charts.h"

#include "bake/places.h"
#include "scene/disjoint_sets.h"

namespace lkao::bake {
TextureCharts find_charts(const TextureLayout& layout) {
  TextureCharts charts;
  scene::DisjointSets sets(layout.mesh().triangles.size());
  for (const scene::SharedEdge& edge : scene::shared_edges(layout.mesh())) {
    const auto& [a, b] = edge.sides;
    if (!layout.has(a.triangle) || !layout.has(b.triangle)) continue;
    if (!layout.has_same_uvs(edge)) {
      if (shades_as_one(layout.normals(), edge)) charts.seams.push_back(edge);
    } else if (layout.is_mirrored(a.triangle) == layout.is_mirrored(b.triangle)) {
      sets.join(a.triangle, b.triangle);
    }
  }
  charts.firsts.reserve(layout.mesh().triangles.size());
  for (std::uint32_t t = 0; t < layout.mesh().triangles.size(); ++t) charts.firsts.push_back(sets.find(t));
  return charts;
}

}  // namespace lkao::bake
