// Ambient occlusion of spheres: those that a G-buffer's pixels stand for, and those that stand for a scene.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include <glm/vec4.hpp>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/status.h"
#include "lkao/requirements.h"

namespace lkao::gl {

// What a sphere of radius r at the distance d blocks of a receiver, in the direction theta from its normal. What lies
// below the horizon (cos theta < 0) blocks nothing; a sphere that the horizon cuts is not clipped.
enum class SphereFormula {
  cap,      // Eqs. 2 and 3 with Eq. 1's 1 / pi: 2 (1 - sqrt(1 - (r / d)^2)) cos theta
  exact,    // (r / d)^2 cos theta: what rays find where the whole sphere is above the horizon
  printed,  // Eqs. 2 and 3 as they are printed, pi times `cap`
};

// What a sphere of the far half blocks of receivers inside of it.
enum class InsideSphere {
  faded,       // nothing, and less and less from three radii on: what a sphere stands for is no sphere from so near
  nothing,     // nothing, but all of it outside: shows the outlines of spheres
  everything,  // as the paper has it (Sec. 6); the scene's surface lies within its own spheres, so much gets black
};

// Where a random subset of the pixels around a receiver lies. Either way its mean is the sum over all of them.
enum class SampleDensity {
  even,     // as often in all of the disc, the paper's
  falling,  // as 1 / the distance on the screen, for what is near blocks most: far less noise
};

struct SplatOptions {
  // Which halves: pixels around the receiver; spheres of the scene.
  bool near_half = true;
  bool far_half = true;

  // The near half (Sec. 4). r_far of Eq. 4: spheres of pixels count where their centres are nearer than that, in the
  // unit of the positions; above 0, at most 1e18. With both halves the far one begins there: of a sphere only the share
  // beyond it counts, by its extent along the line to the receiver.
  float near_radius = 0;
  // How many pixels are looked at: so many for each pixel that near_radius is long on the screen (at least 0), and at
  // most so many in all (1 to 65536). Where they are as many as the disc has pixels, each is looked at once; else a
  // random subset, other ones in each pixel and for each seed.
  float samples_per_pixel = 4;
  int max_sample_count = 64;
  SampleDensity density = SampleDensity::falling;
  std::uint32_t seed = 0;
  // Radius of a pixel's sphere, in widths of a pixel at its distance; above 0, at most 16. The sphere touches the
  // surface from behind. 0.5: it fills its pixel from side to side.
  float pixel_sphere_radius = 0.5f;

  // The far half (Sec. 5). Spheres count up to the distance at which they block no more than this (Eq. 5): above 0, at
  // most 1. The formula decides what distance that is: sphere_reach().
  float epsilon = 0.01f;
  // No farther than that in any case, by the share of their extent that is nearer, as above: an AO radius. Above 0.
  float far_radius = std::numeric_limits<float>::infinity();
  InsideSphere inside = InsideSphere::faded;

  // Of both.
  SphereFormula formula = SphereFormula::cap;
};

// How far a sphere of radius 1 reaches: where it blocks `epsilon` of a receiver that faces it (Eq. 5).
LKAO_API float sphere_reach(float epsilon, SphereFormula formula);

// Of a pass, for its life.
struct SplatPassSetup {
  // As MaskPassSetup has it.
  bool keep_state = true;
  HostErrors host_errors = HostErrors::reported;
  // Count the far half's fragments (read_fragment_count); costs little time. No query of the host that counts samples
  // may be under way then.
  bool count_fragments = false;
};

// Approximate ambient occlusion for moving scenes, from two sources that are added up. The near half takes each pixel
// of the G-buffer for a small sphere and gathers those around a receiver: detail, whatever the scene's size, but only
// of what is seen. The far half splats the spheres of the scene over the pixels that they reach: large, distant
// occluders, seen or not.
//
// Based on: P. Shanmugam, O. Arikan, "Hardware Accelerated Ambient Occlusion Techniques on GPUs", I3D 2007.
//
// Spheres are added up where they overlap, and nothing behind another one is left out, so that corners get darker than
// rays find them: gpu/README.md has measured how much. The sum is cut off at 1.
//
// Context, state and errors as for MaskPass. Memory: 52 bytes a pixel of the largest picture so far, 16 more with a
// second layer; 16 bytes a sphere.
class LKAO_API SplatPass {
 public:
  explicit SplatPass(const SplatPassSetup& setup = {});
  ~SplatPass();
  SplatPass(SplatPass&&) noexcept;
  SplatPass& operator=(SplatPass&&) noexcept;

  // The spheres of the far half: centre in world space, and radius. They stay until the next call; for a mesh that
  // deforms, once a frame. Those whose radius is not above 0, or with a number that is not finite or beyond 1e18, block
  // nothing. Throws std::runtime_error where there are more than GL_MAX_TEXTURE_BUFFER_SIZE.
  void set_spheres(std::span<const glm::vec4> spheres);
  // Four floats each, for spheres that are found on the GPU: write there between draws, with
  // glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT) after a shader. Another one after set_spheres() with another number
  // of spheres.
  ObjectName spheres_buffer() const;

  // Writes the occlusion of the G-buffer's pixels. `behind`, where it is given, is a second layer of the scene for the
  // near half, of the same size and seen by the same camera: what is behind the first, by depth peeling, or the back
  // faces. It only blocks. Throws std::invalid_argument where a texture, the camera or an option is not what it should
  // be.
  //
  // Costs, in the near half, a read of 16 bytes for each sample and layer; in the far half a fragment for each sphere
  // that reaches a pixel.
  void draw(const GBuffer& g_buffer, const Camera& camera, const SplatOptions& options, const OcclusionTarget& to,
            const GBuffer* behind = nullptr);

  // Fragments of the far half in the last draw(), whether or not they block anything. Waits for the GPU. Throws
  // std::runtime_error where nothing was counted.
  std::uint64_t read_fragment_count() const;

  // The same for programs without exceptions; `try_make` gives none where it fails.
  static std::optional<SplatPass> try_make(const SplatPassSetup& setup, Status& status) noexcept;
  Status try_set_spheres(std::span<const glm::vec4> spheres) noexcept;
  Status try_draw(const GBuffer& g_buffer, const Camera& camera, const SplatOptions& options, const OcclusionTarget& to,
                  const GBuffer* behind = nullptr) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::gl
