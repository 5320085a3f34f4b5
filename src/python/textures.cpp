// Occlusion as textures of a mesh.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>
#include <glm/geometric.hpp>

#include "bake/cage.h"
#include "bake/texture.h"
#include "bake/texture_layout.h"
#include "lkao/ambient_occlusion.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/surfaces.h"
#include "python/words.h"

namespace lkao::python {
namespace {

using bake::BentNormals, bake::TextureMap, bake::TextureOptions, bake::TextureReport;

constexpr Word<BentNormals> kSpaces[] = {{"object", BentNormals::object}, {"tangent", BentNormals::tangent}};
constexpr const char* kOtherBake = "merge must be parts of a bake with the same mesh, size, udim and bent_normals";
constexpr double kUsualExtrusion = 0.02;  // of the diagonal of the surface's box

TextureOptions make_texture_options(int width, int height, const std::string& wrap_u, const std::string& wrap_v,
                                    bool udim, std::optional<std::uint32_t> material, int grid,
                                    const std::optional<std::string>& bent_normals, bool thickness, bool level_seams,
                                    std::optional<int> margin) {
  TextureOptions options{.width = width,
                         .height = height,
                         .wrap_u = value_of(kWraps, wrap_u, "wrap"),
                         .wrap_v = value_of(kWraps, wrap_v, "wrap"),
                         .udim = udim,
                         .material = material,
                         .grid = grid,
                         .inwards = thickness,
                         .level_seams = level_seams,
                         .margin = margin};
  if (bent_normals) options.bent_normals = value_of(kSpaces, *bent_normals, "bent_normals");
  bake::check(options);
  return options;
}

// Number, occlusion (height, width), bent normals (height, width, 3) or None, coverage (height, width).
py::tuple tuple_of(TextureMap map) {
  const py::ssize_t width = map.width, height = map.height;
  py::object bent_normals = py::none();
  if (!map.bent_normals.empty()) bent_normals = array_of<float>(std::move(map.bent_normals), {height, width, 3});
  return py::make_tuple(map.udim, array_of<float>(std::move(map.occlusion), {height, width}), bent_normals,
                        array_of<std::uint8_t>(std::move(map.coverage), {height, width}));
}

py::list list_of(std::vector<TextureMap> maps) {
  py::list list;
  for (TextureMap& map : maps) list.append(tuple_of(std::move(map)));
  return list;
}

// A copy of what tuple_of() has made, with these options.
TextureMap map_of(const py::tuple& parts, const TextureOptions& options) {
  TextureMap map{.udim = py::cast<int>(parts[0]),
                 .width = options.width,
                 .height = options.height,
                 .occlusion = {},
                 .bent_normals = {},
                 .coverage = {}};
  const auto of_texels = [&](const py::handle& part, py::ssize_t dimension_count) {
    auto array = py::cast<py::array>(part);
    require(array.ndim() == dimension_count && array.shape(0) == map.height && array.shape(1) == map.width, kOtherBake);
    return array;
  };
  const py::array occlusion = of_texels(parts[1], 2), coverage = of_texels(parts[3], 2);
  std::ranges::copy(packed<float>(occlusion), std::back_inserter(map.occlusion));
  std::ranges::copy(packed<std::uint8_t>(coverage), std::back_inserter(map.coverage));
  require(parts[2].is_none() == (options.bent_normals == BentNormals::none), kOtherBake);
  if (!parts[2].is_none()) {
    const py::array directions = of_texels(parts[2], 3);
    std::ranges::copy(packed<glm::vec3, float>(directions), std::back_inserter(map.bent_normals));
    require(map.bent_normals.size() == map.size(), kOtherBake);
  }
  return map;
}

// By the names of the class that users see.
py::dict seams_of(const TextureReport& report) {
  py::dict dict;
  dict["seam_count"] = report.seam_count;
  dict["worst_seam_before"] = report.worst_seam_before;
  dict["worst_seam_after"] = report.worst_seam_after;
  return dict;
}

py::dict dict_of(const TextureReport& report) {
  py::dict dict = seams_of(report);
  dict["triangle_count"] = report.triangle_count;
  dict["bare_triangle_count"] = report.bare_triangle_count;
  dict["flat_triangle_count"] = report.flat_triangle_count;
  dict["mirrored_triangle_count"] = report.mirrored_triangle_count;
  dict["outside_triangle_count"] = report.outside_triangle_count;
  dict["wide_triangle_count"] = report.wide_triangle_count;
  dict["texel_count"] = report.texel_count;
  dict["covered_texel_count"] = report.covered_texel_count;
  dict["overlapping_texel_count"] = report.overlapping_texel_count;
  dict["empty_texel_count"] = report.empty_texel_count;
  dict["receiver_count"] = report.receiver_count;
  dict["missed_receiver_count"] = report.missed_receiver_count;
  return dict;
}

double diagonal_of(const scene::Mesh& mesh) {
  const Bounds box = scene::bounds_of(mesh);
  return glm::length(glm::dvec3(box.upper) - glm::dvec3(box.lower));
}

// A share of the tiles of texels, by number, of so many.
using Part = std::pair<std::size_t, std::size_t>;

// Texels are counted a tile at a time, and a tile may take long: in between the caller is told the same again.
bake::TextureBake bake_with(const AmbientOcclusion& ao, const Surface& surface, const Bounds& occluders,
                            const TextureOptions& options, const std::optional<Part>& part, const Progress& watch) {
  std::size_t done = 0, total = 0;
  const bake::Ask ask = [&](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first) {
    ao.query(receivers, outputs, first, [&](std::size_t, std::size_t) { return watch(done, total); });
  };
  const Progress progress = [&](std::size_t texel_count, std::size_t of_all) {
    done = texel_count, total = of_all;
    return watch(done, total);
  };
  if (!part) return bake::bake_texture(surface.normals(), occluders, options, ask, progress);
  return bake::bake_texels(surface.normals(), occluders, options, ask, {part->first, part->second}, progress);
}

// Maps and the report. `extrusion`: 0 for the usual one; only where there is a detailed surface. Those of a part are
// still to be put together and finished.
py::tuple bake_texture(const AmbientOcclusion& ao, const Surface& surface, const std::pair<Triple, Triple>& occluders,
                       TextureOptions options, const Surface* detailed, double extrusion,
                       const std::optional<Part>& part, int thread_count, const py::object& progress) {
  const Bounds box{glm::vec3(vector_of(occluders.first)), glm::vec3(vector_of(occluders.second))};
  std::optional<bake::Cage> cage;
  bake::TextureBake bake = long_call(thread_count, progress, [&](const Progress& watch) {
    if (detailed != nullptr) {
      const double distance = extrusion > 0 ? extrusion : kUsualExtrusion * diagonal_of(surface.mesh());
      options.cage = &cage.emplace(detailed->normals(), surface.mesh(), distance);
    }
    return bake_with(ao, surface, box, options, part, watch);
  });
  const std::size_t dropped_count = surface.dropped_count(options.material);
  bake.report.triangle_count += dropped_count;
  bake.report.flat_triangle_count += dropped_count;
  return py::make_tuple(list_of(std::move(bake.maps)), dict_of(bake.report));
}

// Finished maps, and what the report has of seams.
py::tuple finish_texture(const Surface& surface, const TextureOptions& options, const py::list& maps) {
  bake::TextureBake bake;
  bake.maps.reserve(maps.size());
  std::vector<int> udims;
  udims.reserve(maps.size());
  for (const py::handle& map : maps) {
    bake.maps.push_back(map_of(py::cast<py::tuple>(map), options));
    udims.push_back(bake.maps.back().udim);
  }
  require(udims == bake::TextureLayout(surface.normals(), options).udims(), kOtherBake);
  long_call(0, py::none(),
            [&](const Progress& watch) { bake::finish_texture(surface.normals(), options, bake, watch); });
  return py::make_tuple(list_of(std::move(bake.maps)), seams_of(bake.report));
}

}  // namespace

void bind_textures(py::module_& module) {
  py::class_<TextureOptions>(module, "TextureOptions")
      .def(py::init(&make_texture_options), py::arg("width"), py::arg("height"), py::arg("wrap_u"), py::arg("wrap_v"),
           py::arg("udim"), py::arg("material"), py::arg("grid"), py::arg("bent_normals"), py::arg("thickness"),
           py::arg("level_seams"), py::arg("margin"));
  module.def("bake_texture", &bake_texture, py::arg("query"), py::arg("surface"), py::arg("occluders"),
             py::arg("options"), py::arg("detailed"), py::arg("extrusion"), py::arg("part"), py::arg("thread_count"),
             py::arg("progress"));
  module.def("finish_texture", &finish_texture, py::arg("surface"), py::arg("options"), py::arg("maps"));
}

}  // namespace lkao::python
