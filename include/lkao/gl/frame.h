// What every pass is given: a camera, a G-buffer, and a texture for its occlusion.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/mat4x4.hpp>

#include "lkao/requirements.h"

namespace lkao::gl {

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

// Which space positions and normals are in: that of Camera::view, before or after it.
enum class PositionSpace { world, view };
enum class NormalSpace { world, view };

// What the components of a texture of normals are. Two are enough for unit vectors, and then every texel is one: only
// its depth or position tells a pixel without a receiver.
enum class NormalEncoding {
  xyz,
  // Onto the octahedron |x| + |y| + |z| = 1, whose lower half is folded over the upper: x and y of that. Z. Cigolle et
  // al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014.
  octahedral,
  // x and y in view space, where z > 0: towards the camera. What leans away from it, as normals of perspective
  // cameras, of bumps and at outlines may, has lost its z.
  xy,
};

// Where a picture lies in textures that may be larger than it: the place of its pixel (0, 0). For dynamic resolution,
// split screens and atlases.
struct Part {
  int x = 0, y = 0;
};

// The caller's textures, each GL_TEXTURE_2D of width x height; only read. Exactly one of the first three says where a
// pixel's receiver is. A pixel has no receiver where its depth is the far end of the depth range, its position is not
// finite, or its normal is zero or not finite.
//
// Any format of floats or normalised numbers will do: with an automatic surface offset (RayOptions::surface_offset)
// receivers start as far off their surfaces as the format, the projection and the rasteriser may have moved them.
// Standard depth of 24 bits is off by distance^2 / near x 2^-24; reversed floats, linear depth and positions of 32-bit
// floats by next to nothing; half floats by 1/1024 of the distance or coordinate. What is nearer than that to another
// surface may be dark.
struct GBuffer {
  int width = 0;
  int height = 0;
  ObjectName depth = 0;  // window-space depth of a depth range of 0 to 1: a depth texture, or its copy in a colour one
  ObjectName linear_depth = 0;  // red: distance along the camera's view direction
  ObjectName positions = 0;     // must lie at their pixels' centres as the camera sees them
  PositionSpace position_space = PositionSpace::world;
  // Shading normals of any length. Numbers of unsigned normalised formats are taken for n / 2 + 1/2.
  ObjectName normals = 0;
  // The side of the surface that a receiver lies on (Receiver::geometric_normal); 0: the same as `normals`.
  ObjectName geometric_normals = 0;
  NormalSpace normal_space = NormalSpace::world;
  NormalEncoding normal_encoding = NormalEncoding::xyz;
  // What VaoPass may ask for, and nobody else: the linear red, green and blue of the surfaces, or of what the eye sees
  // of them, 0 and more. Any format of floats or normalised numbers; shaders see sRGB decoded. 0: there are none.
  ObjectName colours = 0;
  // Given: all textures are larger than width x height, or as large, and this is the part that the camera sees.
  std::optional<Part> part = {};
  // 2 is half resolution, 4 a quarter: passes answer one pixel of each step x step, (step i, step j), and make pictures
  // of picture_width() x picture_height() pixels (i, j). BilateralFilter::upsample makes whole ones of them. 1 to 16.
  int step = 1;

  // Of what passes make.
  int picture_width() const { return (width - 1) / step + 1; }
  int picture_height() const { return (height - 1) / step + 1; }
};

// What a texture of occlusion holds: the blocked share, or 1 minus that.
enum class Quantity { occlusion, visibility };

enum class Channel { red, green, blue, alpha };

// Where occlusion is written: one channel of a texture of the caller, GL_TEXTURE_2D, level 0, of the picture's size.
// Others keep what they hold. Formats: those of 8 and 16 bits without a sign, of half and of 32-bit floats, with 1, 2
// or 4 components, GL_RGB10_A2 (but for its alpha) and GL_R11F_G11F_B10F. Shaders cannot write to other formats, sRGB
// and those of three components among them.
struct OcclusionTarget {
  ObjectName texture = 0;
  // What is written where there is no receiver, in place of the quantity.
  float background = 0;
  Quantity quantity = Quantity::occlusion;
  Channel channel = Channel::red;
  // Given: the texture is larger than the picture, or as large, and this is where the picture lies.
  std::optional<Part> part = {};
};

}  // namespace lkao::gl
