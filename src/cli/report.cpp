#include "cli/report.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "method/speed.h"

namespace lkao::cli {

using method::Batch, method::BatchCheck, method::Deviation, method::MethodKind, method::Remarks,
    method::mrays_per_second;

namespace {

std::string speed_text(std::uint64_t ray_count, double seconds) {
  if (ray_count == 0) return fmt::format("{:.3f} s", seconds);  // not every method casts rays
  return fmt::format("{:.3f} s, {:.2f} Mrays/s", seconds, mrays_per_second(ray_count, seconds));
}

Json check_json(const MethodKind& kind, const BatchCheck& check) {
  const Deviation& off = check.deviation;
  return {{"method", kind.word},
          {"mismatched_rays", off.wrong_ray_count ? Json(*off.wrong_ray_count) : Json()},
          {"ray_mismatch_rate", off.mismatch_rate},
          {"mae", off.error.mae},
          {"rmse", off.error.rmse},
          {"max_error", off.error.max_error},
          {"seconds", check.seconds}};
}

// "mismatched rays 3 (rate 1e-05), ": nothing where rays were not compared.
std::string ray_text(const Deviation& off) {
  if (!off.wrong_ray_count) return "";
  return fmt::format("mismatched rays {} (rate {:.3g}), ", grouped(*off.wrong_ray_count), off.mismatch_rate);
}

}  // namespace

void Table::print() const {
  std::size_t width = 0;
  for (const auto& [label, text] : rows_) width = std::max(width, label.size());
  for (const auto& [label, text] : rows_) fmt::print("{:<{}}  {}\n", label, width, text);
}

std::string grouped(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t place = text.size(); place > 3; place -= 3) text.insert(place - 3, 1, ',');
  return text;
}

Json vector_json(const glm::dvec3& vector) { return {vector.x, vector.y, vector.z}; }

Json position_json(const glm::vec3& position, const glm::dvec3& origin) {
  return vector_json(glm::dvec3(position) + origin);
}

void add_scene_row(Table& table, const SceneInput& scene) {
  table.add("scene", fmt::format("{}, {} triangles", scene.name, grouped(scene.mesh.triangles.size())));
}

void add_batch_rows(Table& table, const MethodKind& kind, const Batch& batch, double occlusion_mean) {
  table.add("rays", grouped(batch.ray_count));
  table.add(std::string(kind.word), speed_text(batch.ray_count, batch.seconds));
  if (batch.check) {
    const Deviation& off = batch.check->deviation;
    table.add(std::string(reference_of(kind).word), speed_text(batch.ray_count, batch.check->seconds));
    table.add("difference", fmt::format("{}MAE {:.3g}, RMSE {:.3g}, maximum {:.3g}", ray_text(off), off.error.mae,
                                        off.error.rmse, off.error.max_error));
  }
  table.add("mean occlusion", fmt::format("{:.4f}", occlusion_mean));
}

void add_batch_keys(Json& document, const MethodKind& kind, const Batch& batch, double occlusion_mean) {
  document["rays"] = batch.ray_count;
  document["seconds"] = batch.seconds;
  document["mrays_per_second"] = mrays_per_second(batch.ray_count, batch.seconds);
  document["occlusion_mean"] = occlusion_mean;
  if (batch.check) document["reference"] = check_json(reference_of(kind), *batch.check);
}

void add_setting_keys(Json& document, const OcclusionOptions& options) {
  document["weighting"] = word_of(method::kWeightingWords, options.weighting);
  document["falloff"] = options.falloff.name();
  document["sided"] = word_of(method::kSidednessWords, options.sidedness);
  document["seed"] = options.seed;
  document["min_distance"] = options.min_distance;
  document["threads"] = tbb::this_task_arena::max_concurrency();
}

void add_remark_rows(Table& table, const Remarks& remarks) {
  for (const auto& [label, text] : remarks.rows) table.add(label, text);
}

void add_remark_keys(Json& document, const Remarks& remarks) { document.update(remarks.keys); }

void add_scene_keys(Json& document, const SceneInput& scene) {
  document["triangles"] = scene.mesh.triangles.size();
  document["dropped"] = {{"zero_area", scene.defects.zero_area_count}, {"non_finite", scene.defects.non_finite_count}};
  document["origin"] = vector_json(scene.mesh.origin);
  document["load_seconds"] = scene.load_seconds;
}

void add_surroundings_row(Table& table, const SceneOptions& options, const SceneInput& scene) {
  if (!options.has_surroundings()) return;
  std::string text = options.ground ? "a ground" : "";
  for (const std::string& file : options.blockers) text += (text.empty() ? "" : ", ") + file;
  table.add("also block", fmt::format("{}: {} triangles", text,
                                      grouped(scene.occluders().triangles.size() - scene.mesh.triangles.size())));
}

void add_surroundings_keys(Json& document, const SceneOptions& options, const SceneInput& scene) {
  if (options.flip) document["flipped"] = true;
  if (options.own_object) document["own_objects"] = scene.contents.object_count;
  if (!options.has_surroundings()) return;
  document["occluders"] = {
      {"triangles", scene.occluders().triangles.size()}, {"ground", options.ground}, {"blockers", options.blockers}};
}

void report_fully_blocked(const SceneInput& scene, const std::string& what, const Batch& batch, double radius) {
  constexpr double kMost = 0.5;
  const Bounds bounds = scene::bounds_of(scene.mesh);
  const double share = batch.fully_blocked_share();
  if (!(share > kMost) || radius >= glm::distance(bounds.lower, bounds.upper)) return;
  fmt::print(stderr,
             "lkao: {}: most {} ({:.0f} %) are fully blocked: is the mesh inside out (--flip), or do parts pierce each "
             "other?\n",
             scene.name, what, 100 * share);
}

}  // namespace lkao::cli
