#include "cli/texture_report.h"

#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/normals_option.h"
#include "cli/report.h"

namespace lkao::cli {
namespace {

using bake::TextureReport;

Json material_json(const MaterialBake& material) {
  const TextureReport& report = material.bake.report;
  return {{"name", material.name},
          {"maps", material.bake.maps.size()},
          {"triangles", report.triangle_count},
          {"texels", report.texel_count},
          {"covered_texels", report.covered_texel_count},
          {"empty_texels", report.empty_texel_count},
          {"missed_points", report.missed_receiver_count},
          {"overlapping_texels", report.overlapping_texel_count},
          {"triangles_without_uvs", report.bare_triangle_count},
          {"flat_triangles", report.flat_triangle_count},
          {"mirrored_triangles", report.mirrored_triangle_count},
          {"triangles_outside", report.outside_triangle_count},
          {"wide_triangles", report.wide_triangle_count},
          {"seams", report.seam_count},
          {"worst_seam_before", report.worst_seam_before},
          {"worst_seam", report.worst_seam_after}};
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return count == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", grouped(count), many);
}

void say(const TextureBaking& result, const MaterialBake& material, const std::string& what) {
  const std::string name = result.materials.size() > 1 ? ": " + material.name : "";
  fmt::print(stderr, "lkao: {}{}: {}\n", result.baking.scene.name, name, what);
}

}  // namespace

Json texture_document(const BakingOptions& options, const TextureSettings& settings, const TextureBaking& result) {
  const Baking& baking = result.baking;
  Json document;
  document["method"] = options.method.kind->word;
  document["scene"] = options.scene.name;
  document["radius"] = baking.radius;
  document["samples"] = options.occlusion.ray_count;
  document["width"] = settings.size->width;
  document["height"] = settings.size->height;
  document["uv"] = settings.uv_set;
  document["grid"] = settings.grid;
  document["normals"] = word_of(kNormalSourceWords, baking.normals);
  document["receivers"] = baking.receiver_count;
  add_batch_keys(document, *options.method.kind, baking.batch, result.occlusion_mean());
  document["materials"] = Json::array();
  for (const MaterialBake& material : result.materials) document["materials"].push_back(material_json(material));
  add_setting_keys(document, options.occlusion);
  add_remark_keys(document, baking.remarks);
  add_scene_keys(document, baking.scene);
  add_surroundings_keys(document, options.scene, baking.scene);
  document["build_seconds"] = baking.build_seconds;
  return document;
}

void print_texture_table(const BakingOptions& options, const TextureSettings& settings, const TextureBaking& result,
                         const std::vector<std::string>& written) {
  const Baking& baking = result.baking;
  Table table;
  add_scene_row(table, baking.scene);
  add_surroundings_row(table, options.scene, baking.scene);
  table.add("prepared",
            fmt::format("{:.3f} s to load, {:.3f} s to build", baking.scene.load_seconds, baking.build_seconds));
  table.add("normals", std::string(word_of(kNormalSourceWords, baking.normals)));
  for (const MaterialBake& material : result.materials) {
    const TextureReport& report = material.bake.report;
    table.add(
        material.name,
        fmt::format("{} of {} x {}, {:.1f} % covered, seams differ by {:.2f}/255 at most",
                    counted(material.bake.maps.size(), "map", "maps"), settings.size->width, settings.size->height,
                    100.0 * static_cast<double>(report.covered_texel_count) / static_cast<double>(report.texel_count),
                    255 * report.worst_seam_after));
  }
  table.add("receivers", grouped(baking.receiver_count));
  method::Batch batch = baking.batch;
  add_batch_rows(table, *options.method.kind, baking.batch, result.occlusion_mean());
  table.add("wrote", fmt::format("{}", fmt::join(written, ", ")));
  table.print();
}

void report_texture_oddities(const TextureBaking& result) {
  for (const MaterialBake& material : result.materials) {
    const TextureReport& report = material.bake.report;
    const auto tell = [&](std::size_t count, const char* one, const char* many, const char* what) {
      if (count > 0) say(result, material, counted(count, one, many) + what);
    };
    tell(report.overlapping_texel_count, "texel is", "texels are",
         " wanted by several places of the surface: the texture coordinates overlap, and the first triangle has it");
    tell(report.bare_triangle_count, "triangle has", "triangles have", " no texture coordinates: not baked");
    tell(report.flat_triangle_count, "triangle has", "triangles have", " no area in the texture: not baked");
    tell(report.outside_triangle_count, "triangle reaches", "triangles reach",
         " out of the texture, which does not repeat: not baked there");
    tell(report.wide_triangle_count, "triangle covers", "triangles cover",
         " the texture more than 64 times over: baked in part");
    tell(report.missed_receiver_count, "point is", "points are",
         " farther from the detailed surface than --extrusion: occlusion there is that of the scene's own surface");
    tell(report.empty_texel_count, "texel has", "texels have", " no receiver with a usable normal: filled from around");
  }
}

}  // namespace lkao::cli
