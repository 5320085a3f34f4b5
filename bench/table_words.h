// The words of the kinds of tables that a study compares.
#pragma once

#include "lkao/kernel.h"
#include "lkao/plane_addressing.h"
#include "method/plane_mask_words.h"

namespace lkao::bench {

inline constexpr method::Word<PlaneAddressing> kAddressingWords[] = {{"cube", PlaneAddressing::cube},
                                                                     {"slices", PlaneAddressing::slices}};

inline constexpr method::Word<NodeMasks> kNodeMaskWords[] = {{"sphere", NodeMasks::bounding_sphere},
                                                             {"outline", NodeMasks::box_outline}};

}  // namespace lkao::bench
