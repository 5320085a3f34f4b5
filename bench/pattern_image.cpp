#include "bench/pattern_image.h"

#include <vector>

#include <tbb/parallel_for.h>
#include <glm/mat3x3.hpp>

#include "bench/pattern_cases.h"
#include "bench/pattern_hits.h"
#include "query/receiver_rays.h"
#include "scene/builtin.h"
#include "scene/camera.h"

namespace lkao::bench {
namespace {

constexpr int kWidth = 240, kHeight = 180;
constexpr struct {
  int ray_count;
  float rotation;
} kRows[] = {{64, 1}, {128, 1}, {64, 0.125f}, {64, 0}};

float visibility(const FirstHits& hits, const Receiver& receiver, const SamplePattern& pattern, float rotation,
                 std::uint64_t index) {
  std::vector<float> distances(pattern.directions().size());
  const Jitter jitter{.rotation = rotation, .tilt = 0};
  hits.find(receiver, query::jittered_frame(receiver, jitter, pattern.lowest_elevation(), 0, index),
            pattern.directions(), distances);
  int open_count = 0;
  for (float distance : distances) open_count += distance > 1;
  return static_cast<float>(open_count) / static_cast<float>(pattern.ray_count());
}

}  // namespace

image::Image pattern_image(const std::string& builtin_scene) {
  const scene::BuiltinScene& builtin = scene::builtin_scene(builtin_scene);
  const scene::Mesh mesh = scene::make_builtin(builtin_scene);
  scene::Camera camera = builtin.camera;
  camera.fov *= 0.15f;
  const scene::ReceiverImage seen = scene::find_receivers(mesh, camera, kWidth, kHeight);
  const FirstHits hits(mesh, builtin.radii.large);

  const int columns = static_cast<int>(std::size(kPatternKinds)), rows = static_cast<int>(std::size(kRows));
  image::Image picture{columns * kWidth, rows * kHeight, {"Y"}, {}};
  picture.pixels.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 0.0f);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const SamplePattern pattern = SamplePattern::make(kPatternKinds[column], kRows[row].ray_count);
      tbb::parallel_for(std::size_t{0}, seen.receivers.size(), [&](std::size_t pixel) {
        if (!seen.sees(pixel)) return;
        const int x = column * kWidth + static_cast<int>(pixel % kWidth);
        const int y = row * kHeight + static_cast<int>(pixel / kWidth);
        picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                       static_cast<std::size_t>(x)] =
            visibility(hits, seen.receivers[pixel], pattern, kRows[row].rotation, pixel);
      });
    }
  }
  return picture;
}

}  // namespace lkao::bench
