// The places of a renderer that ask for occlusion, each at the foot of a wall.
#include <array>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

#include <lkao/lkao.h>

struct Hit {
  glm::vec3 position, normal;
  std::uint64_t pixel;
  float visibility;
};

// Per shading point: in any thread, wherever a ray of the renderer hits.
void shade(const lkao::AmbientOcclusion& ao, Hit& hit) {
  hit.visibility = 1 - ao.query({.position = hit.position, .normal = hit.normal}, hit.pixel).occlusion;
}

// Per tile: point by point, in one thread, from a box around them; the same answers, sooner.
void shade(const lkao::AmbientOcclusion& ao, const lkao::Bounds& box, std::span<Hit> tile) {
  lkao::Neighbourhood here = ao.around(box);
  for (Hit& hit : tile) {
    hit.visibility = 1 - here.query({.position = hit.position, .normal = hit.normal}, hit.pixel).occlusion;
  }
}

// Per texel: all that there are at once, on all threads.
std::vector<float> bake(const lkao::AmbientOcclusion& ao, std::span<const lkao::Receiver> texels) {
  std::vector<float> occlusion(texels.size());
  ao.query(texels, {.occlusion = occlusion});
  return occlusion;
}

int main() {
  const std::array<glm::vec3, 8> positions{
      {{-5, 0, -5}, {5, 0, -5}, {5, 0, 5}, {-5, 0, 5}, {-5, 0, 0}, {5, 0, 0}, {5, 5, 0}, {-5, 5, 0}}};
  const std::array<glm::uvec3, 4> triangles{{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}}};
  const lkao::OccluderBvh occluders({positions, triangles});
  const lkao::AmbientOcclusion ao(occluders, lkao::SamplePattern::standard(256), {.radius = 2.0f});

  Hit point{{0, 0, 0.001f}, {0, 1, 0}, 0, 0}, of_tile = point;
  shade(ao, point);
  shade(ao, {of_tile.position, of_tile.position}, {&of_tile, 1});
  const float texel = bake(ao, std::vector<lkao::Receiver>{{.position = point.position, .normal = point.normal}})[0];
  if (point.visibility != of_tile.visibility || point.visibility != 1 - texel) return 1;
  std::printf("occlusion at the foot of the wall: %.2f\n", texel);
}
