// What a fuzz target gives to the program that drives it: libFuzzer, or seeds_main.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// Tries one input; aborts, with the fault on stderr, where it finds one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace lkao::tests {

// An input made of a seed, the same on every machine.
std::vector<std::uint8_t> bytes_of_seed(std::uint64_t seed);

}  // namespace lkao::tests
