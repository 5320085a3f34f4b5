// Smoothing occlusion without crossing edges, for the result of any method.
#pragma once

#include <memory>
#include <optional>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/status.h"
#include "lkao/requirements.h"

namespace lkao::gl {

struct BilateralFilterOptions {
  // Pixels on each side that are averaged, along rows and then along columns; 1 to 16. Weights fall as a Gauss curve
  // that is a tenth at the last pixel. Where upsampled: pixels of the result, and at least the step.
  int radius = 4;
  // How far from the plane of the pixel in the middle its neighbours may lie, in widths of a pixel there: the weight is
  // 1 / e at this distance. Above 0.
  float depth_tolerance = 4;
  // How sharply normals divide: the weight is max(0, n . n')^sharpness of both unit normals. At least 0; 0: not at all.
  float normal_sharpness = 8;
};

// Of a filter, for its life.
struct BilateralFilterSetup {
  // As MaskPassSetup has it.
  bool keep_state = true;
  HostErrors host_errors = HostErrors::reported;
};

// A separable cross-bilateral filter: a mean over neighbours, weighted by how near they are on the screen, how near
// they lie to the plane of the pixel in the middle, and how alike their normals are. Pixels without a receiver neither
// give nor take.
//
// Based on: G. Petschnigg et al., "Digital Photography with Flash and No-Flash Image Pairs", SIGGRAPH 2004, Sec. 4.1
// (joint bilateral filter); T. Pham, L. van Vliet, "Separable Bilateral Filtering for Fast Video Preprocessing",
// ICME 2005; distances from planes instead of differences of depth, so that slanted surfaces stay whole.
//
// Context, state and errors as for MaskPass. Memory: 4 bytes a pixel for the result of the first direction, of the
// largest picture so far.
class LKAO_API BilateralFilter {
 public:
  explicit BilateralFilter(const BilateralFilterSetup& setup = {});
  ~BilateralFilter();
  BilateralFilter(BilateralFilter&&) noexcept;
  BilateralFilter& operator=(BilateralFilter&&) noexcept;

  // From what a pass wrote for this G-buffer to another target, or to the same: quantity, channel and part may differ,
  // and `from` may be of any format that shaders read as floats. Costs 2 (2 radius + 1) reads of the G-buffer a pixel.
  // Throws std::invalid_argument where a texture or an option is not what it should be.
  void filter(const GBuffer& g_buffer, const Camera& camera, const OcclusionTarget& from, const OcclusionTarget& to,
              const BilateralFilterOptions& options = {});

  // From what a pass wrote for this G-buffer, whose `step` is above 1, to all of its pixels: a mean of the samples
  // within `radius`, weighted in the same way, in one go. What looks like no sample near by, such as a wire between
  // two, takes the mean of all of them; what has none near by at all is open. `to` is of the G-buffer's width and
  // height and must not lie on `from`. Costs (2 radius / step + 1)^2 reads of the G-buffer a pixel.
  //
  // Based on: J. Kopf et al., "Joint Bilateral Upsampling", SIGGRAPH 2007.
  void upsample(const GBuffer& g_buffer, const Camera& camera, const OcclusionTarget& from, const OcclusionTarget& to,
                const BilateralFilterOptions& options = {});

  // The same for programs without exceptions; `try_make` gives none where it fails.
  static std::optional<BilateralFilter> try_make(const BilateralFilterSetup& setup, Status& status) noexcept;
  Status try_filter(const GBuffer& g_buffer, const Camera& camera, const OcclusionTarget& from,
                    const OcclusionTarget& to, const BilateralFilterOptions& options = {}) noexcept;
  Status try_upsample(const GBuffer& g_buffer, const Camera& camera, const OcclusionTarget& from,
                      const OcclusionTarget& to, const BilateralFilterOptions& options = {}) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::gl
