// What the paper says of its volumes, on a floor and a wall: exact walls, and how far tessellation matters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/g_buffer_pass.h"
#include "gpu/on_software.h"
#include "lkao/ambient_occlusion.h"
#include "support/meshes.h"

namespace lkao::gl::tests::volumes_claims_test {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 16;

// The floor z = 0, seen from above: x from 0 to 4, y from -0.5 to 0.5.
class VolumesOnFloor : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    camera_ = {glm::lookAt(glm::vec3(2, 0, 5), glm::vec3(2, 0, 0), glm::vec3(0, 1, 0)),
               glm::ortho(-2.0f, 2.0f, -0.5f, 0.5f, 0.1f, 10.0f)};
    std::vector<glm::vec4> positions, normals(kWidth * kHeight, glm::vec4(0, 0, 1, 0));
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x)
        positions.emplace_back(distance(x), (static_cast<float>(y) + 0.5f) / kHeight - 0.5f, 0, 1);
    }
    positions_ = make_image(GL_RGBA32F, kWidth, kHeight, &positions[0].x);
    normals_ = make_image(GL_RGBA32F, kWidth, kHeight, &normals[0].x);
  }
  void TearDown() override {
    positions_.reset();
    normals_.reset();
  }

  // Of the pixels of a column from the wall x = 0.
  static float distance(int column) { return 4 * (static_cast<float>(column) + 0.5f) / kWidth; }

  // Of every step-th pixel.
  std::vector<float> draw(const Mesh& mesh, float delta, const VolumeOptions& volumes = {},
                          Accessibility format = Accessibility::bits32, int step = 1) {
    VolumePass pass({.accessibility = format});
    const GBuffer textures{
        .width = kWidth, .height = kHeight, .positions = positions_.name(), .normals = normals_.name(), .step = step};
    const int width = textures.picture_width(), height = textures.picture_height();
    const Texture target = make_image(GL_R32F, width, height);
    pass.draw(Occluders(mesh.positions, mesh.triangles), textures, camera_, {.radius = delta, .surface_offset = 0},
              {target.name()}, volumes);
    std::vector<float> occlusion;
    for (const glm::vec4& texel : read_image(target.name(), width, height)) occlusion.push_back(texel.x);
    return occlusion;
  }

  // Without a falloff to speak of, of a few pixels: each triangle of thousands is drawn over all of them.
  std::vector<float> draw_few(const Mesh& mesh, Accessibility format = Accessibility::bits32) {
    return draw(mesh, 5000, {}, format, 4);
  }

  Camera camera_;
  Texture positions_, normals_;
};

// The wall x = 0 from y = -half_width to half_width, of that height, in columns x rows quads.
Mesh wall(float half_width, float height, int columns, int rows) {
  Mesh mesh;
  const float width = 2 * half_width / static_cast<float>(columns), rise = height / static_cast<float>(rows);
  for (int i = 0; i < columns; ++i) {
    for (int k = 0; k < rows; ++k) {
      add_quad(mesh, {0, -half_width + width * static_cast<float>(i), rise * static_cast<float>(k)}, {0, width, 0},
               {0, 0, rise});
    }
  }
  return mesh;
}

double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::fmax(largest, std::fabs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  }
  return largest;
}

TEST_F(VolumesOnFloor, LongWallsHaveTheirClosedForm) {
  // 1/2 (1 - 1 / sqrt(1 + k^2)) of a wall of the height k x distance, where there is no falloff to speak of.
  const std::vector<float> low = draw(wall(4000, 2, 1, 1), 4000);
  for (std::size_t i = 0; i < low.size(); ++i) {
    const double k = 2 / static_cast<double>(distance(static_cast<int>(i) % kWidth));
    EXPECT_NEAR(static_cast<double>(low[i]), 0.5 * (1 - 1 / std::sqrt(1 + k * k)), 1e-3) << k;
  }
  // 1/2 (1 - distance / delta) of one triangle without end.
  Mesh endless;
  endless.positions = {{0, -4e5f, 0}, {0, 4e5f, 0}, {0, 0, 4e5f}};
  endless.triangles = {{0, 1, 2}};
  for (const float delta : {4000.0f, 6.0f, 1.5f}) {
    const std::vector<float> occlusion = draw(endless, delta);
    for (std::size_t i = 0; i < occlusion.size(); ++i) {
      const auto d = static_cast<double>(distance(static_cast<int>(i) % kWidth));
      EXPECT_NEAR(static_cast<double>(occlusion[i]), 0.5 * std::fmax(1 - d / static_cast<double>(delta), 0.0), 2e-5)
          << d;
    }
  }
}

TEST_F(VolumesOnFloor, FarReachingOnesAreRays) {
  // Without a falloff, next to a wall, under a roof that no ray through the wall meets: nothing is counted twice.
  Mesh mesh = wall(1, 1, 1, 1);
  add_quad(mesh, {0, -3, 2.5f}, {0, 6, 0}, {4, 0, 0.5f});
  const std::vector<float> occlusion = draw(mesh, 5000);
  std::vector<Receiver> receivers;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const float y = (static_cast<float>(i / kWidth) + 0.5f) / kHeight - 0.5f;
    receivers.push_back({{distance(i % kWidth), y, 0}, {0, 0, 1}});
  }
  std::vector<float> rays(receivers.size()), sum(receivers.size());
  constexpr int kTurns = 4;
  const OccluderBvh bvh(mesh.view());
  for (int turn = 0; turn < kTurns; ++turn) {
    AmbientOcclusion(bvh, SamplePattern::standard(1024), {.radius = 100, .seed = static_cast<std::uint64_t>(turn)})
        .query(receivers, {.occlusion = rays});
    for (std::size_t i = 0; i < rays.size(); ++i) sum[i] += rays[i] / kTurns;
  }
  double mean = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    mean += static_cast<double>(occlusion[i] - sum[i]) / static_cast<double>(sum.size());
    EXPECT_NEAR(occlusion[i], sum[i], 0.01f);
  }
  EXPECT_NEAR(mean, 0, 1e-3);
}

