/* What a host in C, or in any C++, includes: only looked at. */
#include <lkao/c.h>

int main(void) {
  const lkao_mesh mesh = LKAO_MESH_INIT;
  const lkao_build_options build_options = LKAO_BUILD_OPTIONS_INIT;
  const lkao_build_report build_report = LKAO_BUILD_REPORT_INIT;
  const lkao_refit_options refit_options = LKAO_REFIT_OPTIONS_INIT;
  const lkao_falloff falloff = LKAO_FALLOFF_INIT;
  const lkao_pattern_options pattern_options = LKAO_PATTERN_OPTIONS_INIT;
  const lkao_table_options table_options = LKAO_TABLE_OPTIONS_INIT;
  const lkao_table_report table_report = LKAO_TABLE_REPORT_INIT;
  const lkao_ray_options ray_options = LKAO_RAY_OPTIONS_INIT;
  const lkao_instance instance = LKAO_INSTANCE_INIT;
  const lkao_mesh_instance mesh_instance = LKAO_MESH_INSTANCE_INIT;
  const lkao_scene_report scene_report = LKAO_SCENE_REPORT_INIT;
  const lkao_level level = LKAO_LEVEL_INIT;
  const lkao_receiver receiver = LKAO_RECEIVER_INIT;
  const lkao_answer answer = LKAO_ANSWER_INIT;
  const lkao_rays rays = LKAO_RAYS_INIT;
  const lkao_receivers receivers = LKAO_RECEIVERS_INIT;
  const lkao_outputs outputs = LKAO_OUTPUTS_INIT;
  const lkao_batch_options batch_options = LKAO_BATCH_OPTIONS_INIT;
  const lkao_bundle bundle = LKAO_BUNDLE_INIT;
  const lkao_light light = LKAO_LIGHT_INIT;
  const lkao_shadow_options shadow_options = LKAO_SHADOW_OPTIONS_INIT;
  const lkao_visibility visibility = LKAO_VISIBILITY_INIT;
  const lkao_shadow_outputs shadow_outputs = LKAO_SHADOW_OUTPUTS_INIT;
  const lkao_sky_options sky_options = LKAO_SKY_OPTIONS_INIT;
  const lkao_query_report query_report = LKAO_QUERY_REPORT_INIT;
  const size_t size = mesh.size + build_options.size + build_report.size + refit_options.size + falloff.size +
                      pattern_options.size + table_options.size + table_report.size + ray_options.size + level.size +
                      instance.size + mesh_instance.size + scene_report.size + receiver.size + answer.size + rays.size +
                      receivers.size + outputs.size + batch_options.size + query_report.size + bundle.size +
                      light.size + shadow_options.size + visibility.size + shadow_outputs.size + sky_options.size;
  return size > 0 && LKAO_VERSION >= LKAO_MAKE_VERSION(0, 1, 0) ? 0 : 1;
}
