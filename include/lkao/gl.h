// The OpenGL side of the library; link lkao::gl. The rasterised method as a pass that a renderer calls after its
// G-buffer, and an OpenGL context without a window.
//
// Outside the umbrella lkao.h, so that users of the CPU library need nothing of OpenGL. Needs OpenGL 4.5 core. Names of
// OpenGL's objects are plain integers here, so that no particular loader is needed.
//
//   lkao::gl::OcclusionPass pass;                                   // with the renderer's context current
//   pass.set_occluders(positions, triangles);
//   pass.set_table(lkao::PlaneMaskTable(lkao::SamplePattern::standard(128)));
//   each frame:
//     pass.update_positions(positions);                             // where the mesh moves
//     pass.draw({.width = w, .height = h, .depth = depth_texture, .normals = normal_texture}, {view, projection},
//               {.radius = 2.0f});
//     pass.resolve({.occlusion = r8_texture});
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lkao/occlusion_mask.h"
#include "lkao/plane_mask_table.h"
#include "lkao/receiver.h"

namespace lkao::gl {

enum class Device {
  automatic,  // hardware where there is any, else software
  hardware,   // a GPU
  software,   // a rasteriser on the CPU, such as Mesa's llvmpipe
};

// An OpenGL 4.5 core context that draws into framebuffer objects only, made through EGL without any window system.
// Contexts share nothing with each other. For programs without a window (tests, batch rendering); a renderer that has
// a context of its own needs none of this.
//
// Threads: a context is current in one thread at a time, as OpenGL wants it. Different contexts may be used in
// different threads at the same time.
class HeadlessContext {
 public:
  // Leaves the calling thread's current context as it was: call make_current() before the first OpenGL call.
  // Throws std::runtime_error with one line where EGL offers no such device or it cannot do OpenGL 4.5.
  explicit HeadlessContext(Device device = Device::automatic);
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  // Makes this context the calling thread's current one. Throws std::runtime_error where it cannot be, for example
  // because it is current in another thread.
  void make_current();
  // Leaves the calling thread without a current context. Does nothing where this one is not current there.
  void release();

  // What the driver calls itself: GL_RENDERER and GL_VERSION.
  const std::string& renderer() const { return renderer_; }
  const std::string& version() const { return version_; }
  // True where the CPU rasterises.
  bool is_software() const { return is_software_; }

 private:
  void* display_ = nullptr;  // EGLDisplay
  void* context_ = nullptr;  // EGLContext
  std::string renderer_;
  std::string version_;
  bool is_software_ = false;
};

// A texture, buffer or other object of the current context; 0 where there is none.
using ObjectName = std::uint32_t;

// What depths the projection makes: glClipControl's GL_NEGATIVE_ONE_TO_ONE (OpenGL's default) or GL_ZERO_TO_ONE.
enum class ClipDepth { minus_one_to_one, zero_to_one };

// What made the G-buffer. `view` is a rigid motion from world to view space, where the camera looks along -z (as
// glm::lookAt makes it). `projection` is a perspective (symmetric or not) or an orthographic one; standard and reversed
// Z, a far plane at infinity, and mirrored axes are all understood from the matrix. Pixel (0, 0) of the textures is at
// normalised device coordinates (-1, -1).
struct Camera {
  glm::mat4 view{1};
  glm::mat4 projection{1};
  ClipDepth clip_depth = ClipDepth::minus_one_to_one;
};

// Which space normals are in.
enum class NormalSpace { world, view };

// The caller's textures, each GL_TEXTURE_2D of width x height; only read. Exactly one of the first three says where a
// pixel's receiver is. A pixel has no receiver where its depth is the far end of the depth range, its position is not
// finite, or its normal is zero or not finite.
struct GBuffer {
  int width = 0;
  int height = 0;
  ObjectName depth = 0;  // window-space depth of a depth range of 0 to 1: a depth texture, or its copy in a colour one
  ObjectName linear_depth = 0;  // red: distance along the camera's view direction
  ObjectName positions = 0;     // world space; must lie at their pixels' centres as the camera sees them
  // Shading normals of any length. Unsigned normalised formats are taken for n / 2 + 1/2.
  ObjectName normals = 0;
  // The side of the surface that a receiver lies on (Receiver::geometric_normal); 0: the same as `normals`.
  ObjectName geometric_normals = 0;
  NormalSpace normal_space = NormalSpace::world;
};

// Tests that end a fragment early. They change the time of a frame and no exact mask; for measuring.
struct Culls {
  // The paper's, in its order (Sec. 4.2).
  bool far_depth = true;
  bool bounding_sphere = true;
  bool facing = true;
  bool plane_distance = true;
  bool horizon = true;
  // Not the paper's: the receiver is farther than the radius from the triangle itself. Masks of nearest cells would
  // otherwise hang on which shape bounds the triangle.
  bool reach = true;
};

// How the occluders of a frame are drawn. Changes no exact mask.
struct RasterOptions {
  // Alpha of the paper: triangles whose bounding sphere is smaller than this share of the radius get a billboard, the
  // others a prism. At least 0; 0: prisms only; infinity: billboards wherever the camera is outside of them.
  float billboard_threshold = 0.2f;
  Culls culls = {};
};

enum class GeometryBackEnd {
  automatic,        // the first of these that passes the self-test: vertex_pulling, geometry_shader
  geometry_shader,  // the paper's
  vertex_pulling,   // indexed draws without vertex attributes
};

enum class Accumulator {
  automatic,  // the first of these that passes the self-test: logic_op, ssbo
  logic_op,   // glLogicOp(GL_OR) on integer colour attachments, the paper's
  ssbo,       // atomicOr on shader storage
};

// In which the shaders decide about a ray.
enum class Precision {
  single_precision,  // differs from the CPU where a ray passes an edge, or ends at a plane, within some 1e-6
  double_precision,  // the CPU's arithmetic; slow on most GPUs
};

// Of a pass, for its life.
struct PassSetup {
  GeometryBackEnd geometry = GeometryBackEnd::automatic;
  Accumulator accumulator = Accumulator::automatic;
  Precision precision = Precision::single_precision;
  // Count fragments (FragmentCounts); costs time.
  bool count_fragments = false;
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

// Where resolve() writes: textures of the caller, GL_TEXTURE_2D, level 0, of the G-buffer's size; 0 where not wanted.
struct ResolveTargets {
  // GL_R8, GL_R16, GL_R16F or GL_R32F: share of the cast rays that are blocked, 0 to 1.
  ObjectName occlusion = 0;
  // GL_RGBA16F or GL_RGBA32F: mean direction of the rays that are not blocked, a unit vector in world space, the
  // pattern's axis where all are blocked; alpha 1. (0, 0, 0, 0) where there is no receiver.
  ObjectName bent_normals = 0;
  // The occlusion where there is no receiver.
  float background = 0;
};

// The rasterised method: occlusion masks of all pixels of a G-buffer.
//
// What a pixel's mask says is what the CPU's query says (AmbientOcclusion), for the same receiver: with a table of
// PlaneMasks::must_may to the rounding of the chosen precision, with PlaneMasks::nearest as nearly as the table's cells
// tell.
//
// Every member needs the context in which the object was made, current in the calling thread; the destructor too.
// draw() and the others leave the context's state as they find it; gpu/README.md lists what they touch. Errors of
// OpenGL and missing features throw std::runtime_error, wrong arguments std::invalid_argument, both with one line.
class OcclusionPass {
 public:
  explicit OcclusionPass(const PassSetup& setup = {});
  ~OcclusionPass();
  OcclusionPass(OcclusionPass&&) noexcept;
  OcclusionPass& operator=(OcclusionPass&&) noexcept;