TEST_F(VolumesOnFloor, TessellationIsNothingWithoutFalloff) {
  const std::vector<float> two = draw_few(wall(2, 2, 1, 1));
  for (const auto& [columns, rows] : {std::pair{2, 1}, {10, 10}, {100, 100}}) {
    // 20,000 triangles at most. Float's rounding adds up.
    EXPECT_LT(largest_difference(draw_few(wall(2, 2, columns, rows)), two), 2e-3) << columns << " x " << rows;
  }
}

TEST_F(VolumesOnFloor, TessellationAddsFalloffSideways) {
  // "Overlapping occlusion volumes due to adjacent polygons on the same surface lead to correct results": of a large
  // triangle the falloff is that of its plane, of many small ones each has its own, so a finer wall darkens less. It
  // stops changing once triangles are small beside delta.
  const float delta = 1.5f;
  const std::vector<float> two = draw(wall(8, 8, 1, 1), delta, {.clamps_extensions = false});
  const std::vector<float> fine = draw(wall(8, 8, 64, 64), delta, {.clamps_extensions = false});
  const std::vector<float> finer = draw(wall(8, 8, 128, 128), delta, {.clamps_extensions = false});
  for (std::size_t i = 0; i < two.size(); ++i) {
    EXPECT_LE(finer[i], two[i] + 1e-4f);
    EXPECT_NEAR(finer[i], fine[i], 0.02f);
  }
  EXPECT_GT(largest_difference(two, finer), 0.1);
  RecordProperty("two_and_finer", std::to_string(largest_difference(two, finer)));
  RecordProperty("fine_and_finer", std::to_string(largest_difference(fine, finer)));
}

TEST_F(VolumesOnFloor, NeighboursLeaveNoSeam) {
  // Along a wall of columns, which meet at y = 0, pixels on both sides of a joint differ by no more than elsewhere.
  for (const float delta : {5000.0f, 1.5f}) {
    const std::vector<float> drawn = draw(wall(4, 3, 2, 1), delta, {.clamps_extensions = false});
    for (int x = 0; x < kWidth; ++x) {
      const auto at = [&](int y) { return drawn[static_cast<std::size_t>(y * kWidth + x)]; };
      const float across = std::fabs(at(kHeight / 2) - at(kHeight / 2 - 1));
      EXPECT_LE(across, 2e-3f + 2 * std::fabs(at(kHeight / 2 - 2) - at(kHeight / 2 - 1))) << distance(x);
    }
  }
}

TEST_F(VolumesOnFloor, ThinWallsAreCountedTwice) {
  // The paper's own weakness: two walls behind each other take twice as much, where rays see one.
  Mesh mesh = wall(4000, 2, 1, 1);
  const std::vector<float> one = draw(mesh, 4000);
  for (const glm::vec3& position : wall(4000, 2, 1, 1).positions)
    mesh.positions.push_back(position - glm::vec3(0.01f, 0, 0));
  mesh.triangles.emplace_back(4, 5, 6);
  mesh.triangles.emplace_back(4, 6, 7);
  const std::vector<float> two = draw(mesh, 4000);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(two[i], 2 * one[i], 0.03f);
}

TEST_F(VolumesOnFloor, EightBitsLoseSmallTriangles) {
  const Mesh mesh = wall(2, 2, 100, 100);
  const std::vector<float> exact = draw_few(mesh);
  EXPECT_LT(largest_difference(draw_few(mesh, Accessibility::bits16), exact), 0.1);
  EXPECT_GT(largest_difference(draw_few(mesh, Accessibility::bits8), exact), 0.2);
}

TEST_F(VolumesOnFloor, ClampedOnesReachTwiceDelta) {
  // A sliver that points along x: beyond 2 delta from its tip nothing is taken, without the clamp something is.
  Mesh mesh;
  mesh.positions = {{-6, -0.6f, 0.4f}, {0, 0, 0.1f}, {-6, 0.6f, 0.4f}};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<float> clamped = draw(mesh, 1), whole = draw(mesh, 1, {.clamps_extensions = false});
  double beyond = 0;
  for (std::size_t i = 0; i < clamped.size(); ++i) {
    const float x = distance(static_cast<int>(i) % kWidth);
    EXPECT_LE(clamped[i], whole[i] + 1e-6f);
    if (x < 2.05f) continue;
    EXPECT_EQ(clamped[i], 0) << x;
    beyond += static_cast<double>(whole[i]);
  }
  EXPECT_GT(beyond, 1e-3);
  EXPECT_GT(clamped[static_cast<std::size_t>(kHeight / 2 * kWidth + 4)], 0);
}

}  // namespace
}  // namespace lkao::gl::tests::volumes_claims_test
