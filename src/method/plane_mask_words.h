// The words of what a plane mask table keeps.
#pragma once

#include "lkao/plane_mask_table.h"
#include "method/words.h"

namespace lkao::method {

inline constexpr Word<PlaneMasks> kPlaneMaskWords[] = {{"exact", PlaneMasks::must_may},
                                                       {"nearest", PlaneMasks::nearest}};

}  // namespace lkao::method