  // Copies the mesh to the GPU; front faces are counter-clockwise. Triangles without area or with a coordinate that is
  // not finite or beyond 1e18 block nothing. `ranges`, where it is not empty, has [r_min, r_max] for each triangle: it
  // blocks a ray only where the distance from the receiver is in that range, as one of several levels of detail
  // (OccluderLevel). Throws std::invalid_argument where an index is outside `positions`, or a range is not
  // 0 <= r_min < r_max, std::runtime_error where there are more positions than GL_MAX_TEXTURE_BUFFER_SIZE. Takes 12
  // bytes a position and 52 bytes a triangle, 60 with ranges.
  void set_occluders(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                     std::span<const glm::vec2> ranges = {});
  // New positions for the same triangles, as many as before. Nothing is rebuilt: bounds are found anew by every draw().
  void update_positions(std::span<const glm::vec3> positions);
  // The buffer of positions, three floats each, for meshes that move on the GPU: write there between draws, with
  // glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT) after a shader. Valid until set_occluders().
  ObjectName positions_buffer() const;

  // Copies table and pattern to the GPU. The table's PlaneMasks decide: `nearest` gives the paper's approximate masks,
  // `must_may` exact ones.
  void set_table(const PlaneMaskTable& table);

  // Finds the masks. Needs a table; without occluders all masks are empty. The receiver of pixel (x, y) casts the rays
  // that the CPU's query casts for it with these options and the index y * width + x.
  //
  // With an infinite radius the pass finds on the GPU, in every frame, a power of two beyond the largest distance
  // between the bounds of occluders and pixels, and less than four times that. Every shape covers all receivers, so
  // such a frame is slow. Throws std::invalid_argument where an option is out of range, and for an infinite radius
  // where the table's rays are not all as long as the AO radius.
  void draw(const GBuffer& g_buffer, const Camera& camera, const RayOptions& options, const RasterOptions& raster = {});

  // The following are about the last draw(), and throw std::runtime_error where there was none.

  void resolve(const ResolveTargets& targets);
  // SamplePattern::word_count() words for every pixel, row by row from y = 0, as OcclusionMask has them. Waits for the
  // GPU.
  std::vector<std::uint64_t> read_masks();
  // For every pixel, row by row. Waits for the GPU.
  std::vector<PixelReceiver> read_receivers();
  // Zeros unless PassSetup::count_fragments. Waits for the GPU.
  FragmentCounts read_fragment_counts();
  // The masks themselves: a GL_TEXTURE_2D_ARRAY of GL_RGBA32UI, 128 rays a layer (ray i: layer i / 128, component
  // i / 32 % 4, bit i % 32). The pass's own; valid until the next draw().
  ObjectName masks_texture() const;

  // What is used, after the self-test.
  GeometryBackEnd geometry() const;
  Accumulator accumulator() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::gl
