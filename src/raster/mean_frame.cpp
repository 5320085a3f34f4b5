#include "raster/mean_frame.h"

#include <cstddef>
#include <vector>

#include <epoxy/gl.h>

#include "gpu/gl/error.h"

namespace lkao::raster {

void draw_mean(int frame_count, const gl::OcclusionTarget& target, int width, int height,
               const std::function<void(int)>& draw) {
  std::vector<float> frame(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<double> sum(frame.size());
  for (int i = 0; i < frame_count; ++i) {
    draw(i);
    glGetTextureImage(target.texture, 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(frame.size() * sizeof(float)),
                      frame.data());
    for (std::size_t pixel = 0; pixel < sum.size(); ++pixel) sum[pixel] += static_cast<double>(frame[pixel]);
  }
  for (std::size_t pixel = 0; pixel < sum.size(); ++pixel) frame[pixel] = static_cast<float>(sum[pixel] / frame_count);
  glTextureSubImage2D(target.texture, 0, 0, 0, width, height, GL_RED, GL_FLOAT, frame.data());
  gl::check_errors("adding up frames");
}

}  // namespace lkao::raster
