#include "gpu/pass_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include <glm/gtc/matrix_transform.hpp>

#include "lut/random.h"

namespace lkao::gl::tests {

using lkao::tests::add_quad;
using lkao::tests::random_point;
using lkao::tests::uniform;

Mesh furnished_room() {
  Mesh mesh;
  add_quad(mesh, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});  // floor
  add_quad(mesh, {-3, 0, -3}, {6, 0, 0}, {0, 4, 0});  // back
  add_quad(mesh, {-3, 0, 3}, {0, 0, -6}, {0, 4, 0});  // left
  add_quad(mesh, {3, 0, -3}, {0, 0, 6}, {0, 4, 0});   // right
  add_quad(mesh, {-3, 4, -3}, {6, 0, 0}, {0, 0, 6});  // ceiling
  add_quad(mesh, {-2.3f, 0, -1.1f}, {0.8f, 0, -0.4f}, {0, 1.7f, 0});
  const Mesh ball = lkao::tests::closed_sphere(24, 12);
  const auto first = static_cast<unsigned>(mesh.positions.size());
  for (const glm::vec3& p : ball.positions) mesh.positions.push_back(p * 0.7f + glm::vec3(0.9f, 0.7f, -0.8f));
  for (const glm::uvec3& t : ball.triangles) mesh.triangles.push_back(t + first);
  lut::RandomStream random(5);
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 center = random_point(random, 1.0f) * glm::vec3(2.5f, 1.2f, 2.0f) + glm::vec3(0, 1.5f, -0.7f);
    const float size = 0.02f + 0.5f * uniform(random, 0, 1) * uniform(random, 0, 1);
    const auto corner = static_cast<unsigned>(mesh.positions.size());
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(center + random_point(random, size));
    mesh.triangles.emplace_back(corner, corner + 1, corner + 2);
  }
  return mesh;
}

Camera room_camera(int width, int height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return {glm::lookAt(glm::vec3(0.3f, 1.9f, 3.4f), glm::vec3(0, 1.3f, -1), glm::vec3(0, 1, 0)),
          glm::perspective(1.2f, aspect, 0.05f, 50.0f), ClipDepth::minus_one_to_one};
}

std::vector<std::uint64_t> cpu_masks(const Mesh& mesh, const std::vector<Receiver>& receivers,
                                     const SamplePattern& pattern, const RayOptions& options) {
  std::vector<std::uint64_t> masks(receivers.size() * static_cast<std::size_t>(pattern.word_count()));
  AmbientOcclusion(OccluderBvh(mesh.view()), pattern, options).query(receivers, {.mask_words = masks});
  return masks;
}

std::uint64_t count_differences(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    count += static_cast<unsigned>(std::popcount(a[i] ^ b[i]));
  return count;
}

std::uint64_t count_bits(const std::vector<std::uint64_t>& masks) {
  std::uint64_t count = 0;
  for (std::uint64_t word : masks) count += static_cast<unsigned>(std::popcount(word));
  return count;
}

double share_of_equal_pixels(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b, int word_count) {
  const auto words = static_cast<std::size_t>(word_count);
  const std::size_t pixel_count = a.size() / words;
  std::size_t equal_count = 0;
  for (std::size_t i = 0; i < pixel_count; ++i) {
    const auto first = static_cast<std::ptrdiff_t>(i * words), last = first + static_cast<std::ptrdiff_t>(words);
    equal_count += std::equal(a.begin() + first, a.begin() + last, b.begin() + first);
  }
  return static_cast<double>(equal_count) / static_cast<double>(pixel_count);
}

PassOnMesh make_pass(const Mesh& mesh, const PlaneMaskTable& table, const MaskPassSetup& setup) {
  PassOnMesh pass(setup);
  pass.occluders = Occluders(mesh.positions, mesh.triangles);
  pass.set_table(table);
  return pass;
}

}  // namespace lkao::gl::tests
