// The foot of the same wall, from a renderer's own vertices.
#include <cstdint>
#include <cstdio>
#include <vector>

#include <lkao/lkao.h>

struct Vertex {
  float position[3];
  float normal[3];
};

lkao::OccluderBvh build(const std::vector<Vertex>& vertices, const std::vector<std::uint16_t>& indices) {
  const lkao::PositionView positions(vertices[0].position, vertices.size(), sizeof(Vertex));
  const lkao::IndexView triangles(indices.data(), indices.size() / 3);
  return lkao::OccluderBvh({positions, triangles});
}

int main() {
  const std::vector<Vertex> vertices{{{-5, 0, -5}, {0, 1, 0}}, {{5, 0, -5}, {0, 1, 0}}, {{5, 0, 5}, {0, 1, 0}},
                                     {{-5, 0, 5}, {0, 1, 0}},  {{-5, 0, 0}, {0, 0, 1}}, {{5, 0, 0}, {0, 0, 1}},
                                     {{5, 5, 0}, {0, 0, 1}},   {{-5, 5, 0}, {0, 0, 1}}};
  const std::vector<std::uint16_t> indices{0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7};
  const lkao::AmbientOcclusion ao(build(vertices, indices), lkao::SamplePattern::standard(256), {.radius = 2.0f});
  const lkao::Receiver foot{.position = {0, 0, 0.001f}, .normal = {0, 1, 0}};
  std::printf("occlusion at the foot of the wall: %.2f\n", ao.query(foot, 0).occlusion);
}
