// lkao info: what is in a scene, and what is wrong with it.
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include "cli/alpha_image.h"
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
  Bounds bounds;  // less the origin
  double diagonal = 0;
  scene::SuggestedRadii radii;

  double percentage(float radius) const { return 100 * double{radius} / diagonal; }
};

struct Findings {
  std::size_t triangle_count = 0;
  std::size_t vertex_count = 0;
  std::size_t normal_count = 0;                 // that came with the file
  std::size_t corner_without_normal_count = 0;  // of all triangles' corners
  glm::dvec3 origin{0};
  scene::Contents contents;
  scene::Defects defects;
  std::optional<Extent> extent;  // none where no vertex is finite
};

Findings examine(const std::string& name, const scene::MeshFile& file) {
  const scene::Mesh& mesh = file.mesh;
  Findings findings;
  findings.normal_count = mesh.normals.size();
  findings.corner_without_normal_count = scene::count_corners_without_normal(mesh);
  findings.origin = mesh.origin;
  findings.contents = file.contents;
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

void add_contents(Json& document, const Findings& findings) {
  const scene::Contents& contents = findings.contents;
  document["origin"] = vector_json(findings.origin);
  document["normals"] = {{"count", findings.normal_count}, {"corners_without", findings.corner_without_normal_count}};
  document["nodes"] = contents.node_count;
  document["instances"] = contents.instance_count;
  document["hidden_nodes"] = contents.hidden_count;
  document["uv_sets"] = contents.uv_set_count;
  document["cut_out_triangles"] = contents.cut_out_count;
  document["remarks"] = contents.remarks;
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
    document["bounds"] = {{"lower", position_json(extent->bounds.lower, findings.origin)},
                          {"upper", position_json(extent->bounds.upper, findings.origin)}};
    document["diagonal"] = extent->diagonal;
    document["suggested_radii"] = {{"small", extent->radii.small},
                                   {"large", extent->radii.large},
                                   {"small_percent", extent->percentage(extent->radii.small)},
                                   {"large_percent", extent->percentage(extent->radii.large)}};
  }
  add_contents(document, findings);
  return document;
}

// Far from zero more digits are needed to tell places apart.
std::string position_text(const glm::vec3& p, const glm::dvec3& origin) {
  if (origin == glm::dvec3(0)) return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z);
  const glm::dvec3 sum = glm::dvec3(p) + origin;
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", sum.x, sum.y, sum.z);
}

// Of what not every format has, only what is there.
void add_contents(Table& table, const Findings& findings) {
  const scene::Contents& contents = findings.contents;
  const auto add_some = [&](const char* label, std::size_t count) {
    if (count > 0) table.add(label, grouped(count));
  };
  if (findings.origin != glm::dvec3(0)) table.add("origin", position_text(glm::vec3(0), findings.origin));
  if (findings.normal_count > 0) {
    table.add("normals", fmt::format("{}; {} corners have none", grouped(findings.normal_count),
                                     grouped(findings.corner_without_normal_count)));
  }
  add_some("nodes", contents.node_count);
  add_some("instances", contents.instance_count);
  add_some("hidden nodes", contents.hidden_count);
  add_some("UV sets", contents.uv_set_count);
  add_some("cut-out triangles", contents.cut_out_count);
}

void print_table(const InfoOptions& options, const Findings& findings) {
  const scene::Defects& defects = findings.defects;
  const auto point = [&](const glm::vec3& p) { return position_text(p, findings.origin); };
  Table table;
  table.add("scene", options.scene);
  table.add("triangles", grouped(findings.triangle_count));
  table.add("vertices", grouped(findings.vertex_count));
  if (const auto& extent = findings.extent) {
    table.add("bounds", point(extent->bounds.lower) + " .. " + point(extent->bounds.upper));
    table.add("diagonal", fmt::format("{:g}", extent->diagonal));
    const auto radius = [&](float length, const char* size) {
      return fmt::format("{:g} ({}, {:.2g} % of the diagonal)", length, size, extent->percentage(length));
    };
    table.add("suggested radii", fmt::format("{}, {}, in the file's unit", radius(extent->radii.small, "small"),
                                             radius(extent->radii.large, "large")));
  }
  add_contents(table, findings);
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
  const scene::MeshFile file = scene::open(options.scene, {.decode_alpha = decode_alpha});
  const Findings findings = examine(options.scene, file);
  print_notes(notes_on(options.scene, file));
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
  CLI::App* const app =
      program.add_subcommand("info", "Show what is in a scene, what is wrong with it, and radii that suit it");
  add_options(*app, *options);
  const auto run = [options] {
    with_threads(options->common.thread_count, [&] { info(*options); });
    return kSuccess;
  };
  return {app, run};
}

}  // namespace lkao::cli
