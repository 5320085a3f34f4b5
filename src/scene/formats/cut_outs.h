// Materials with holes by transparency, which occlude as if they were whole.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/contents.h"

namespace lkao::scene {

struct CutOut {
  std::string material;
  std::size_t triangle_count = 0;
};

// Adds them to the count and the remarks: a line for each of the largest few, one for all others.
void add_cut_outs(std::vector<CutOut> cut_outs, Contents& contents);

}  // namespace lkao::scene
