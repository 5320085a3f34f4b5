#include "gpu/frame/format_names.h"

#include <fmt/format.h>

namespace lkao::gl {
namespace {

struct NamedFormat {
  GLenum format;
  const char* name;
};

#define LKAO_NAMED(NAME) \
  { GL_##NAME, "GL_" #NAME }
constexpr NamedFormat kFormats[] = {LKAO_NAMED(R8),
                                    LKAO_NAMED(R8_SNORM),
                                    LKAO_NAMED(R16),
                                    LKAO_NAMED(R16_SNORM),
                                    LKAO_NAMED(RG8),
                                    LKAO_NAMED(RG8_SNORM),
                                    LKAO_NAMED(RG16),
                                    LKAO_NAMED(RG16_SNORM),
                                    LKAO_NAMED(R3_G3_B2),
                                    LKAO_NAMED(RGB4),
                                    LKAO_NAMED(RGB5),
                                    LKAO_NAMED(RGB565),
                                    LKAO_NAMED(RGB8),
                                    LKAO_NAMED(RGB8_SNORM),
                                    LKAO_NAMED(RGB10),
                                    LKAO_NAMED(RGB12),
                                    LKAO_NAMED(RGB16),
                                    LKAO_NAMED(RGB16_SNORM),
                                    LKAO_NAMED(RGBA2),
                                    LKAO_NAMED(RGBA4),
                                    LKAO_NAMED(RGB5_A1),
                                    LKAO_NAMED(RGBA8),
                                    LKAO_NAMED(RGBA8_SNORM),
                                    LKAO_NAMED(RGB10_A2),
                                    LKAO_NAMED(RGB10_A2UI),
                                    LKAO_NAMED(RGBA12),
                                    LKAO_NAMED(RGBA16),
                                    LKAO_NAMED(RGBA16_SNORM),
                                    LKAO_NAMED(SRGB8),
                                    LKAO_NAMED(SRGB8_ALPHA8),
                                    LKAO_NAMED(R16F),
                                    LKAO_NAMED(RG16F),
                                    LKAO_NAMED(RGB16F),
                                    LKAO_NAMED(RGBA16F),
                                    LKAO_NAMED(R32F),
                                    LKAO_NAMED(RG32F),
                                    LKAO_NAMED(RGB32F),
                                    LKAO_NAMED(RGBA32F),
                                    LKAO_NAMED(R11F_G11F_B10F),
                                    LKAO_NAMED(RGB9_E5),
                                    LKAO_NAMED(R8I),
                                    LKAO_NAMED(R8UI),
                                    LKAO_NAMED(R16I),
                                    LKAO_NAMED(R16UI),
                                    LKAO_NAMED(R32I),
                                    LKAO_NAMED(R32UI),
                                    LKAO_NAMED(RG8I),
                                    LKAO_NAMED(RG8UI),
                                    LKAO_NAMED(RG16I),
                                    LKAO_NAMED(RG16UI),
                                    LKAO_NAMED(RG32I),
                                    LKAO_NAMED(RG32UI),
                                    LKAO_NAMED(RGB8I),
                                    LKAO_NAMED(RGB8UI),
                                    LKAO_NAMED(RGB16I),
                                    LKAO_NAMED(RGB16UI),
                                    LKAO_NAMED(RGB32I),
                                    LKAO_NAMED(RGB32UI),
                                    LKAO_NAMED(RGBA8I),
                                    LKAO_NAMED(RGBA8UI),
                                    LKAO_NAMED(RGBA16I),
                                    LKAO_NAMED(RGBA16UI),
                                    LKAO_NAMED(RGBA32I),
                                    LKAO_NAMED(RGBA32UI),
                                    LKAO_NAMED(DEPTH_COMPONENT16),
                                    LKAO_NAMED(DEPTH_COMPONENT24),
                                    LKAO_NAMED(DEPTH_COMPONENT32),
                                    LKAO_NAMED(DEPTH_COMPONENT32F),
                                    LKAO_NAMED(DEPTH24_STENCIL8),
                                    LKAO_NAMED(DEPTH32F_STENCIL8),
                                    LKAO_NAMED(STENCIL_INDEX8),
                                    LKAO_NAMED(RED),
                                    LKAO_NAMED(RG),
                                    LKAO_NAMED(RGB),
                                    LKAO_NAMED(RGBA),
                                    LKAO_NAMED(SRGB),
                                    LKAO_NAMED(SRGB_ALPHA),
                                    LKAO_NAMED(DEPTH_COMPONENT),
                                    LKAO_NAMED(DEPTH_STENCIL)};
#undef LKAO_NAMED

}  // namespace

std::string format_name(GLenum format) {
  for (const NamedFormat& known : kFormats) {
    if (known.format == format) return known.name;
  }
  return fmt::format("{:#x}", format);
}

}  // namespace lkao::gl
