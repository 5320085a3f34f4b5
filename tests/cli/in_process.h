// The command line of `lkao` without its process.
#pragma once

#include <filesystem>

#include "cli/program.h"

namespace lkao::test {

// Answers the arguments in this process. What is printed meanwhile goes into the files `out` and `err`. Returns what
// would be the exit code.
int run_in_process(const Arguments& arguments, const std::filesystem::path& out, const std::filesystem::path& err);

}  // namespace lkao::test
