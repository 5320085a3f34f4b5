// Where figures come from: what a committed CSV says about processor, compiler and commit. No host names, no paths.
#pragma once

#include <string>

namespace lkao::bench {

// As /proc/cpuinfo has it: the name, and the numbers that tell apart processors of one name. "unknown" elsewhere.
struct Processor {
  std::string name;
  std::string family;
  std::string model;
};
Processor processor();

// That this program was compiled with, and its version.
std::string compiler();

// Abbreviated, with "-dirty" behind it where the working tree was changed; as of the last build.
std::string commit();

// Lines that begin with '#', for the top of a CSV.
std::string provenance_comment();

}  // namespace lkao::bench
