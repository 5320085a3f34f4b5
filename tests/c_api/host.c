/* A host in plain C that calls every function of lkao/c.h, linked to liblkao_c alone. Prints nothing but what is wrong;
 * leaves nothing behind, as valgrind sees. */
#include <lkao/c.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                     \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      fprintf(stderr, "%s:%d: %s; %s\n", __FILE__, __LINE__, #condition, lkao_last_error()); \
      exit(1);                                                                               \
    }                                                                                        \
  } while (0)
#define OK(call) CHECK((call) == LKAO_OK)

/* The floor lies at y = 0, the wall stands on it at z = 0. */
static const float positions[8][3] = {{-5, 0, -5}, {5, 0, -5}, {5, 0, 5}, {-5, 0, 5},
                                      {-5, 0, 0},  {5, 0, 0},  {5, 5, 0}, {-5, 5, 0}};
static const uint16_t triangles[4][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};

static int keep_going(void* user, size_t done, size_t total) {
  CHECK(done <= total);
  ++*(int*)user;
  return 1;
}

static double parabola(void* user, double x) {
  (void)user;
  return 1 - x * x;
}

static lkao_mesh wall(void) {
  lkao_mesh mesh = LKAO_MESH_INIT;
  mesh.positions = positions;
  mesh.position_count = 8;
  mesh.indices = triangles;
  mesh.index_type = LKAO_UINT16;
  mesh.triangle_count = 4;
  return mesh;
}

static lkao_receiver foot_of_the_wall(void) {
  lkao_receiver receiver = LKAO_RECEIVER_INIT;
  receiver.position[2] = 0.001f;
  receiver.normal[1] = 1;
  return receiver;
}

static lkao_bvh* build_bvh(void) {
  const lkao_mesh mesh = wall();
  lkao_build_options options = LKAO_BUILD_OPTIONS_INIT;
  lkao_build_report report = LKAO_BUILD_REPORT_INIT;
  lkao_bounds bounds;
  double origin[3] = {1, 1, 1};
  int calls = 0;
  lkao_bvh *bvh = NULL, *refitted = NULL;
  options.progress = keep_going;
  options.progress_user = &calls;
  OK(lkao_bvh_create(&mesh, &options, &bvh));
  CHECK(calls > 0);
  OK(lkao_bvh_get_report(bvh, &report));
  CHECK(report.occluder_count == 4);
  CHECK(report.growth == 1);
  OK(lkao_bvh_create_refitted(bvh, &mesh, NULL, &refitted));
  OK(lkao_bvh_destroy(refitted));
  OK(lkao_bvh_get_bounds(bvh, &bounds));
  CHECK(bounds.lower[2] == -5 && bounds.upper[1] == 5);
  OK(lkao_bvh_get_origin(bvh, origin));
  CHECK(origin[0] == 0);
  OK(lkao_choose_origin(&mesh, origin));
  return bvh;
}

