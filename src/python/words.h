// Words of Python that stand for values of an enum.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "lkao/kernel.h"
#include "lkao/plane_mask_table.h"
#include "lkao/receiver.h"
#include "lkao/weighting.h"
#include "scene/contents.h"

namespace lkao::python {

template <typename Value>
struct Word {
  const char* word;
  Value value;
};

inline constexpr Word<Sidedness> kSidednesses[] = {{"two", Sidedness::two_sided}, {"one", Sidedness::one_sided}};
inline constexpr Word<Kernel> kKernels[] = {{"simd", Kernel::simd}, {"scalar", Kernel::scalar}};
inline constexpr Word<NodeMasks> kNodeMasks[] = {{"box_outline", NodeMasks::box_outline},
                                                 {"bounding_sphere", NodeMasks::bounding_sphere}};
inline constexpr Word<Weighting> kWeightings[] = {{"cosine", Weighting::cosine}, {"uniform", Weighting::uniform}};
inline constexpr Word<PlaneMasks> kPlaneMasks[] = {{"must_may", PlaneMasks::must_may},
                                                   {"nearest", PlaneMasks::nearest}};
inline constexpr Word<PlaneAddressing> kAddressings[] = {{"slices", PlaneAddressing::slices},
                                                         {"cube", PlaneAddressing::cube}};
inline constexpr Word<scene::TextureWrap> kWraps[] = {{"repeat", scene::TextureWrap::repeat},
                                                      {"mirror", scene::TextureWrap::mirror},
                                                      {"clamp", scene::TextureWrap::clamp}};

// Throws std::invalid_argument naming the argument, the word and the known ones.
template <typename Value, std::size_t Count>
Value value_of(const Word<Value> (&words)[Count], const std::string& word, const char* argument) {
  std::string known;
  for (const Word<Value>& candidate : words) {
    if (word == candidate.word) return candidate.value;
    known += (known.empty() ? "'" : ", '") + std::string(candidate.word) + "'";
  }
  throw std::invalid_argument(std::string(argument) + " must be one of " + known + ", not '" + word + "'");
}

// Of a value that has one.
template <typename Value, std::size_t Count>
const char* word_of(const Word<Value> (&words)[Count], Value value) {
  for (const Word<Value>& candidate : words) {
    if (candidate.value == value) return candidate.word;
  }
  return "";
}

}  // namespace lkao::python
