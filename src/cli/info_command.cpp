// lkao info: what is in a scene, and what is wrong with it.
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/report.h"
#include "cli/scene_input.h"
#include "scene/builtin.h"
#include "scene/defects.h"
#include "scene/load.h"

namespace lkao::cli {
namespace {

struct InfoOptions {
  std::string scene;
  bool list = false;
  CommonOptions common;
};

// What can be said of a scene that has an extent.
struct Extent {
  Bounds bounds;
  double diagonal = 0;
  scene::SuggestedRadii radii;
};

struct Findings {
  std::size_t triangle_count = 0;
  std::size_t vertex_count = 0;
  scene::Defects defects;
  std::optional<Extent> extent;  // none where no vertex is finite
};

Findings examine(const std::string& name, const scene::Mesh& mesh) {
  Findings findings;
  findings.triangle_count = mesh.triangles.size();
  findings.vertex_count = mesh.positions.size();
  findings.defects = scene::find_defects(mesh);
  const Bounds bounds = scene::bounds_of(mesh);
  if (bounds.lower.x <= bounds.upper.x) {
    const double diagonal = glm::distance(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper));
    findings.extent = Extent{bounds, diagonal, suggest_radii(name, bounds)};
  }
  return findings;
}

Json document_of(const InfoOptions& options, const Findings& findings) {
  const scene::Defects& defects = findings.defects;
  Json document;
  document["scene"] = options.scene;
  document["triangles"] = findings.triangle_count;
  document["vertices"] = findings.vertex_count;
  document["bounds"] = nullptr;
  document["diagonal"] = nullptr;
  document["defects"] = {{"zero_area", defects.zero_area_count},
                         {"non_finite", defects.non_finite_count},
                         {"duplicate", defects.duplicate_count},
                         {"unused_vertices", defects.unused_vertex_count}};
  document["suggested_radii"] = nullptr;
  if (const auto& extent = findings.extent) {
    document["bounds"] = {{"lower", vector_json(extent->bounds.lower)}, {"upper", vector_json(extent->bounds.upper)}};
    document["diagonal"] = extent->diagonal;
    document["suggested_radii"] = {{"small", extent->radii.small}, {"large", extent->radii.large}};
  }
  return document;
}

void print_table(const InfoOptions& options, const Findings& findings) {
  const scene::Defects& defects = findings.defects;
  const auto point = [](const glm::vec3& p) { return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z); };
  Table table;
  table.add("scene", options.scene);
  table.add("triangles", grouped(findings.triangle_count));
  table.add("vertices", grouped(findings.vertex_count));
  if (const auto& extent = findings.extent) {
    table.add("bounds", point(extent->bounds.lower) + " .. " + point(extent->bounds.upper));
    table.add("diagonal", fmt::format("{:g}", extent->diagonal));
    table.add("suggested radii", fmt::format("{:g} (small), {:g} (large)", extent->radii.small, extent->radii.large));
  }
  table.add("zero-area triangles", grouped(defects.zero_area_count));
  table.add("non-finite triangles", grouped(defects.non_finite_count));
  table.add("duplicate triangles", grouped(defects.duplicate_count));
  table.add("unused vertices", grouped(defects.unused_vertex_count));
  table.print();
}

void list_builtin_scenes(const InfoOptions& options, const JsonOutput& json) {
  Json scenes = Json::array();
  Table table;
  for (const scene::BuiltinScene& scene : scene::builtin_scenes()) {
    scenes.push_back({{"scene", "builtin:" + scene.name}, {"description", scene.description}});
    table.add("builtin:" + scene.name, scene.description);
  }
  json.write_and_commit({{"builtin_scenes", scenes}});
  if (options.common.wants_table()) table.print();
}

void info(const InfoOptions& options) {
  OutputFiles outputs({options.scene});
  const JsonOutput json(options.common.json_path, outputs);
  if (options.list || options.scene.empty()) return list_builtin_scenes(options, json);
  const Findings findings = examine(options.scene, scene::load(options.scene));
  json.write_and_commit(document_of(options, findings));
  if (options.common.wants_table()) print_table(options, findings);
}

void add_options(CLI::App& app, InfoOptions& options) {
  auto* const scene =
      app.add_option("scene", options.scene, "A mesh file (OBJ, PLY, STL, OFF, glTF, GLB) or builtin:NAME");
  scene->type_name("SCENE");
  app.add_flag("--list", options.list, "List the built-in scenes, as without a scene")->excludes(scene);
  add_common_options(app, options.common);
}

}  // namespace

Command add_info_command(CLI::App& program) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* const app = program.add_subcommand("info", "Show counts, bounds, defects and suggested radii of a scene");
  add_options(*app, *options);
  const auto run = [options] {
    with_threads(options->common.thread_count, [&] { info(*options); });
    return kSuccess;
  };
  return {app, run};
}

}  // namespace lkao::cli
