// The camera of the OpenGL side sees at each pixel what find_receivers() saw there.
#include "raster/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include <glm/matrix.hpp>

#include "raster/small_scene.h"

namespace lkao::raster::tests {
namespace {

TEST(RasterCamera, PixelsAreThoseOfFindReceivers) {
  const scene::Mesh mesh = small_scene();
  for (const auto& [width, height] : {std::pair{1, 1}, {33, 17}, {20, 61}}) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    const scene::ReceiverImage image = scene::find_receivers(mesh, small_camera(), width, height);
    ASSERT_GT(image.receiver_count, 0u);
    const gl::Camera camera = gl_camera(small_camera(), width, height);
    const glm::dmat4 clip_from_world = glm::dmat4(camera.projection) * glm::dmat4(camera.view);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto pixel = static_cast<std::size_t>(y * width + x);
        if (!image.sees(pixel)) continue;
        const glm::dvec4 clip = clip_from_world * glm::dvec4(glm::dvec3(image.receivers[pixel].position), 1);
        ASSERT_NEAR((clip.x / clip.w + 1) / 2 * width, x + 0.5, 1e-3);
        ASSERT_NEAR((clip.y / clip.w + 1) / 2 * height, y + 0.5, 1e-3);
        ASSERT_NEAR(clip.w, image.depth[pixel], 1e-5);
        ASSERT_LE(clip.z, clip.w);
      }
    }
  }
}

TEST(RasterCamera, IsRigidFarFromTheOriginAndForAnyLengthOfUp) {
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    const glm::vec3 eye = scale * glm::vec3(100, -40, 7);
    const gl::Camera camera =
        gl_camera({eye, eye + scale * glm::vec3(0.3f, 0.1f, -1), {0, 1e-3f * scale, 0}, 75}, 4, 3);
    const glm::mat3 turn(camera.view);
    const glm::mat3 product = glm::transpose(turn) * turn;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(product[i][k], i == k ? 1 : 0, 1e-6) << scale;
    }
    const glm::vec4 eye_in_view = camera.view * glm::vec4(eye, 1);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(eye_in_view[i], 0, 2e-5f * scale) << scale;
  }
}

}  // namespace
}  // namespace lkao::raster::tests
