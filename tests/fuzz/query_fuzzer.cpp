// The fuzz target: any bytes are a query, and every way to answer it must give the same bits.
//
// LibFuzzer calls it where the compiler has that; seeds_main.cpp is its driver elsewhere (CONTRIBUTING.md).
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include <tbb/global_control.h>

#include "fuzz/query_case.h"
#include "fuzz/query_check.h"
#include "fuzz/target.h"
#include "lut/random.h"

namespace lkao::tests {

std::vector<std::uint8_t> bytes_of_seed(std::uint64_t seed) {
  lut::RandomStream random(seed);
  std::vector<std::uint8_t> bytes(random.next_below(random.next_below(2) == 0 ? 200 : 1500));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next_bits());
  return bytes;
}

}  // namespace lkao::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // One thread, so that the same bytes do the same again.
  static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const std::string difference =
      lkao::tests::find_difference(lkao::tests::decode_query_case(std::span<const std::uint8_t>(data, size)));
  if (!difference.empty()) {
    std::fputs(difference.c_str(), stderr);
    std::abort();
  }
  return 0;
}
