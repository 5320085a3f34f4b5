// How many rays a mask has.
#pragma once

#include <bit>

#include "lkao/receiver_rays.h"

namespace lkao::query {

// Of a mask of these rays. OcclusionMask::count() looks at all of its words in vectors, which takes longer than a few
// words one by one.
inline int ray_count_of(const OcclusionMask& mask, const ReceiverRays& rays) {
  constexpr int kFewWords = 4;
  if (rays.word_count() > kFewWords) return mask.count();
  int count = 0;
  for (int i = 0; i < rays.word_count(); ++i) count += std::popcount(mask.words[i]);
  return count;
}

}  // namespace lkao::query
