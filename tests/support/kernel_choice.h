// Tests that every exact kernel must pass, on every instruction set that this processor has.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/isa.h"
#include "lkao/kernel.h"

namespace lkao::tests {

struct KernelChoice {
  Kernel kernel;
  std::string isa;
};

inline std::vector<KernelChoice> all_kernels() {
  std::vector<KernelChoice> kernels = {{Kernel::scalar, ""}};
  for (const std::string& isa : available_isas()) kernels.push_back({Kernel::simd, isa});
  return kernels;
}

// For the names of tests: the last argument of INSTANTIATE_TEST_SUITE_P.
inline std::string name_of_choice(const testing::TestParamInfo<KernelChoice>& choice) {
  return choice.param.kernel == Kernel::scalar ? "definition" : choice.param.isa;
}

// Forces the instruction set of its parameter.
class OnEveryKernel : public testing::TestWithParam<KernelChoice> {
 protected:
  void SetUp() override { force_isa(GetParam().isa); }
  void TearDown() override { force_isa(""); }
};

}  // namespace lkao::tests
