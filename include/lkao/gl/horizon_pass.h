// Ambient occlusion by horizons: slices through a pixel's view direction, along which the depth buffer is walked.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/status.h"
#include "lkao/requirements.h"

namespace lkao::gl {

// What is kept of a slice, which is a half-disc around the normal that holds the direction to the eye.
enum class HorizonEstimator {
  // The highest point on either side: all below it is blocked, as in a height field, and the rest is integrated in
  // closed form (Jimenez et al. 2016).
  horizons,
  // A mask of 32 sectors: each pixel blocks those between its front and a back that lies `thickness` farther from the
  // eye; what is left of the bits is what is open (Therrien et al. 2023). Light passes behind what is thin.
  bitmask,
};

// How slices lie around the direction to the eye.
enum class SliceDensity {
  cosine,  // densest where the most cosine-weighted directions are: each slice stands for as many, and counts the same
  even,    // at equal angles, the papers'; weighed by the length of the normal's projection
};

// What the sectors of a mask have in common.
enum class SectorMeasure {
  cosine,  // equal cosine-weighted solid angles: counted bits are ambient occlusion
  angle,   // equal angles, and all slices weigh the same, as Therrien et al. have it: that is not quite ambient
           // occlusion, for directions near that to the eye count too much
};

struct HorizonOptions {
  HorizonEstimator estimator = HorizonEstimator::horizons;

  // AO radius: what is farther away blocks nothing. In the unit of the positions; above 0, at most 1e18.
  float radius = 0;
  // No farther than this on the screen, in pixels of the picture, however near the eye is: bounds how sparse the steps
  // may get. Above 0; perhaps infinite.
  float screen_radius = 512;

  // Slices a pixel, from 1 to 512, and steps on each of their two sides, from 1 to 16384; at most 16384 of both
  // multiplied. Where a side has no more pixels than that, each is stepped on once: `step_count` as large as the
  // picture is wide and high leaves slices alone to sample.
  int slice_count = 2;
  int step_count = 16;
  // Step i of n goes to about ((i + 1/2) / n)^step_exponent of the radius: from 1, evenly, to 4, mostly near by.
  float step_exponent = 2;

  // How far what a pixel shows reaches behind its front, in the unit of the positions; above 0, perhaps infinite: a
  // height field. The bitmask knows it as it is. Of horizons it is the length over which they sink to what is farther
  // on (to 1 / e of the difference), the thickness heuristic of Jimenez et al. 2016.
  float thickness = std::numeric_limits<float>::infinity();

  // Occluders count in full up to this share of the radius, from 0 to 1, and less and less from there to its end, where
  // they count nothing. 1: a constant falloff. The bitmask gives each sector a length of its own, so that 0 is the
  // linear falloff of rays; horizons sink in proportion.
  float falloff_begin = 1;

  // What rises less than this above the tangent plane blocks nothing, in radians, from 0 to 1: depths of any texture
  // are a little off (what can be known of that is added). Costs no more than its square of the occlusion.
  float angle_bias = 0.03f;

  SliceDensity slice_density = SliceDensity::cosine;
  SectorMeasure sector_measure = SectorMeasure::cosine;

  // Slices and steps lie otherwise in each pixel, and for each seed; those of consecutive seeds fill each other's gaps,
  // so that frames may be averaged.
  std::uint32_t seed = 0;
};

// Of a pass, for its life.
struct HorizonPassSetup {
  // As MaskPassSetup has it.
  bool keep_state = true;
  HostErrors host_errors = HostErrors::reported;
};

// Ambient occlusion of what the depth buffer shows, as engines have it today.
//
// Based on: J. Jimenez, X.-C. Wu, A. Pesce, A. Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion",
// SIGGRAPH 2016 Courses (Physically Based Shading in Theory and Practice), Technical Memo ATVI-TR-16-01 (GTAO); O.
// Therrien, Y. Levesque, G. Gilet, "Screen Space Indirect Lighting with Visibility Bitmask", 2023, arXiv:2301.11376.
//
// Where the screen shows all that is within the radius, and no surface is thinner than `thickness`, both estimators
// converge to what rays find; gpu/README.md has how near they come, and what of it is noise. Shading normals are the
// axis, geometric ones the horizon below which nothing is cast: a flat surface is open whatever its normals.
//
// Context, state and errors as for MaskPass. Memory: 32 bytes a pixel of the largest picture so far.
class LKAO_API HorizonPass {
 public:
  explicit HorizonPass(const HorizonPassSetup& setup = {});
  ~HorizonPass();
  HorizonPass(HorizonPass&&) noexcept;
  HorizonPass& operator=(HorizonPass&&) noexcept;

  // Writes the occlusion of the G-buffer's pixels. Noisy with few slices: BilateralFilter smooths it. Throws
  // std::invalid_argument where a texture, the camera or an option is not what it should be.
  //
  // Costs at most 2 x slice_count x step_count reads of 16 bytes a pixel.
  void draw(const GBuffer& g_buffer, const Camera& camera, const HorizonOptions& options, const OcclusionTarget& to);

  // The same for programs without exceptions; `try_make` gives none where it fails.
  static std::optional<HorizonPass> try_make(const HorizonPassSetup& setup, Status& status) noexcept;
  Status try_draw(const GBuffer& g_buffer, const Camera& camera, const HorizonOptions& options,
                  const OcclusionTarget& to) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::gl
