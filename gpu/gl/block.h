// Uniform blocks that C++ and GLSL compile from one header:
//
//   LKAO_BLOCK_BEGIN(ViewBlock, LKAO_BLOCK_VIEW)  // type and binding
//   dmat4 world_from_clip;
//   int width;
//   LKAO_BLOCK_END(view)                          // its name in GLSL
//
// std140 and C++ lay out the same way what follows three rules: dmat4 first, then mat4 and vec4, then scalars of four
// bytes; no arrays of scalars, no vectors of two or three.
#ifndef LKAO_GPU_GL_BLOCK_H
#define LKAO_GPU_GL_BLOCK_H

// Bindings: what is seen, the shapes around triangles, what one pass alone knows, and where occlusion goes.
#define LKAO_BLOCK_VIEW 0
#define LKAO_BLOCK_SHAPES 1
#define LKAO_BLOCK_PASS 2
#define LKAO_BLOCK_TARGET 3
#define LKAO_BLOCK_COUNT 4

#ifdef __cplusplus

#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

// NOLINTBEGIN(bugprone-macro-parentheses): names cannot have any
#define LKAO_BLOCK_BEGIN(TYPE, BINDING)           \
  namespace lkao::gl {                            \
  struct alignas(16) TYPE {                       \
    static constexpr unsigned kBinding = BINDING; \
    using uint = std::uint32_t;                   \
    using vec4 = glm::vec4;                       \
    using mat4 = glm::mat4;                       \
    using dmat4 = glm::dmat4;
#define LKAO_BLOCK_END(NAME) \
  }                          \
  ;                          \
  }
// NOLINTEND(bugprone-macro-parentheses)

#else

#define LKAO_BLOCK_BEGIN(TYPE, BINDING) layout(std140, binding = BINDING) uniform TYPE {
#define LKAO_BLOCK_END(NAME) \
  }                          \
  NAME;

#endif

#endif
