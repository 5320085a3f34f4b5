// How dark is the floor at the foot of a wall?
#include <array>
#include <cstdio>

#include <lkao/lkao.h>

int main() {
  // The floor lies at y = 0, the wall stands on it at z = 0.
  const std::array<glm::vec3, 8> positions{
      {{-5, 0, -5}, {5, 0, -5}, {5, 0, 5}, {-5, 0, 5}, {-5, 0, 0}, {5, 0, 0}, {5, 5, 0}, {-5, 5, 0}}};
  const std::array<glm::uvec3, 4> triangles{{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}}};

  const lkao::OccluderBvh occluders({positions, triangles});
  const lkao::AmbientOcclusion ao(occluders, lkao::SamplePattern::standard(256), {.radius = 2.0f});

  const lkao::Receiver foot{.position = {0, 0, 0.001f}, .normal = {0, 1, 0}};
  std::printf("occlusion at the foot of the wall: %.2f\n", ao.query(foot, 0).occlusion);
}