/* The wall twice, of which one stands far away, in all the ways to make a scene. */
static lkao_scene* make_scene(void) {
  const lkao_mesh mesh = wall();
  static const float far_away[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1000};
  static const uint32_t second = 1;
  lkao_bvh *bvh = build_bvh(), *same = NULL;
  lkao_instance instances[2] = {LKAO_INSTANCE_INIT, LKAO_INSTANCE_INIT};
  lkao_mesh_instance mesh_instance = LKAO_MESH_INSTANCE_INIT;
  lkao_scene_report report = LKAO_SCENE_REPORT_INIT;
  lkao_bounds bounds;
  double origin[3] = {1, 1, 1};
  lkao_scene* scene = NULL;
  mesh_instance.mesh = &mesh;
  OK(lkao_scene_create(&mesh, NULL, &scene));
  OK(lkao_scene_destroy(scene));
  OK(lkao_scene_create_of_bvh(bvh, &scene));
  OK(lkao_scene_destroy(scene));
  OK(lkao_scene_create_of_mesh_instances(&mesh_instance, 1, NULL, &scene));
  OK(lkao_scene_destroy(scene));
  OK(lkao_scene_create_of_instances((const lkao_bvh* const*)&bvh, 1, instances, 2, 0, &scene));
  OK(lkao_scene_move(scene, &second, far_away, 0, 1, 0));
  OK(lkao_scene_set_groups(scene, 1, 2));
  OK(lkao_scene_set_mesh(scene, 0, bvh));
  OK(lkao_scene_get_instance(scene, 1, &instances[1]));
  CHECK(instances[1].to_world[11] == 1000 && instances[1].groups == 2);
  OK(lkao_scene_get_report(scene, &report));
  CHECK(report.mesh_count == 1 && report.instance_count == 2 && report.occluder_count == 8);
  OK(lkao_scene_get_bounds(scene, &bounds));
  CHECK(bounds.upper[2] >= 1005);
  OK(lkao_scene_get_origin(scene, origin));
  CHECK(origin[2] == 0);
  OK(lkao_bvh_create_of_scene(scene, 0, &same));
  OK(lkao_bvh_destroy(same));
  OK(lkao_bvh_destroy(bvh));
  return scene;
}

static lkao_pattern* make_pattern(void) {
  static const float point[2] = {0.1f, 0.2f}, length = 1;
  lkao_falloff falloff = LKAO_FALLOFF_INIT;
  lkao_pattern_options options = LKAO_PATTERN_OPTIONS_INIT;
  lkao_pattern *pattern = NULL, *other = NULL;
  float elevation = 0;
  double value = 0;
  falloff.kind = LKAO_FALLOFF_CUSTOM;
  falloff.function = parabola;
  OK(lkao_falloff_value(&falloff, 0.5, &value));
  CHECK(value == 0.75);
  OK(lkao_falloff_length_at(&falloff, 0.75, &value));
  CHECK(fabs(value - 0.5) < 1e-9);
  OK(lkao_falloff_kind_named(lkao_falloff_kind_name(LKAO_FALLOFF_SMOOTH), &falloff.kind));
  OK(lkao_pattern_kind_named(lkao_pattern_kind_name(LKAO_PATTERN_SOBOL), &options.kind));
  options.falloff = &falloff;
  OK(lkao_pattern_create(&options, &pattern));
  OK(lkao_pattern_create_with_falloff(pattern, &falloff, &other));
  OK(lkao_pattern_destroy(other));
  OK(lkao_pattern_destroy(pattern));
  OK(lkao_pattern_create_from_disk(point, 0, &length, 0, 1, &pattern));
  CHECK(lkao_pattern_disk(pattern)[1] == 0.2f && lkao_pattern_lengths(pattern)[0] == 1);
  OK(lkao_pattern_destroy(pattern));
  OK(lkao_pattern_create_standard(256, LKAO_COSINE, &pattern));
  OK(lkao_pattern_lowest_elevation(pattern, &elevation));
  CHECK(elevation > 0 && lkao_pattern_directions(pattern)[2] > 0);
  CHECK(lkao_pattern_ray_count(pattern) == 256 && lkao_pattern_word_count(pattern) == LKAO_WORD_COUNT(256));
  return pattern;
}

