// The furnished room by volumes, as it was when its picture in golden/ was made by their definition.
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_volumes --gtest_filter=VolumesGolden.*
//
// makes the picture anew, on the CPU: look at it, and commit it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "gpu/camera_rays.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "gpu/volumes_definition.h"
#include "image/image.h"

namespace lkao::gl::tests::volumes_golden_test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr float kDelta = 0.8f;

// Pictures begin at the top.
std::size_t picture_index(std::size_t pixel) {
  const std::size_t x = pixel % kWidth, y = pixel / kWidth;
  return (kHeight - 1 - y) * kWidth + x;
}

class VolumesGolden : public OnSoftware {};

TEST_F(VolumesGolden, IsDrawn) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const std::vector<Receiver> seen = cast_camera_rays(mesh, camera, kWidth, kHeight);
  const std::string path = LKAO_GOLDEN_DIR "/volumes.png";
  const RayOptions options{.radius = kDelta, .surface_offset = kQuerySurfaceOffset};
  if (std::getenv("LKAO_REMAKE_GOLDEN") != nullptr) {
    std::vector<float> pixels(std::size_t{kWidth} * kHeight);
    const std::vector<VolumeReceiver> receivers = volume_receivers(mesh, seen, options);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[picture_index(i)] =
          static_cast<float>(std::min(VolumeDefinition{kDelta}.occlusion(mesh, receivers[i]), 1.0));
    }
    image::write_image(path, {kWidth, kHeight, {"occlusion"}, pixels});
  }
  const image::Image image = image::read_image(path);
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  const Occluders occluders(mesh.positions, mesh.triangles);
  std::vector<glm::vec4> positions, normals;
  for (const Receiver& receiver : seen) {
    positions.emplace_back(receiver.position, 1);
    normals.emplace_back(receiver.normal, 0);
  }
  const Texture position_image = make_image(GL_RGBA32F, kWidth, kHeight, &positions[0].x);
  const Texture normal_image = make_image(GL_RGBA32F, kWidth, kHeight, &normals[0].x);
  const Texture target = make_image(GL_R32F, kWidth, kHeight);
  VolumePass pass;
  pass.draw(occluders,
            {.width = kWidth, .height = kHeight, .positions = position_image.name(), .normals = normal_image.name()},
            camera, options, {target.name()});
  const std::vector<glm::vec4> drawn = read_image(target.name(), kWidth, kHeight);
  // In steps of 8 bits. Half of one is the picture's own rounding; the rest is for the edges of clamped volumes.
  std::size_t off_count = 0;
  double worst = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double off =
        255 * std::fabs(static_cast<double>(drawn[i].x) - static_cast<double>(image.pixels[picture_index(i)]));
    off_count += off > 1;
    worst = std::max(worst, off);
  }
  EXPECT_LE(static_cast<double>(off_count) / static_cast<double>(drawn.size()), 0.002);
  EXPECT_LE(worst, 30);
  RecordProperty("off", std::to_string(off_count) + " off, at most " + std::to_string(worst));
}

}  // namespace
}  // namespace lkao::gl::tests::volumes_golden_test
