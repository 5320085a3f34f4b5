#include "kinds.h"

#include <epoxy/gl.h>

namespace deferred {
namespace {

using lkao::gl::NormalEncoding;
using lkao::gl::NormalSpace;
using lkao::gl::PositionSpace;

constexpr Kind kKinds[] = {
    {.name = "view-space positions RGBA16F",
     .place = Place::positions,
     .place_format = GL_RGBA16F,
     .position_space = PositionSpace::view},
    {.name = "depth of 24 bits", .place = Place::depth, .place_format = GL_DEPTH_COMPONENT24},
    {.name = "depth of 24 bits and stencil", .place = Place::depth, .place_format = GL_DEPTH24_STENCIL8},
    {.name = "depth of 16 bits", .place = Place::depth, .place_format = GL_DEPTH_COMPONENT16},
    {.name = "depth of 32-bit floats", .place = Place::depth, .place_format = GL_DEPTH_COMPONENT32F},
    {.name = "reversed depth of 32-bit floats",
     .place = Place::depth,
     .place_format = GL_DEPTH_COMPONENT32F,
     .is_reversed = true},
    {.name = "linear depth R32F", .place = Place::linear_depth, .place_format = GL_R32F},
    {.name = "linear depth R16F", .place = Place::linear_depth, .place_format = GL_R16F},
    {.name = "world positions RGBA32F", .place = Place::positions, .place_format = GL_RGBA32F},
    {.name = "world positions RGBA16F", .place = Place::positions, .place_format = GL_RGBA16F},
    {.name = "view-space positions RGBA32F",
     .place = Place::positions,
     .place_format = GL_RGBA32F,
     .position_space = PositionSpace::view},
    {.name = "normals in world space",
     .place = Place::depth,
     .place_format = GL_DEPTH_COMPONENT24,
     .normal_space = NormalSpace::world},
    {.name = "normals RGB10_A2",
     .place = Place::depth,
     .place_format = GL_DEPTH_COMPONENT24,
     .normal_format = GL_RGB10_A2},
    {.name = "octahedral normals RG8_SNORM",
     .place = Place::depth,
     .place_format = GL_DEPTH_COMPONENT24,
     .normal_format = GL_RG8_SNORM,
     .normal_encoding = NormalEncoding::octahedral},
    {.name = "octahedral normals RG16",
     .place = Place::depth,
     .place_format = GL_DEPTH_COMPONENT24,
     .normal_format = GL_RG16,
     .normal_encoding = NormalEncoding::octahedral},
    {.name = "part of larger textures", .place = Place::depth, .place_format = GL_DEPTH_COMPONENT24, .is_part = true},
    {.name = "half resolution", .place = Place::depth, .place_format = GL_DEPTH_COMPONENT24, .step = 2},
};

}  // namespace

std::span<const Kind> all_kinds() { return kKinds; }

}  // namespace deferred