static lkao_table* make_table(const lkao_pattern* pattern, lkao_plane_masks masks) {
  static const float up[3] = {0, 0, 1};
  lkao_table_options options = LKAO_TABLE_OPTIONS_INIT;
  lkao_table_report report = LKAO_TABLE_REPORT_INIT;
  lkao_table *table = NULL, *directions = NULL;
  lkao_pattern* same = NULL;
  uint32_t cell = 0, edge = 0;
  options.resolution = 32;
  options.masks = masks;
  options.thread_count = 1;
  OK(lkao_table_create(pattern, &options, &table));
  OK(lkao_table_cell(table, up, 0.5f, &cell));
  OK(lkao_table_edge_cell(table, up, &edge));
  OK(lkao_table_get_options(table, &options));
  OK(lkao_table_get_report(table, &report));
  CHECK(options.resolution == 32 && cell < report.cell_count && edge < report.cell_count);
  CHECK((lkao_table_nearest(table, cell) != NULL) == (masks == LKAO_MASKS_NEAREST));
  CHECK((lkao_table_must(table, cell) != NULL) == (masks == LKAO_MASKS_MUST_MAY));
  CHECK((lkao_table_may(table, cell) != NULL) == (masks == LKAO_MASKS_MUST_MAY));
  OK(lkao_table_create_directions(table, &directions));
  OK(lkao_table_destroy(directions));
  OK(lkao_pattern_create_of_table(table, &same));
  OK(lkao_pattern_destroy(same));
  return table;
}

/* Half of the sky is behind the wall, as far as rays reach it: a little less than 0.5. */
static void check_answers(const lkao_ao* ao) {
  const lkao_receiver receiver = foot_of_the_wall();
  const lkao_bounds box = {{-1, 0, 0}, {1, 0, 1}};
  lkao_answer answer = LKAO_ANSWER_INIT;
  lkao_rays rays = LKAO_RAYS_INIT;
  lkao_neighbourhood* near = NULL;
  lkao_receivers receivers = LKAO_RECEIVERS_INIT;
  lkao_outputs outputs = LKAO_OUTPUTS_INIT;
  lkao_query_report report = LKAO_QUERY_REPORT_INIT;
  uint64_t mask[LKAO_MAX_WORD_COUNT];
  float occlusion = -1, segments[256][3];
  OK(lkao_ao_query(ao, &receiver, 0, &answer));
  CHECK(answer.occlusion > 0.48f && answer.occlusion < 0.51f && answer.bent_normal[2] > 0);
  OK(lkao_ao_blocked(ao, &receiver, 0, mask, LKAO_MAX_WORD_COUNT));
  CHECK(memcmp(mask, answer.mask, sizeof(mask)) == 0);
  OK(lkao_ao_get_rays(ao, &receiver, 0, &rays, segments[0], 0));
  CHECK(rays.ray_count == 256 && rays.radius == 2);
  OK(lkao_neighbourhood_create(ao, &box, &near));
  OK(lkao_neighbourhood_blocked(near, &receiver, 0, mask, LKAO_MAX_WORD_COUNT));
  CHECK(memcmp(mask, answer.mask, sizeof(mask)) == 0);
  OK(lkao_neighbourhood_query(near, &receiver, 0, &answer));
  OK(lkao_neighbourhood_destroy(near));
  receivers.count = 1;
  receivers.positions = receiver.position;
  receivers.normals = receiver.normal;
  outputs.occlusion = &occlusion;
  OK(lkao_ao_query_batch(ao, &receivers, &outputs, NULL, &report));
  CHECK(occlusion == answer.occlusion && report.ray_count == 256);
}

static void check_queries(const lkao_scene* scene, const lkao_pattern* pattern) {
  lkao_table *exact = make_table(pattern, LKAO_MASKS_MUST_MAY), *same = NULL;
  lkao_ray_options options = LKAO_RAY_OPTIONS_INIT;
  lkao_level level = LKAO_LEVEL_INIT;
  lkao_ao* aos[3] = {NULL, NULL, NULL};
  lkao_pattern* of_ao = NULL;
  lkao_scene* scene_of_ao = NULL;
  int i;
  OK(lkao_table_destroy(make_table(pattern, LKAO_MASKS_NEAREST)));
  options.radius = 2;
  level.scene = scene;
  level.r_max = INFINITY;
  OK(lkao_ao_create(scene, pattern, &options, LKAO_SIMD, &aos[0]));
  OK(lkao_ao_create_levels(&level, 1, pattern, &options, LKAO_SCALAR, &aos[1]));
  OK(lkao_ao_create_by_table(scene, exact, &options, LKAO_NODES_BOX_OUTLINE, &aos[2]));
  for (i = 0; i < 3; ++i) check_answers(aos[i]);
  OK(lkao_ao_get_options(aos[0], &options));
  CHECK(options.radius == 2);
  OK(lkao_pattern_create_of_ao(aos[0], &of_ao));
  OK(lkao_scene_create_of_ao(aos[0], &scene_of_ao));
  OK(lkao_table_create_of_ao(aos[2], &same));
  OK(lkao_pattern_destroy(of_ao));
  OK(lkao_scene_destroy(scene_of_ao));
  OK(lkao_table_destroy(same));
  OK(lkao_table_destroy(exact));
  for (i = 0; i < 3; ++i) OK(lkao_ao_destroy(aos[i]));
  /* A handle that is no more. */
  CHECK(lkao_ao_destroy(aos[0]) == LKAO_ERROR_INVALID_HANDLE);
  CHECK(strcmp(lkao_last_error(), "lkao_ao_destroy: ao was destroyed: it must be a lkao_ao") == 0);
}

