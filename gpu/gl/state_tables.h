// The parts of OpenGL's state that are lists: what StateKeeper switches off, sets and puts back. Tests walk them too.
#pragma once

#include <epoxy/gl.h>

namespace lkao::gl {

// All are off while a pass begins.
inline constexpr GLenum kKeptCapabilities[] = {GL_DEPTH_TEST,
                                               GL_STENCIL_TEST,
                                               GL_CULL_FACE,
                                               GL_DEPTH_CLAMP,
                                               GL_COLOR_LOGIC_OP,
                                               GL_POLYGON_OFFSET_FILL,
                                               GL_POLYGON_SMOOTH,
                                               GL_RASTERIZER_DISCARD,
                                               GL_SAMPLE_MASK,
                                               GL_SAMPLE_COVERAGE,
                                               GL_SAMPLE_ALPHA_TO_COVERAGE,
                                               GL_PRIMITIVE_RESTART,
                                               GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                               GL_CLIP_DISTANCE0,
                                               GL_CLIP_DISTANCE1,
                                               GL_CLIP_DISTANCE2,
                                               GL_CLIP_DISTANCE3,
                                               GL_CLIP_DISTANCE4,
                                               GL_CLIP_DISTANCE5,
                                               GL_CLIP_DISTANCE6,
                                               GL_CLIP_DISTANCE7};

// How pixels lie in memory, and what means tightly packed.
struct PixelStore {
  GLenum name;
  GLint tight;
};
inline constexpr PixelStore kKeptPixelStore[] = {
    {GL_PACK_SWAP_BYTES, 0},    {GL_PACK_ROW_LENGTH, 0},     {GL_PACK_IMAGE_HEIGHT, 0},  {GL_PACK_SKIP_PIXELS, 0},
    {GL_PACK_SKIP_ROWS, 0},     {GL_PACK_SKIP_IMAGES, 0},    {GL_PACK_ALIGNMENT, 4},     {GL_UNPACK_SWAP_BYTES, 0},
    {GL_UNPACK_ROW_LENGTH, 0},  {GL_UNPACK_IMAGE_HEIGHT, 0}, {GL_UNPACK_SKIP_PIXELS, 0}, {GL_UNPACK_SKIP_ROWS, 0},
    {GL_UNPACK_SKIP_IMAGES, 0}, {GL_UNPACK_ALIGNMENT, 4}};

// Colour attachments whose masks and blending are kept: as many as OpenGL 4.5 promises.
inline constexpr GLuint kKeptColorCount = 8;

// How the colours of one attachment are blended, in the order that glBlendFuncSeparatei and glBlendEquationSeparatei
// take them.
inline constexpr GLenum kKeptBlending[] = {GL_BLEND_SRC_RGB,   GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,
                                           GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};

}  // namespace lkao::gl
