// Volumetric ambient occlusion of what a G-buffer shows: how much of a ball on the surface is free.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/status.h"
#include "lkao/requirements.h"

namespace lkao::gl {

// Which pixels are looked at in full (Sec. 4.2). One pixel of each tile of 8 x 8 is tried with 8 samples first; where
// it and those of the eight tiles around find nothing in the way, the tile is culled.
enum class VaoCulling {
  off,
  greedy,   // culled tiles are open: things smaller than 8 pixels may be lost, and flicker
  careful,  // pixels of culled tiles take 4 samples, or fewer where they would have taken fewer
};

// What stands for the brightness of a colour.
enum class Brightness {
  luminance,  // 0.2126 red + 0.7152 green + 0.0722 blue
  value,      // the largest of the three: V of the HSV model
};

// Bright surfaces, such as lamps, are darkened less (Eq. 3): the occlusion is multiplied by
// (1 - clamp((brightness - threshold + width) / (2 width), 0, 1))^sigma.
struct LuminanceSensitivity {
  // From threshold - width to threshold + width occlusion falls to nothing. Finite; width above 0.
  float threshold = 0.5f;
  float width = 0.3f;
  // Above 0; 1: it falls evenly.
  float sigma = 1;
  Brightness brightness = Brightness::luminance;
};

struct VaoOptions {
  // AO radius, in the unit of the positions: the width of the ball, which touches the surface in the receiver: no
  // point of it is farther away. Above 0, at most 1e18.
  float radius = 0;

  // Line samples a pixel. 2, 4, 8, 16 or 32: sets whose places 3 x 3 pixels share among them, in each turned by another
  // ninth; a filter of 3 pixels, or more, joins them (BilateralFilter, radius 3). From 33 to 65535, for references: as
  // many places of an even sequence in every pixel, other ones for each pixel and `seed`.
  int sample_count = 16;
  std::uint32_t seed = 0;
  // Of sets: what is far away takes smaller ones. A ball whose width on the screen is this share of the picture's
  // shorter side takes 2 samples, one of twice the area 4, and so on up to `sample_count`. At least 0; 0: all take
  // `sample_count`.
  float fewest_samples_width = 0.02f;

  VaoCulling culling = VaoCulling::careful;

  // How thick what is seen is taken to be (Eq. 4), in AO radii. Of a line of the ball that is wholly behind what its
  // pixel shows, by a distance d, the share thickness / max(thickness, d / radius) is blocked. At least 0; infinity:
  // everything is infinitely thick, and leaves a dark outline on what is far behind it.
  float thickness = 0.03f;

  // Needs GBuffer::colours.
  std::optional<LuminanceSensitivity> luminance = {};

  // Where colours bleed: which samples count for it. 1: all, 2: every second, 4: every fourth.
  int bleeding_stride = 1;
};

// Where the colour of light that near surfaces send on is written: red, green and blue to multiply the light with,
// beside visibility; white is no change. Alpha becomes 1. GL_TEXTURE_2D, level 0, of the picture's size; GL_RGBA8,
// GL_RGBA16, GL_RGBA16F, GL_RGBA32F, GL_RGB10_A2 or GL_R11F_G11F_B10F.
struct BleedingTarget {
  ObjectName texture = 0;
  // As OcclusionTarget has it.
  std::optional<Part> part = {};
};

// Of a pass, for its life.
struct VaoPassSetup {
  // As MaskPassSetup has it.
  bool keep_state = true;
  HostErrors host_errors = HostErrors::reported;
  // Count pixels and samples (read_counts); costs time.
  bool count = false;
};

// Of one draw().
struct VaoCounts {
  std::uint64_t receivers = 0;  // pixels that have one
  std::uint64_t culled = 0;     // of them, those in culled tiles
  std::uint64_t samples = 0;    // line samples, those that were taken to find what to cull among them
};

// Volumetric ambient occlusion: the share of a ball on the surface that the eye does not see to be free. The ball
// touches the surface in the receiver from outside, so flat things are open at any angle, whatever the depths' format;
// it is filled with lines of view, of each of which the depth at its pixel says how much is free. Occluders count by
// the volume that they take, that is by the cube of the cosine to the normal where rays count the cosine, and are as
// deep as the ball where nothing else is known (`thickness`).
//
// Based on: J. Boksansky, A. Pospisil, J. Bittner, "VAO++: Practical Volumetric Ambient Occlusion for Games", EGSR 2017
// (Experimental Ideas & Implementations), after L. Szirmay-Kalos et al., "Volumetric Ambient Occlusion for Real-Time
// Rendering and Games", IEEE Computer Graphics and Applications 30(1), 2010.
//
// Near a perspective camera balls are smaller, so that none reaches behind the eye. What lies beyond the picture is not
// known, and does not count. gpu/README.md has measured how far all this is from rays.
//
// Context, state and errors as for MaskPass. Memory: 32 bytes a pixel and 4 bytes a tile of the largest picture so far.
class LKAO_API VaoPass {
 public:
  explicit VaoPass(const VaoPassSetup& setup = {});
  ~VaoPass();
  VaoPass(VaoPass&&) noexcept;
  VaoPass& operator=(VaoPass&&) noexcept;

  // Writes the occlusion of the G-buffer's pixels, by their shading normals. With `bleeding` the colours, too, of light
  // that comes by the surfaces around (Eq. 5): needs GBuffer::colours; culled pixels are white under
  // VaoCulling::greedy. Throws std::invalid_argument where a texture, the camera or an option is not what it should be.
  //
  // Costs a read of 16 bytes for each sample; twice that, and a colour, where colours bleed.
  void draw(const GBuffer& g_buffer, const Camera& camera, const VaoOptions& options, const OcclusionTarget& to,
            const BleedingTarget* bleeding = nullptr);

  // Of the last draw(). Waits for the GPU. Throws std::runtime_error where nothing was counted.
  VaoCounts read_counts() const;

  // The same for programs without exceptions; `try_make` gives none where it fails.
  static std::optional<VaoPass> try_make(const VaoPassSetup& setup, Status& status) noexcept;
  Status try_draw(const GBuffer& g_buffer, const Camera& camera, const VaoOptions& options, const OcclusionTarget& to,
                  const BleedingTarget* bleeding = nullptr) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::gl