/* A lamp above the wall, of which the wall hides half from its back. */
static void check_lights(const lkao_scene* scene, const lkao_pattern* pattern) {
  static const float up[3] = {0, 1, 0}, origin[3] = {0, 0.5f, 0.001f}, to_the_wall[3] = {0, 0, -1};
  lkao_receiver receiver = foot_of_the_wall();
  lkao_bundle bundle = LKAO_BUNDLE_INIT;
  lkao_light light = LKAO_LIGHT_INIT;
  lkao_shadow_options options = LKAO_SHADOW_OPTIONS_INIT;
  lkao_visibility visibility = LKAO_VISIBILITY_INIT;
  lkao_receivers receivers = LKAO_RECEIVERS_INIT;
  lkao_shadow_outputs outputs = LKAO_SHADOW_OUTPUTS_INIT;
  lkao_rays rays = LKAO_RAYS_INIT;
  lkao_sky_shares shares, of_batch;
  lkao_bundles* bundles = NULL;
  lkao_shadows* shadows = NULL;
  lkao_sky* sky = NULL;
  lkao_scene* same = NULL;
  lkao_pattern* same_pattern = NULL;
  uint64_t mask = 0;
  float seen = -1;
  OK(lkao_bundles_create(scene, LKAO_TWO_SIDED, LKAO_SIMD, &bundles));
  memcpy(bundle.origin, origin, sizeof(origin));
  bundle.rays = to_the_wall;
  bundle.ray_count = 1;
  OK(lkao_bundles_blocked(bundles, &bundle, &mask, 1));
  CHECK(mask == 1);
  OK(lkao_bundles_blocked_batch(bundles, &bundle, 1, &mask, 0, 1, NULL));
  CHECK(mask == 1);
  OK(lkao_scene_create_of_bundles(bundles, &same));
  OK(lkao_scene_destroy(same));
  OK(lkao_bundles_destroy(bundles));

  light.position[1] = 10;
  memcpy(light.normal, up, sizeof(up));
  light.radius = 1;
  OK(lkao_shadows_create(scene, &light, pattern, &options, &shadows));
  OK(lkao_shadows_query(shadows, &receiver, 0, &visibility));
  CHECK(visibility.visibility > 0.4f && visibility.visibility < 0.6f && visibility.above_horizon == 1);
  receivers.count = 1;
  receivers.positions = receiver.position;
  receivers.normals = receiver.normal;
  outputs.visibility = &seen;
  OK(lkao_shadows_query_batch(shadows, &receivers, &outputs, NULL, NULL));
  CHECK(seen == visibility.visibility);
  OK(lkao_shadows_get_rays(shadows, &receiver, 0, &rays, NULL, 0));
  OK(lkao_shadows_get_light(shadows, &light));
  OK(lkao_shadows_get_options(shadows, &options));
  OK(lkao_scene_create_of_shadows(shadows, &same));
  OK(lkao_scene_destroy(same));
  OK(lkao_pattern_create_of_shadows(shadows, &same_pattern));
  OK(lkao_pattern_destroy(same_pattern));
  OK(lkao_shadows_destroy(shadows));

  OK(lkao_sky_create(scene, NULL, &sky));
  OK(lkao_sky_query(sky, &receiver, 0, &shares));
  /* The wall hides half of what is above the floor; under it nothing is in the way. */
  CHECK(shares.above > 0.4f && shares.above < 0.6f && shares.below > 0.99f && shares.visibility > 0.7f);
  OK(lkao_sky_query_batch(sky, &receivers, &of_batch, 0, NULL, NULL));
  CHECK(memcmp(&of_batch, &shares, sizeof(shares)) == 0);
  OK(lkao_sky_destroy(sky));
}

