// AO radii that suit a scene.
#pragma once

#include "lkao/occluder_bvh.h"

namespace lkao::scene {

struct SuggestedRadii {
  float small = 0;
  float large = 0;
};

// 1.4 % and 4.2 % of the diagonal of the bounds, to two digits: the shares of Laine & Karras 2010, Table 1, on Sibenik.
SuggestedRadii suggest_radii(const Bounds& bounds);

}  // namespace lkao::scene
