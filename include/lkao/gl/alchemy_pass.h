// Ambient obscurance from the G-buffer alone: a cheap likeness of occlusion, as a pass that a renderer calls after its
// G-buffer.
//
// Based on: M. McGuire, B. Osman, M. Bukowski, P. Hennessy, "The Alchemy Screen-Space Ambient Obscurance Algorithm",
// HPG 2011; M. McGuire, M. Mara, D. Luebke, "Scalable Ambient Obscurance", HPG 2012 (its spiral and falloffs).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/status.h"
#include "lkao/requirements.h"

namespace lkao::gl {

// Where the samples of a receiver lie: in a disc of the AO radius around it, parallel to the picture. All count the
// same.
enum class DiscPattern {
  jittered,     // as often everywhere, other places in each pixel: Alchemy's
  spiral,       // the successor's, turned at random in each pixel: their distance grows with their number, so that they
                // lie densest in the middle, as 1 / distance, and what is near counts for more than in Eq. 10
  even_spiral,  // the same spiral, as often everywhere: their distance grows as the root of their number
};

// How obscurance falls with the distance. Of an occluder at x radii, whose height over the receiver's plane is h radii:
enum class ObscuranceFalloff {
  cut_off,  // h / (x^2 + epsilon) up to the radius: Alchemy's (Eqs. 9 and 10)
  // Of the program that its authors published with Scalable Ambient Obscurance, as they weigh them against each other;
  // in this order of ever less contrast.
  smooth,  // 5/3 (1 - x^2)^3 h / (x^2 + epsilon): their choice; nothing ends with an edge
  medium,  // 20/3 (1 - x^2) h
  low,     // 10/3 h up to the radius
};

// Lengths are in AO radii where nothing else is said, so that pictures do not depend on the scene's unit.
struct AlchemyOptions {
  // AO radius r, in the unit of the positions; from 1e-18 to 1e18. Nothing farther off obscures.
  float radius = 0;
  // How dark: sigma, a length. The paper's images have 1 m where the radius is 0.5 m. From 0 to 1e18.
  //
  // Obscurance is no share of blocked rays, and has no right intensity. Nearest to rays is 0.3 to 1, and some 0.8 in
  // rooms; gpu/README.md has measured it.
  float intensity = 2;
  // What is lower than that over the receiver's plane does not obscure: beta, a share of the distance along the view
  // (the errors of depths and normals grow with it). Of a parallel camera, whose distances mean nothing, a share of
  // half the longer side of what it sees. From 0 to 1e18.
  float bias = 1e-4f;
  // Keeps what touches the receiver from counting without end: in squared radii, from 1e-12 to 1e12. The paper's 1e-4
  // m^2 of a radius of 0.5 m.
  float epsilon = 4e-4f;
  // k: visibility is taken to this power. Above 0, finite.
  float contrast = 1;
  ObscuranceFalloff falloff = ObscuranceFalloff::cut_off;

  // Samples of each band of a receiver, at least 1. It takes all bands where the disc's radius on the screen is
  // full_radius pixels or more, one less where it is less than that, two less where it is less than half of it, and so
  // on, but at least one (Figure 5, Table 1). max_band_count: 1 to 16; full_radius: at least 0; in all at most 16384
  // samples.
  int samples_per_band = 4;
  int max_band_count = 3;
  float full_radius = 32;
  DiscPattern pattern = DiscPattern::jittered;
  // Of spirals: turns from the first sample to the last; above 0, finite. The successor's 7 are for 9 samples. Many
  // samples are spread best by 0.382 turns for each (the golden angle).
  float spiral_turns = 7;
  // Other samples, for frames that are averaged.
  std::uint32_t seed = 0;
};

// Of a pass, for its life.
struct AlchemyPassSetup {
  // As MaskPassSetup has it.
  bool keep_state = true;
  HostErrors host_errors = HostErrors::reported;
};

// Looks at some pixels around each one, and adds up how high over its plane, and how near, they are (Eq. 10). Planes
// stay open at any angle, and nothing beyond the radius darkens. What is hidden from the camera, or beyond the edges of
// the picture, does not darken either: a renderer may give it a margin (a guard band) and show the middle.
//
// A receiver is darker where what is near it faces the camera: it depends on the view, and is not what rays find. Few
// samples leave noise, different in each pixel, that BilateralFilter takes away; the paper's two passes are its radius
// of 6.
//
// Where the G-buffer has geometric normals, what is below the surface itself does not obscure.
//
// Context, state and errors as for MaskPass. Memory: 32 bytes a pixel of the largest picture so far.
class LKAO_API AlchemyPass {
 public:
  explicit AlchemyPass(const AlchemyPassSetup& setup = {});
  ~AlchemyPass();
  AlchemyPass(AlchemyPass&&) noexcept;
  AlchemyPass& operator=(AlchemyPass&&) noexcept;

  // Writes the occlusion of the G-buffer's pixels: 1 - A of Eq. 10. Costs a read of 16 bytes for each sample. Throws
  // std::invalid_argument where a texture, the camera or an option is not what it should be.
  void draw(const GBuffer& g_buffer, const Camera& camera, const AlchemyOptions& options, const OcclusionTarget& to);

  // The same for programs without exceptions; `try_make` gives none where it fails.
  static std::optional<AlchemyPass> try_make(const AlchemyPassSetup& setup, Status& status) noexcept;
  Status try_draw(const GBuffer& g_buffer, const Camera& camera, const AlchemyOptions& options,
                  const OcclusionTarget& to) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::gl
