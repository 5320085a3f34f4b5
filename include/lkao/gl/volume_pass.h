// Ambient occlusion volumes: occlusion without rays, as a pass that a renderer calls after its G-buffer.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/occluders.h"
#include "lkao/gl/status.h"
#include "lkao/receiver.h"
#include "lkao/requirements.h"

namespace lkao::gl {

// In what the paper's accessibility buffer sums up what triangles take from it. Each takes its part rounded to a step
// of the format, so small ones are lost: of 8 bits, all below 1/510. 8 and 16 bits saturate while they are drawn,
// floats at the end.
enum class Accessibility {
  bits8,   // GL_R8, the paper's: for scenes of large triangles
  bits16,  // GL_R16
  bits32,  // GL_R32F
};

// Of a pass, for its life.
struct VolumePassSetup {
  GeometryBackEnd geometry = GeometryBackEnd::automatic;
  Accessibility accessibility = Accessibility::bits16;
  // Find volumes once, and again only where occluders, radius or VolumeOptions::clamps_extensions change; without it in
  // every frame (Figure 10's two lines). Takes 48 bytes a triangle. See forget_volumes().
  bool keeps_volumes = false;
  // Count fragments (VolumeFragments); costs time.
  bool count_fragments = false;
  // As MaskPassSetup has them.
  bool keep_state = true;
  HostErrors host_errors = HostErrors::reported;
  bool check_g_buffer = true;
};

// Polynomials of occlusion o, x o + y o^2 + z o^3, kept within 0 to 1 (VolumeOptions::compensation).
inline constexpr glm::vec3 kNoCompensation{1, 0, 0};
// Nearest to rays of linear falloff, with a radius of 0.6 of theirs, over eight views of Sibenik, Conference, Armadillo
// and Sponza (`lkao-bench volumes --fit`, gpu/README.md): what is all dark becomes 0.63, as the paper's curve, of other
// scenes, ends near 0.75.
inline constexpr glm::vec3 kFittedCompensation{0.947f, -0.902f, 0.582f};

// How the volumes of a frame are drawn.
struct VolumeOptions {
  // No corner of a volume is farther than twice the radius from that of its triangle (Sec. 5.1): slivers have small
  // volumes, and corners sharper than 60 degrees lose what lies beyond, with an edge where that is cut off. Without it
  // volumes reach as far as the falloff.
  bool clamps_extensions = true;
  // Makes up for occluders that are counted twice, where some thinner than the radius lie behind each other (Sec. 5.4):
  // what is drawn becomes this polynomial of it.
  glm::vec3 compensation = kNoCompensation;
};

// Of the last draw(). Drawn / pixels is the paper's fill (Figure 10).
struct VolumeFragments {
  std::uint64_t drawn = 0;    // passed the depth test
  std::uint64_t inside = 0;   // of them, receivers within a volume: the falloff is above 0
  std::uint64_t blended = 0;  // of them, those with some of the triangle above their horizon
};

// Draws around each triangle the volume that it can darken, and takes from each pixel in it the exact share of the sky
// that the triangle covers, times a falloff (Eq. 5): the product of 1 - h / radius, h being the height over the
// triangle's plane, and of the same for the distance beyond each of its edges. No noise, no banding, and the same
// whatever the view. But shares are added up, so that triangles behind each other are counted twice: exact where
// nothing thinner than the radius is near, too dark where surfaces are stacked. The falloff is that of large triangles
// as a whole: in smaller ones it also counts how far each is sideways.
//
// Of RayOptions: `radius`, finite, is the paper's delta. It compares with rays of *linear* falloff, and then best with
// less than their radius: 0.6 of it in the paper (Sec. 6). `sidedness` and `surface_offset` mean what they mean for
// rays; jitter and seed mean nothing, there are no rays; `min_distance` must be 0. Receivers with geometric normals do
// not see what is below that horizon, and occlusion is the share of what they do see, as for the query.
//
// Context, state and errors as for MaskPass. Memory: 36 bytes a pixel (52 with geometric normals) and what
// Accessibility says, 40 bytes a triangle of the largest mesh.
class LKAO_API VolumePass {
 public:
  // Compiles shaders and checks what the driver can do.
  explicit VolumePass(const VolumePassSetup& setup = {});
  ~VolumePass();
  VolumePass(VolumePass&&) noexcept;
  VolumePass& operator=(VolumePass&&) noexcept;

  // Throws std::invalid_argument where a texture or an option is not what it should be, or where occluders have ranges:
  // of levels of detail only rays can tell what part of each counts.
  void draw(const Occluders& occluders, const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
            const OcclusionTarget& to, const VolumeOptions& volumes = {});

  // With VolumePassSetup::keeps_volumes, after positions were written by the GPU (Occluders::positions_buffer): the
  // next frame finds volumes anew. All other changes are known.
  void forget_volumes();

  // Zeros unless VolumePassSetup::count_fragments. Waits for the GPU. Throws std::runtime_error where nothing was
  // drawn.
  VolumeFragments read_fragment_counts();
  // As MaskPass has them.
  std::vector<std::string> warnings() const;

  // The same for programs without exceptions; `try_make` gives none where it fails.
  static std::optional<VolumePass> try_make(const VolumePassSetup& setup, Status& status) noexcept;
  Status try_draw(const Occluders& occluders, const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
                  const OcclusionTarget& to, const VolumeOptions& volumes = {}) noexcept;

  // What is used, after the driver's check.
  GeometryBackEnd geometry() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::gl
