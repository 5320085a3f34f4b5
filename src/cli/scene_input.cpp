#include "cli/scene_input.h"

#include <cstdio>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "method/stopwatch.h"
#include "scene/load.h"

namespace lkao::cli {

const scene::BuiltinScene* find_builtin(const std::string& name) {
  constexpr std::string_view kPrefix = "builtin:";
  return name.starts_with(kPrefix) ? &scene::builtin_scene(name.substr(kPrefix.size())) : nullptr;
}

scene::SuggestedRadii suggest_radii(const std::string& name, const Bounds& bounds) {
  const scene::BuiltinScene* const builtin = find_builtin(name);
  return builtin != nullptr ? builtin->radii : scene::suggest_radii(bounds);
}

SceneInput load_scene(const std::string& name) {
  const method::Stopwatch watch;
  SceneInput scene{.name = name, .mesh = scene::load(name), .defects = {}, .load_seconds = 0};
  scene.defects = scene::find_defects(scene.mesh);
  scene::drop_bad_triangles(scene.mesh);
  if (scene.mesh.triangles.empty()) {
    throw std::runtime_error(fmt::format("{}: no triangles left after dropping {} zero-area and {} non-finite", name,
                                         scene.defects.zero_area_count, scene.defects.non_finite_count));
  }
  scene.load_seconds = watch.seconds();
  return scene;
}

void require_radius(const std::optional<double>& radius, const SceneInput& scene) {
  if (radius) return;
  const scene::SuggestedRadii suggested = suggest_radii(scene.name, scene::bounds_of(scene.mesh));
  throw std::invalid_argument(fmt::format("--radius is required; {} (small) or {} (large) would suit {}",
                                          suggested.small, suggested.large, scene.name));
}

void report_dropped_triangles(const SceneInput& scene) {
  const auto report = [&](std::size_t count, const char* kind) {
    if (count == 0) return;
    fmt::print(stderr, "lkao: {}: dropped {} {} triangle{}\n", scene.name, count, kind, count == 1 ? "" : "s");
  };
  report(scene.defects.zero_area_count, "zero-area");
  report(scene.defects.non_finite_count, "non-finite");
}

}  // namespace lkao::cli
