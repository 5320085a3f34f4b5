// Materials with holes by transparency, in words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/contents.h"

namespace lkao::scene {

struct CutOut {
  enum class Kind {
    unread,  // whole, as far as is known
    mask,    // there or not, of which nothing is to be said
    blend    // half-transparent
  };

  std::string material;
  std::size_t triangle_count = 0;
  Kind kind = Kind::unread;
};

// Adds them to the count and the remarks: of each kind a line for each of the largest few, one for all others.
void add_cut_outs(std::vector<CutOut> cut_outs, Contents& contents);

}  // namespace lkao::scene
