// A mesh on the GPU that several passes share.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "gpu/in_furnished_room.h"

namespace lkao::gl::tests::occluders_test {
namespace {

class SharedOccluders : public InFurnishedRoom<64, 48> {};

TEST_F(SharedOccluders, AreDrawnByPassesOfAnySetup) {
  const PlaneMaskTable exact(SamplePattern::standard(64), {.resolution = 32});
  const RayOptions options{.radius = 0.8f, .surface_offset = kQuerySurfaceOffset};
  PassOnMesh alone = make_pass(mesh_, exact);
  const auto expected = draw(alone, {.radius = 0.8f});
  Occluders occluders(mesh_.positions, mesh_.triangles);
  MaskPass first, second({.geometry = GeometryBackEnd::geometry_shader, .accumulator = Accumulator::ssbo});
  std::vector<glm::vec3> moved = mesh_.positions;
  for (std::size_t i = 24; i < moved.size(); ++i) moved[i] += glm::vec3(0.2f, 0.1f, 0.3f);
  for (MaskPass* pass : {&first, &second}) pass->set_table(exact);
  // In turns, with options of their own.
  for (MaskPass* pass : {&first, &second, &first}) {
    pass->draw(occluders, g_buffer_->by_positions(), camera_, options);
    EXPECT_EQ(pass->read_masks(), expected);
    pass->draw(occluders, g_buffer_->by_positions(), camera_, {.radius = 0.3f, .sidedness = Sidedness::one_sided});
    EXPECT_NE(pass->read_masks(), expected);
  }
  occluders.update_positions(moved);
  alone.occluders.update_positions(moved);
  const auto expected_moved = draw(alone, {.radius = 0.8f});
  EXPECT_NE(expected_moved, expected);
  for (MaskPass* pass : {&first, &second}) {
    pass->draw(occluders, g_buffer_->by_positions(), camera_, options);
    EXPECT_EQ(pass->read_masks(), expected_moved);
  }
}

TEST_F(SharedOccluders, MayLieInArraysOfAnyLayout) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  const auto expected = draw(pass, {.radius = 0.8f});
  struct Vertex {
    float u, v;
    glm::vec3 position;
  };
  std::vector<Vertex> vertices;
  for (const glm::vec3& position : mesh_.positions) vertices.push_back({0, 1, position});
  std::vector<std::uint16_t> indices;
  for (const glm::uvec3& triangle : mesh_.triangles) {
    for (int corner = 0; corner < 3; ++corner) indices.push_back(static_cast<std::uint16_t>(triangle[corner]));
  }
  const PositionView positions(&vertices[0].position.x, vertices.size(), sizeof(Vertex));
  pass.occluders = Occluders(positions, IndexView(indices.data(), indices.size() / 3));
  EXPECT_EQ(draw(pass, {.radius = 0.8f}), expected);
  for (Vertex& vertex : vertices) vertex.position.y += 0.1f;
  pass.occluders.update_positions(positions);
  EXPECT_NE(draw(pass, {.radius = 0.8f}), expected);
}

TEST_F(SharedOccluders, MayChangeFromFrameToFrame) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh pass = make_pass(mesh_, table);
  const auto expected = draw(pass, {.radius = 0.8f});
  const glm::vec3 corners[] = {{-1, 1, -1}, {1, 1, -1}, {0, 2, -1}};
  const glm::uvec3 triangle(0, 1, 2);
  const Occluders few(corners, std::span(&triangle, 1)), none;
  static_cast<MaskPass&>(pass).draw(few, g_buffer_->by_positions(), camera_, {.radius = 0.8f});
  const std::uint64_t few_bits = count_bits(pass.read_masks());
  static_cast<MaskPass&>(pass).draw(none, g_buffer_->by_positions(), camera_, {.radius = 0.8f});
  EXPECT_EQ(count_bits(pass.read_masks()), 0u);
  EXPECT_EQ(draw(pass, {.radius = 0.8f}), expected) << "lists of a larger mesh are found again";
  EXPECT_GT(few_bits, 100u);
  EXPECT_LT(few_bits, count_bits(expected));
}

}  // namespace
}  // namespace lkao::gl::tests::occluders_test
