/* The places of a renderer that ask for occlusion, each at the foot of a wall, in C. */
#include <lkao/c.h>
#include <stdio.h>
#include <string.h>

struct Hit {
  float position[3], normal[3], visibility;
  uint64_t pixel;
};

static lkao_receiver receiver_at(const struct Hit* hit) {
  lkao_receiver receiver = LKAO_RECEIVER_INIT;
  memcpy(receiver.position, hit->position, sizeof receiver.position);
  memcpy(receiver.normal, hit->normal, sizeof receiver.normal);
  return receiver;
}

/* Per shading point: in any thread, wherever a ray of the renderer hits. */
static lkao_status shade(const lkao_ao* ao, struct Hit* hit) {
  const lkao_receiver receiver = receiver_at(hit);
  lkao_answer answer = LKAO_ANSWER_INIT;
  const lkao_status status = lkao_ao_query(ao, &receiver, hit->pixel, &answer);
  hit->visibility = 1 - answer.occlusion;
  return status;
}

/* Per tile: point by point, in one thread, from a box around them; the same answers, sooner. */
static lkao_status shade_tile(const lkao_ao* ao, const lkao_bounds* box, struct Hit* tile, size_t count) {
  lkao_neighbourhood* here = NULL;
  lkao_status status = lkao_neighbourhood_create(ao, box, &here);
  for (size_t i = 0; i < count && status == LKAO_OK; ++i) {
    const lkao_receiver receiver = receiver_at(&tile[i]);
    lkao_answer answer = LKAO_ANSWER_INIT;
    status = lkao_neighbourhood_query(here, &receiver, tile[i].pixel, &answer);
    tile[i].visibility = 1 - answer.occlusion;
  }
  lkao_neighbourhood_destroy(here);
  return status;
}

/* Per texel: all that there are at once, on all threads, in the renderer's own arrays. */
static lkao_status bake(const lkao_ao* ao, const struct Hit* texels, size_t count, float* occlusion) {
  lkao_receivers receivers = LKAO_RECEIVERS_INIT;
  lkao_outputs outputs = LKAO_OUTPUTS_INIT;
  receivers.count = count;
  receivers.positions = texels->position, receivers.position_stride = sizeof *texels;
  receivers.normals = texels->normal, receivers.normal_stride = sizeof *texels;
  outputs.occlusion = occlusion;
  return lkao_ao_query_batch(ao, &receivers, &outputs, NULL, NULL);
}

int main(void) {
  static const float positions[8][3] = {{-5, 0, -5}, {5, 0, -5}, {5, 0, 5}, {-5, 0, 5},
                                        {-5, 0, 0},  {5, 0, 0},  {5, 5, 0}, {-5, 5, 0}};
  static const uint32_t triangles[4][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  static const lkao_bounds box = {{0, 0, 0}, {0, 0, 0.001f}};
  struct Hit point = {{0, 0, 0.001f}, {0, 1, 0}, 0, 0}, of_tile = point;
  float texel = 0;
  lkao_ao* ao = NULL;
  {
    lkao_mesh mesh = LKAO_MESH_INIT;
    mesh.positions = positions, mesh.position_count = 8;
    mesh.indices = triangles, mesh.triangle_count = 4;
    lkao_ray_options rays = LKAO_RAY_OPTIONS_INIT;
    rays.radius = 2;
    lkao_scene* scene = NULL;
    lkao_pattern* pattern = NULL;
    if (lkao_scene_create(&mesh, NULL, &scene) == LKAO_OK &&
        lkao_pattern_create_standard(256, LKAO_COSINE, &pattern) == LKAO_OK) {
      lkao_ao_create(scene, pattern, &rays, LKAO_SIMD, &ao);
    }
    lkao_scene_destroy(scene);
    lkao_pattern_destroy(pattern);
  }
  if (shade(ao, &point) || shade_tile(ao, &box, &of_tile, 1) || bake(ao, &point, 1, &texel)) {
    fprintf(stderr, "%s\n", lkao_last_error());
    return 1;
  }
  lkao_ao_destroy(ao);
  if (point.visibility != of_tile.visibility || point.visibility != 1 - texel) return 1;
  printf("occlusion at the foot of the wall: %.2f\n", texel);
  return 0;
}
