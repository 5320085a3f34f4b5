// A small renderer in plain C, and what it takes to give it lkao: the lines marked "lkao".
//
//   host_renderer_c courtyard.pgm [TILE]
//
// Camera rays find what each pixel sees, tile by tile, TILE pixels wide and high; one batch answers a tile. The picture
// is the visibility: white where nothing blocks the sky, black where everything does and where there is only sky.
#include <lkao/c.h>  // lkao
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 160, HEIGHT = 120, BOX_COUNT = 4, LARGEST_TILE = 64 };

typedef struct {
  float x, y, z;
} Vec;

// What the renderer has of a surface point, as it is: lkao reads positions and normals, and writes occlusion.
typedef struct {
  Vec position, normal;
  float occlusion;
  int pixel;
} Point;

static Vec vertices[8 * BOX_COUNT];
static uint16_t triangles[12 * BOX_COUNT][3];

static Vec add(Vec a, Vec b) { return (Vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static Vec sub(Vec a, Vec b) { return (Vec){a.x - b.x, a.y - b.y, a.z - b.z}; }
static Vec scale(Vec a, float s) { return (Vec){a.x * s, a.y * s, a.z * s}; }
static float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static Vec cross(Vec a, Vec b) { return (Vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static Vec unit(Vec a) { return scale(a, 1 / sqrtf(dot(a, a))); }

// The ground, two walls and a crate, as boxes.
static void make_scene(void) {
  static const Vec boxes[BOX_COUNT][2] = {{{-4, -1, -4}, {4, 0, 4}},
                                          {{-4, 0, -4}, {4, 2.5f, -3.6f}},
                                          {{-4, 0, -3.6f}, {-3.6f, 2.5f, 4}},
                                          {{-1, 0.02f, -1}, {0.5f, 1.2f, 0.4f}}};
  static const uint16_t corners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (int box = 0; box < BOX_COUNT; ++box) {
    const Vec low = boxes[box][0], high = boxes[box][1];
    for (int i = 0; i < 8; ++i) {
      vertices[8 * box + i] = (Vec){i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    }
    for (int i = 0; i < 12 * 3; ++i) triangles[12 * box + i / 3][i % 3] = (uint16_t)(8 * box + corners[i / 3][i % 3]);
  }
}

// The nearest triangle that the ray meets; returns 0 where there is none.
static int trace(Vec from, Vec along, Point* point) {
  float nearest = INFINITY;
  for (int i = 0; i < 12 * BOX_COUNT; ++i) {
    const Vec a = vertices[triangles[i][0]];
    const Vec u = sub(vertices[triangles[i][1]], a), v = sub(vertices[triangles[i][2]], a);
    const Vec p = cross(along, v), t = sub(from, a), q = cross(t, u);
    const float det = dot(u, p), b = dot(t, p) / det, c = dot(along, q) / det, distance = dot(v, q) / det;
    if (fabsf(det) < 1e-9f || b < 0 || c < 0 || b + c > 1 || distance <= 0 || distance >= nearest) continue;
    nearest = distance;
    const Vec normal = unit(cross(u, v));
    point->position = add(from, scale(along, distance));
    point->normal = dot(normal, along) < 0 ? normal : scale(normal, -1);
  }
  return nearest < INFINITY;
}

// The points that a tile's pixels see; returns their number.
static int trace_tile(int left, int top, int tile, Point* points) {
  const Vec eye = {5, 4.5f, 7}, forward = unit(sub((Vec){-0.7f, 0.4f, -0.8f}, eye));
  const Vec right = scale(unit(cross(forward, (Vec){0, 1, 0})), 0.55f), up = cross(right, forward);
  int count = 0;
  for (int y = top; y < top + tile && y < HEIGHT; ++y) {
    for (int x = left; x < left + tile && x < WIDTH; ++x) {
      const float a = (float)(2 * x + 1 - WIDTH) / WIDTH, b = (float)(HEIGHT - 2 * y - 1) / WIDTH;
      points[count].pixel = y * WIDTH + x;
      count += trace(eye, add(forward, add(scale(right, a), scale(up, b))), &points[count]);
    }
  }
  return count;
}

static lkao_ao* make_ao(void) {
  lkao_mesh mesh = LKAO_MESH_INIT;                                                                // lkao
  lkao_ray_options rays = LKAO_RAY_OPTIONS_INIT;                                                  // lkao
  lkao_scene* scene = NULL;                                                                       // lkao
  lkao_pattern* pattern = NULL;                                                                   // lkao
  lkao_ao* ao = NULL;                                                                             // lkao
  mesh.positions = vertices, mesh.position_count = 8 * BOX_COUNT;                                 // lkao
  mesh.indices = triangles, mesh.triangle_count = 12 * BOX_COUNT, mesh.index_type = LKAO_UINT16;  // lkao
  rays.radius = 2;                                                                                // lkao
  if (lkao_scene_create(&mesh, NULL, &scene) == LKAO_OK &&                                        // lkao
      lkao_pattern_create_standard(128, LKAO_COSINE, &pattern) == LKAO_OK) {                      // lkao
    lkao_ao_create(scene, pattern, &rays, LKAO_SIMD, &ao);                                        // lkao
  }
  lkao_scene_destroy(scene);      // lkao
  lkao_pattern_destroy(pattern);  // lkao
  return ao;
}

// Answers the points of a tile in place.
static lkao_status shade_tile(const lkao_ao* ao, Point* points, int count, uint64_t first_index) {
  lkao_receivers receivers = LKAO_RECEIVERS_INIT;                                        // lkao
  lkao_outputs outputs = LKAO_OUTPUTS_INIT;                                              // lkao
  lkao_batch_options options = LKAO_BATCH_OPTIONS_INIT;                                  // lkao
  receivers.count = (size_t)count;                                                       // lkao
  receivers.positions = &points->position.x, receivers.position_stride = sizeof(Point);  // lkao
  receivers.normals = &points->normal.x, receivers.normal_stride = sizeof(Point);        // lkao
  outputs.occlusion = &points->occlusion, outputs.occlusion_stride = sizeof(Point);      // lkao
  options.first_index = first_index;                                                     // lkao
  return lkao_ao_query_batch(ao, &receivers, &outputs, &options, NULL);                  // lkao
}

int main(int argc, char** argv) {
  static Point points[LARGEST_TILE * LARGEST_TILE];
  static unsigned char picture[WIDTH * HEIGHT];
  const int tile = argc > 2 ? atoi(argv[2]) : 16;
  if (argc < 2 || tile < 1 || tile > LARGEST_TILE)
    return fputs("usage: host_renderer_c FILE.pgm [1 to 64]\n", stderr), 2;
  make_scene();
  lkao_ao* const ao = make_ao();
  for (int top = 0; top < HEIGHT && ao != NULL; top += tile) {
    for (int left = 0; left < WIDTH; left += tile) {
      const int count = trace_tile(left, top, tile, points);
      if (shade_tile(ao, points, count, (uint64_t)(top * WIDTH + left * tile)) != LKAO_OK) break;
      for (int i = 0; i < count; ++i) {
        picture[points[i].pixel] = (unsigned char)(255 * (1 - points[i].occlusion) + 0.5f);
      }
    }
  }
  lkao_ao_destroy(ao);                                                                                      // lkao
  if (lkao_last_error()[0] != '\0') return fprintf(stderr, "host_renderer_c: %s\n", lkao_last_error()), 1;  // lkao
  FILE* const file = fopen(argv[1], "wb");
  if (file == NULL) return fprintf(stderr, "host_renderer_c: cannot write %s\n", argv[1]), 1;
  fprintf(file, "P5\n%d %d\n255\n", WIDTH, HEIGHT);
  const size_t written = fwrite(picture, 1, sizeof(picture), file);
  return fclose(file) == 0 && written == sizeof(picture) ? 0 : 1;
}
