// What every public header asks of the program that includes it, so that a host which is compiled otherwise is stopped,
// instead of linked to a library that lays out its structures in another way.
#pragma once

#if defined(_MSVC_LANG)
#define LKAO_LANGUAGE _MSVC_LANG
#else
#define LKAO_LANGUAGE __cplusplus
#endif
#if LKAO_LANGUAGE < 202002L
#error "lkao needs C++20: compile with -std=c++20 (CMake: target_compile_features(app PRIVATE cxx_std_20))"
// There is no such file: compilers stop here instead of listing all that C++17 lacks.
#include "lkao/stop_after_the_error_above"
#endif
#undef LKAO_LANGUAGE

#include <type_traits>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace lkao {

// GLM's macros for aligned types make a vec3 of 16 bytes.
static_assert(std::is_same_v<glm::vec3, glm::vec<3, float, glm::packed_highp>> && sizeof(glm::vec2) == 8 &&
                  sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12 && sizeof(glm::dvec3) == 24 &&
                  sizeof(glm::mat3) == 36 && sizeof(glm::mat4) == 64 && alignof(glm::vec3) == 4 &&
                  alignof(glm::dvec3) == 8 && alignof(glm::mat4) == 4,
              "lkao is compiled with GLM's packed types; with aligned ones its structures have another layout: include "
              "it without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES");

}  // namespace lkao
