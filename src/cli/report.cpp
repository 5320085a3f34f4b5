#include "cli/report.h"

#include <algorithm>

#include <fmt/format.h>

#include "lkao/isa.h"

namespace lkao::cli {
namespace {

std::string speed_text(std::uint64_t ray_count, double seconds) {
  return fmt::format("{:.3f} s, {:.2f} Mrays/s", seconds, mrays_per_second(ray_count, seconds));
}

Json check_json(const BatchCheck& check) {
  return {{"method", name_of(check.method)},
          {"mismatched_rays", check.mismatched_ray_count},
          {"ray_mismatch_rate", check.ray_mismatch_rate},
          {"mae", check.occlusion.mae},
          {"rmse", check.occlusion.rmse},
          {"max_error", check.occlusion.max_error},
          {"seconds", check.seconds}};
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

Json vector_json(const glm::vec3& vector) { return {vector.x, vector.y, vector.z}; }

void add_scene_row(Table& table, const SceneInput& scene) {
  table.add("scene", fmt::format("{}, {} triangles", scene.name, grouped(scene.mesh.triangles.size())));
}

void add_batch_rows(Table& table, Method method, const Batch& batch) {
  table.add("rays", grouped(batch.ray_count));
  table.add(name_of(method), speed_text(batch.ray_count, batch.seconds));
  if (batch.check) {
    const BatchCheck& check = *batch.check;
    table.add(name_of(check.method), speed_text(batch.ray_count, check.seconds));
    table.add("difference", fmt::format("mismatched rays {} (rate {:.3g}), MAE {:.3g}, RMSE {:.3g}, maximum {:.3g}",
                                        grouped(check.mismatched_ray_count), check.ray_mismatch_rate,
                                        check.occlusion.mae, check.occlusion.rmse, check.occlusion.max_error));
  }
  table.add("mean occlusion", fmt::format("{:.4f}", batch.occlusion_mean()));
}

void add_batch_keys(Json& document, const Batch& batch) {
  document["rays"] = batch.ray_count;
  document["seconds"] = batch.seconds;
  document["mrays_per_second"] = mrays_per_second(batch.ray_count, batch.seconds);
  document["occlusion_mean"] = batch.occlusion_mean();
  if (batch.check) document["reference"] = check_json(*batch.check);
}

void add_setting_keys(Json& document, const OcclusionOptions& options) {
  document["falloff"] = options.falloff.name();
  document["sided"] = options.sidedness == Sidedness::one_sided ? "one" : "two";
  document["seed"] = options.seed;
  document["threads"] = tbb::this_task_arena::max_concurrency();
}

void add_kernel_keys(Json& document, const OcclusionOptions& options) {
  document["kernel"] = name_of(options.kernel.value_or(KernelChoice::simd));
  document["isa"] = active_isa();
}

void add_scene_keys(Json& document, const SceneInput& scene) {
  document["triangles"] = scene.mesh.triangles.size();
  document["dropped"] = {{"zero_area", scene.defects.zero_area_count}, {"non_finite", scene.defects.non_finite_count}};
  document["load_seconds"] = scene.load_seconds;
}

}  // namespace lkao::cli
