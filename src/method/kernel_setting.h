// The setting --kernel: what answers the library's traversal.
#pragma once

#include "method/method.h"

namespace lkao::method {

enum class KernelChoice { simd, scalar, table, nearest };
inline constexpr Word<KernelChoice> kKernelWords[] = {{"simd", KernelChoice::simd},
                                                      {"scalar", KernelChoice::scalar},
                                                      {"table", KernelChoice::table},
                                                      {"nearest", KernelChoice::nearest}};

const Setting& kernel_setting();
KernelChoice kernel_of(const Settings& settings);
// Kernel and instruction set.
Remarks kernel_remarks(KernelChoice kernel);

}  // namespace lkao::method
