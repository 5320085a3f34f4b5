// More triangles than one of the driver's buffers takes.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "gpu/in_furnished_room.h"
#include "gpu/mesh/mesh_buffers.h"
#include "lkao/lkao.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::many_triangles_test {
namespace {

class ManyTriangles : public InFurnishedRoom<48, 36> {
 protected:
  void SetUp() override {
    InFurnishedRoom::SetUp();
    if (IsSkipped()) return;
    const std::size_t capacity = MeshBuffers::capacity();
    if (capacity > (std::size_t{1} << 23)) GTEST_SKIP() << "a buffer of this OpenGL takes " << capacity << " triangles";
    triangle_count_ = capacity + capacity / 4;
  }

  // The room's triangles, evenly among others that have no area.
  std::vector<glm::uvec3> spread_out() const {
    std::vector<glm::uvec3> triangles(triangle_count_, glm::uvec3(0));
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) triangles[place_of(i)] = mesh_.triangles[i];
    return triangles;
  }
  std::size_t place_of(std::size_t i) const { return triangle_count_ / mesh_.triangles.size() * i; }

  std::size_t triangle_count_ = 0;
};

TEST_F(ManyTriangles, HaveTheMasksOfTheFewAmongThem) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh few = make_pass(mesh_, table), many = make_pass(mesh_, table);
  many.occluders = Occluders(mesh_.positions, spread_out());
  // Prisms and billboards.
  for (const float threshold : lkao::tests::unless_sanitized<std::vector<float>>({0, 0.4f, 100}, {0.4f})) {
    const RayOptions options{.radius = 0.8f, .sidedness = sidedness_of(threshold > 0)};
    const RasterOptions raster{.billboard_threshold = threshold};
    const auto expected = draw(few, options, raster);
    EXPECT_EQ(draw(many, options, raster), expected) << "threshold " << threshold;
    EXPECT_GT(count_bits(expected), 1000u);
  }
  // The positions are one buffer for all.
  std::vector<glm::vec3> moved = mesh_.positions;
  for (glm::vec3& position : moved) position.y += 0.05f;
  few.occluders.update_positions(moved);
  many.occluders.update_positions(moved);
  EXPECT_EQ(draw(many, {.radius = 0.8f}), draw(few, {.radius = 0.8f}));
}

TEST_F(ManyTriangles, KeepTheirRanges) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  const auto range_of = [](std::size_t i) { return i % 3 == 0 ? glm::vec2(0, 0.3f) : glm::vec2(0.2f, 0.7f); };
  std::vector<glm::vec2> few_ranges, many_ranges(triangle_count_, {0, 1});
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    few_ranges.push_back(range_of(i));
    many_ranges[place_of(i)] = range_of(i);
  }
  PassOnMesh few = make_pass(mesh_, table), many = make_pass(mesh_, table);
  few.occluders = Occluders(mesh_.positions, mesh_.triangles, few_ranges);
  many.occluders = Occluders(mesh_.positions, spread_out(), many_ranges);
  EXPECT_EQ(draw(many, {.radius = 0.8f}), draw(few, {.radius = 0.8f}));
}

}  // namespace
}  // namespace lkao::gl::tests::many_triangles_test
