#include "comparison.h"

#include <cmath>
#include <vector>

#include "lkao/lkao.h"

namespace moving_mesh {

Difference compare_with_query(lkao::gl::MaskPass& pass, const lkao::TriangleMesh& mesh,
                              const lkao::SamplePattern& pattern, const lkao::RayOptions& options,
                              std::span<const std::uint8_t> resolved) {
  std::vector<lkao::Receiver> receivers;
  for (const lkao::gl::PixelReceiver& pixel : pass.read_receivers()) {
    receivers.push_back(pixel.is_valid ? lkao::Receiver{pixel.origin, pixel.frame[2], pixel.up} : lkao::Receiver{});
  }
  lkao::RayOptions query = options;
  query.surface_offset = 0;  // the pass's receivers are off the surface already
  std::vector<float> occlusion(receivers.size());
  lkao::AmbientOcclusion(lkao::OccluderBvh(mesh), pattern, query).query(receivers, {.occlusion = occlusion});

  Difference difference;
  std::size_t equal_count = 0;
  double error_sum = 0;
  for (std::size_t i = 0; i < occlusion.size(); ++i) {
    if (std::isnan(occlusion[i])) continue;
    const long error = std::labs(std::lround(255 * occlusion[i]) - resolved[i]);
    ++difference.receiver_count;
    equal_count += error == 0;
    error_sum += static_cast<double>(error) / 255;
  }
  if (difference.receiver_count == 0) return difference;
  const auto count = static_cast<double>(difference.receiver_count);
  difference.equal_share = static_cast<double>(equal_count) / count;
  difference.mean_error = error_sum / count;
  return difference;
}

}  // namespace moving_mesh
