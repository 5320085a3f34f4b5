// Occlusion as textures of a mesh.
#include <cstddef>
#include <memory>
#include <utility>

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

// By the names of the class that users see.
py::dict dict_of(const TextureReport& report) {
  py::dict dict;
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
  dict["seam_count"] = report.seam_count;
  dict["worst_seam_before"] = report.worst_seam_before;
  dict["worst_seam_after"] = report.worst_seam_after;
  return dict;
}

double diagonal_of(const scene::Mesh& mesh) {
  const Bounds box = scene::bounds_of(mesh);
  return glm::length(glm::dvec3(box.upper) - glm::dvec3(box.lower));
}

// Texels are counted a tile at a time, and a tile may take long: in between the caller is told the same again.
bake::TextureBake bake_with(const AmbientOcclusion& ao, const Surface& surface, const Bounds& occluders,
                            const TextureOptions& options, const Progress& watch) {
  const std::size_t map_count =
      options.udim ? bake::TextureLayout(surface.normals(), options).udims().size() : std::size_t{1};
  const std::size_t total =
      map_count * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  std::size_t done = 0;
  const bake::Ask ask = [&](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first) {
    ao.query(receivers, outputs, first, [&](std::size_t, std::size_t) { return watch(done, total); });
  };
  return bake::bake_texture(surface.normals(), occluders, options, ask, [&](std::size_t count, std::size_t) {
    done = count;
    return watch(done, total);
  });
}

// `extrusion`: 0 for the usual one; only where there is a detailed surface.
py::tuple bake_texture(const AmbientOcclusion& ao, const Surface& surface, const std::pair<Triple, Triple>& occluders,
                       TextureOptions options, const Surface* detailed, double extrusion, int thread_count,
                       const py::object& progress) {
  const Bounds box{glm::vec3(vector_of(occluders.first)), glm::vec3(vector_of(occluders.second))};
  bake::TextureBake bake = long_call(thread_count, progress, [&](const Progress& watch) {
    std::optional<bake::Cage> cage;
    if (detailed != nullptr) {
      const double distance = extrusion > 0 ? extrusion : kUsualExtrusion * diagonal_of(surface.mesh());
      options.cage = &cage.emplace(detailed->normals(), surface.mesh(), distance);
    }
    return bake_with(ao, surface, box, options, watch);
  });
  const std::size_t dropped_count = surface.dropped_count(options.material);
  bake.report.triangle_count += dropped_count;
  bake.report.flat_triangle_count += dropped_count;
  py::list maps;
  for (TextureMap& map : bake.maps) maps.append(tuple_of(std::move(map)));
  return py::make_tuple(maps, dict_of(bake.report));
}

}  // namespace

void bind_textures(py::module_& module) {
  py::class_<TextureOptions>(module, "TextureOptions")
      .def(py::init(&make_texture_options), py::arg("width"), py::arg("height"), py::arg("wrap_u"), py::arg("wrap_v"),
           py::arg("udim"), py::arg("material"), py::arg("grid"), py::arg("bent_normals"), py::arg("thickness"),
           py::arg("level_seams"), py::arg("margin"));
  module.def("bake_texture", &bake_texture, py::arg("query"), py::arg("surface"), py::arg("occluders"),
             py::arg("options"), py::arg("detailed"), py::arg("extrusion"), py::arg("thread_count"),
             py::arg("progress"));
}

}  // namespace lkao::python
