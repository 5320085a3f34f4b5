#include "cli/scene_input.h"

#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/alpha_image.h"
#include "method/stopwatch.h"
#include "scene/ground.h"
#include "scene/load.h"

namespace lkao::cli {
namespace {

// The mesh of a file without what is bad about it, all of which is noted.
scene::Mesh usable_mesh(const std::string& name, scene::MeshFile file, scene::Defects& defects,
                        std::vector<std::string>& notes) {
  for (std::string& note : notes_on(name, file)) notes.push_back(std::move(note));
  defects = scene::find_defects(file.mesh);
  const auto note_dropped = [&](std::size_t count, const char* kind) {
    if (count > 0)
      notes.push_back(fmt::format("{}: dropped {} {} triangle{}", name, count, kind, count == 1 ? "" : "s"));
  };
  note_dropped(defects.zero_area_count, "zero-area");
  note_dropped(defects.non_finite_count, "non-finite");
  scene::drop_bad_triangles(file.mesh);
  if (file.mesh.triangles.empty()) {
    throw std::runtime_error(fmt::format("{}: no triangles left after dropping {} zero-area and {} non-finite", name,
                                         defects.zero_area_count, defects.non_finite_count));
  }
  return std::move(file.mesh);
}

// None where holes are not to be read.
scene::DecodeAlpha alpha_decoder(bool is_opaque) { return is_opaque ? nullptr : scene::DecodeAlpha(decode_alpha); }

}  // namespace

const scene::BuiltinScene* find_builtin(const std::string& name) {
  constexpr std::string_view kPrefix = "builtin:";
  return name.starts_with(kPrefix) ? &scene::builtin_scene(name.substr(kPrefix.size())) : nullptr;
}

scene::SuggestedRadii suggest_radii(const std::string& name, const Bounds& bounds) {
  const scene::BuiltinScene* const builtin = find_builtin(name);
  return builtin != nullptr ? builtin->radii : scene::suggest_radii(bounds);
}

SceneInput load_scene(const SceneOptions& options) {
  const method::Stopwatch watch;
  SceneInput scene;
  scene.name = options.name;
  scene.opaque = options.opaque;
  scene::MeshFile file = scene::open(
      options.name,
      {.uv_set = options.uv_set, .objects = options.own_object, .decode_alpha = alpha_decoder(scene.opaque)});
  if (options.own_object && file.mesh.objects.empty()) {
    throw std::runtime_error(fmt::format(
        "--own-object: {} names no objects; the nodes of a glTF are some, and what an .obj has under \"o\" or \"g\"",
        options.name));
  }
  scene.contents = file.contents;
  scene.mesh = usable_mesh(options.name, std::move(file), scene.defects, scene.notes);
  if (options.flip) scene::turn_round(scene.mesh);
  scene.load_seconds = watch.seconds();
  return scene;
}

scene::Mesh load_beside(const std::string& file, SceneInput& scene) {
  scene::Defects defects;
  return usable_mesh(
      file, scene::open_mesh_file(file, {.origin = scene.mesh.origin, .decode_alpha = alpha_decoder(scene.opaque)}),
      defects, scene.notes);
}

void add_surroundings(SceneInput& scene, const SceneOptions& options, const glm::vec3& up, double radius) {
  if (options.ground) {
    scene.with_ground = scene.mesh;
    scene::append(*scene.with_ground, scene::make_ground(scene.mesh, up, radius));
  }
  if (options.blockers.empty()) return;
  scene.with_blockers = scene.seen();
  for (const std::string& file : options.blockers) {
    scene::append(*scene.with_blockers, load_beside(file, scene));
  }
}

double resolve_radius(const std::optional<method::Radius>& radius, const SceneInput& scene) {
  const Bounds bounds = scene::bounds_of(scene.mesh);
  if (radius) return radius->in(bounds);
  const scene::SuggestedRadii suggested = suggest_radii(scene.name, bounds);
  throw std::invalid_argument(
      fmt::format("--radius is required; {} (small) or {} (large) would suit {}, or a percentage of its diagonal",
                  suggested.small, suggested.large, scene.name));
}

std::vector<std::string> notes_on(const std::string& name, const scene::MeshFile& file) {
  std::vector<std::string> notes;
  const glm::dvec3& origin = file.mesh.origin;
  if (origin != glm::dvec3(0)) {
    notes.push_back(
        fmt::format("{}: positions are taken relative to ({}, {}, {})", name, origin.x, origin.y, origin.z));
  }
  for (const std::string& remark : file.contents.remarks) notes.push_back(name + ": " + remark);
  return notes;
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) fmt::print(stderr, "lkao: {}\n", note);
}

}  // namespace lkao::cli
