// LibFuzzer begins with nothing; from time to time it gets an input made of a seed to start from.
#include <algorithm>

#include "fuzz/target.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  if (seed % 64 != 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::vector<std::uint8_t> bytes = lkao::tests::bytes_of_seed(seed);
  const std::size_t count = std::min(bytes.size(), max_size);
  std::copy_n(bytes.begin(), count, data);
  return count;
}
