// Numbers of the C interface's enumerations, and what they stand for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "c_api/errors.h"
#include "lkao/c.h"
#include "lkao/lkao.h"

namespace lkao::c_api {

// Each by its number.
inline constexpr std::array kPatternKinds{PatternKind::lloyd, PatternKind::paper, PatternKind::fibonacci,
                                          PatternKind::sobol, PatternKind::random};
inline constexpr std::array kWeightings{Weighting::cosine, Weighting::uniform};
inline constexpr std::array kAddressings{PlaneAddressing::cube, PlaneAddressing::slices};
inline constexpr std::array kPlaneMasks{PlaneMasks::nearest, PlaneMasks::must_may};
inline constexpr std::array kSidednesses{Sidedness::two_sided, Sidedness::one_sided};
inline constexpr std::array kMeshStorages{MeshStorage::copy, MeshStorage::refer};
inline constexpr std::array kCutOutParts{CutOutPart::mixed, CutOutPart::clear, CutOutPart::opaque};
inline constexpr std::array kKernels{Kernel::simd, Kernel::scalar};
inline constexpr std::array kNodeMasks{NodeMasks::bounding_sphere, NodeMasks::box_outline};

// Throws the error of a number that must be in [first, last].
inline void check_range(std::int32_t number, std::int32_t first, std::int32_t last, const char* name) {
  if (number >= first && number <= last) return;
  refuse(std::string(name) + " must be " + std::to_string(first) + " to " + std::to_string(last) + ", not " +
         std::to_string(number));
}

template <typename Word, std::size_t Count>
Word word(const std::array<Word, Count>& words, std::int32_t number, const char* name) {
  check_range(number, 0, static_cast<std::int32_t>(Count) - 1, name);
  return words[static_cast<std::size_t>(number)];
}

template <typename Word, std::size_t Count>
std::int32_t number_of(const std::array<Word, Count>& words, Word wanted) {
  std::int32_t number = 0;
  while (words[static_cast<std::size_t>(number)] != wanted) ++number;
  return number;
}

}  // namespace lkao::c_api
