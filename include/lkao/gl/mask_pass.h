// The rasterised method as a pass that a renderer calls after its G-buffer.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/occluders.h"
#include "lkao/gl/status.h"
#include "lkao/occlusion_mask.h"
#include "lkao/plane_mask_table.h"
#include "lkao/receiver.h"
#include "lkao/requirements.h"

namespace lkao::gl {

// Tests that end a fragment early. They change the time of a frame and no exact mask; for measuring.
struct Culls {
  // The paper's, in its order (Sec. 4.2).
  bool far_depth = true;
  bool bounding_sphere = true;
  bool facing = true;
  bool plane_distance = true;
  bool horizon = true;
  // Not the paper's: the receiver is farther than the radius from the triangle itself. Masks of nearest cells would
  // otherwise depend on which shape bounds the triangle.
  bool reach = true;
};

// How the occluders of a frame are drawn. Changes no exact mask.
struct RasterOptions {
  // Alpha of the paper: triangles whose bounding sphere is smaller than this share of the radius get a billboard, the
  // others a prism. At least 0; 0: prisms only; infinity: billboards wherever the camera is outside of them.
  float billboard_threshold = 0.2f;
  Culls culls = {};
};

enum class Accumulator {
  automatic,  // the first of these that passes the driver's check: logic_op, ssbo
  logic_op,   // glLogicOp(GL_OR) on integer colour attachments, the paper's
  ssbo,       // atomicOr on shader storage
};

// In which the shaders decide about a ray.
enum class Precision {
  single_precision,  // differs from the CPU where a ray passes an edge, or ends at a plane, within some 1e-6
  double_precision,  // the CPU's arithmetic; slow on most GPUs
};

// Of a pass, for its life.
struct MaskPassSetup {
  GeometryBackEnd geometry = GeometryBackEnd::automatic;
  Accumulator accumulator = Accumulator::automatic;
  Precision precision = Precision::single_precision;
  // Count fragments (FragmentCounts); costs time.
  bool count_fragments = false;
  // Put OpenGL's state back at the end of every call. Without it a call asks OpenGL nothing (some 130 questions a
  // frame) and leaves the state that it touches as it needs it: for engines that set all state before each pass of
  // their own.
  bool keep_state = true;
  HostErrors host_errors = HostErrors::reported;
  // Look at 256 pixels of the first frame, and of the first after a change of which textures a G-buffer has, of their
  // formats or spaces: positions that are not at their pixels are a wrong argument, and warnings() are found. Waits
  // for the GPU in such a frame; the others cost a comparison.
  bool check_g_buffer = true;
};

// Of the last draw().
struct FragmentCounts {
  std::uint64_t drawn = 0;      // passed the depth test and show a receiver
  std::uint64_t survivors = 0;  // passed the paper's five culls as well
  std::uint64_t masks = 0;      // a mask was made: within reach, and the triangle can block rays
};

// A receiver as the last draw() saw it.
struct PixelReceiver {
  bool is_valid = false;  // false: the pixel has no receiver
  glm::vec3 origin{0};    // where the rays start, surface offset included
  glm::mat3 frame{1};     // where the pattern's axes go
  glm::vec3 up{0};        // geometric normal, unit length
};

// Where resolve() writes; what has no texture is not written.
struct ResolveTargets {
  // Share of the cast rays that are blocked, 0 to 1.
  OcclusionTarget occlusion = {};
  // A texture of the same size, or with the same part, in GL_RGBA16F or GL_RGBA32F: mean direction of the rays that are
  // not blocked, a unit vector in world space, the pattern's axis where all are blocked; alpha 1. (0, 0, 0, 0) where
  // there is no receiver.
  ObjectName bent_normals = 0;
};

// The rasterised method: occlusion masks of all pixels of a G-buffer.
//
// What a pixel's mask says is what the CPU's query says (AmbientOcclusion), for the same receiver: with a table of
// PlaneMasks::must_may to the rounding of the chosen precision, with PlaneMasks::nearest as nearly as the table's cells
// tell.
//
// Every member needs the context in which the object was made, current in the calling thread; the destructor too.
// They leave the context's state as they find it unless MaskPassSetup says otherwise; gpu/README.md lists what they
// touch. Errors of OpenGL and missing features throw std::runtime_error, wrong arguments std::invalid_argument, both
// with one line.
class LKAO_API MaskPass {
 public:
  // Compiles shaders and checks what the driver can do.
  explicit MaskPass(const MaskPassSetup& setup = {});
  ~MaskPass();
  MaskPass(MaskPass&&) noexcept;
  MaskPass& operator=(MaskPass&&) noexcept;

  // Copies table and pattern to the GPU. The table's PlaneMasks decide: `nearest` gives the paper's approximate masks,
  // `must_may` exact ones.
  void set_table(const PlaneMaskTable& table);

  // Finds the masks. Needs a table. The receiver of pixel (x, y) casts the rays that the CPU's query casts for it with
  // these options and the index y * picture_width + x. Its own images grow to the largest picture so far, so that
  // pictures of several sizes may take turns; a new MaskPass gives the memory back. The first frame whose occluders
  // have ranges, or with a min_distance, copies more of the table, where its rays are of several lengths.
  //
  // With an infinite radius the pass finds on the GPU, in every frame, a power of two beyond the largest distance
  // between the bounds of occluders and pixels, and less than four times that. Every shape covers all receivers, so
  // such a frame is slow. Throws std::invalid_argument where an option is out of range, and for an infinite radius
  // where the table's rays are not all as long as the AO radius.
  void draw(const Occluders& occluders, const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
            const RasterOptions& raster = {});

  // The following are about the last draw(), and throw std::runtime_error where there was none.

  void resolve(const ResolveTargets& targets);
  // SamplePattern::word_count() words for every pixel of the picture, row by row from y = 0, as OcclusionMask has them.
  // Waits for the GPU.
  std::vector<std::uint64_t> read_masks();
  // For every pixel, row by row. Waits for the GPU.
  std::vector<PixelReceiver> read_receivers();
  // Zeros unless MaskPassSetup::count_fragments. Waits for the GPU.
  FragmentCounts read_fragment_counts();
  // The masks themselves: a GL_TEXTURE_2D_ARRAY of GL_RGBA32UI, 128 rays a layer (ray i: layer i / 128, component
  // i / 32 % 4, bit i % 32). The pass's own, and at least as large as the picture, which begins at texel (0, 0); valid
  // until the next draw().
  ObjectName masks_texture() const;

  // The same for programs without exceptions; `try_make` gives none where it fails.
  static std::optional<MaskPass> try_make(const MaskPassSetup& setup, Status& status) noexcept;
  Status try_set_table(const PlaneMaskTable& table) noexcept;
  Status try_draw(const Occluders& occluders, const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
                  const RasterOptions& raster = {}) noexcept;
  Status try_resolve(const ResolveTargets& targets) noexcept;
  // Remarks on the last draw()'s G-buffer: what will do, but not well, such as positions of half floats. A line each;
  // none without MaskPassSetup::check_g_buffer.
  std::vector<std::string> warnings() const;

  // What is used, after the driver's check.
  GeometryBackEnd geometry() const;
  Accumulator accumulator() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::gl