static int is_low(void* user, uint32_t instance, uint32_t primitive, float u, float v) {
  (void)instance, (void)primitive, (void)u;
  ++*(int*)user;
  return v < 0.1f;
}

static lkao_cut_out_part survey_low(void* user, uint32_t primitive, float u0, float v0, float size) {
  (void)user, (void)primitive, (void)u0;
  if (v0 >= 0.1f) return LKAO_CUT_OUT_CLEAR;
  return v0 + size < 0.1f ? LKAO_CUT_OUT_OPAQUE : LKAO_CUT_OUT_MIXED;
}

/* The wall is there to half a meter. Its triangles, which have holes, look alike. */
static void check_cut_outs(const lkao_pattern* pattern) {
  static const float opacities[4] = {1, 1, 0, 0};
  static const uint32_t looks[4] = {0, 0, 1, 1};
  const lkao_mesh mesh = wall();
  const lkao_receiver receiver = foot_of_the_wall();
  lkao_build_options options = LKAO_BUILD_OPTIONS_INIT;
  lkao_ray_options rays = LKAO_RAY_OPTIONS_INIT;
  uint64_t masks[2][LKAO_MAX_WORD_COUNT];
  int asked[2] = {0, 0}, i;
  rays.radius = 2;
  options.thread_count = 1;
  options.opacities = opacities;
  options.opacity_count = options.cut_out_look_count = 4;
  options.cut_out_looks = looks;
  options.cut_out_filter = is_low;
  for (i = 0; i < 2; ++i) {
    lkao_scene* scene = NULL;
    lkao_ao* ao = NULL;
    options.cut_out_user = &asked[i];
    options.cut_out_survey = i == 0 ? NULL : survey_low;
    OK(lkao_scene_create(&mesh, &options, &scene));
    OK(lkao_ao_create(scene, pattern, &rays, LKAO_SIMD, &ao));
    OK(lkao_ao_blocked(ao, &receiver, 0, masks[i], LKAO_MAX_WORD_COUNT));
    OK(lkao_ao_destroy(ao));
    OK(lkao_scene_destroy(scene));
  }
  CHECK(memcmp(masks[0], masks[1], sizeof(masks[0])) == 0);
  CHECK(masks[0][0] != 0 && masks[0][0] != ~(uint64_t)0 && asked[0] > 50 && asked[1] < asked[0] / 4);
}

int main(void) {
  lkao_scene* scene = make_scene();
  lkao_pattern* pattern = make_pattern();
  CHECK(strcmp(lkao_status_name(LKAO_ERROR_CANCELLED), "LKAO_ERROR_CANCELLED") == 0);
  CHECK(lkao_active_isa() != NULL && lkao_available_isa(0) != NULL);
  OK(lkao_force_isa(""));
  CHECK(lkao_version()[0] == '0' + LKAO_VERSION_MAJOR);
  check_queries(scene, pattern);
  check_lights(scene, pattern);
  check_cut_outs(pattern);
  OK(lkao_scene_destroy(scene));
  OK(lkao_pattern_destroy(pattern));
  CHECK(lkao_live_handle_count() == 0);
  return 0;
}
