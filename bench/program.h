// What the main() of each of these programs does.
#pragma once

#include <cstdio>
#include <exception>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "image/one_line.h"

namespace lkao::bench {

// Parses the command line and returns what `work()` returns. A fault of either is one line on stderr, and 2.
template <typename Work>
int run_program(CLI::App& program, int argc, char** argv, const Work& work) {
  try {
    program.parse(argc, argv);
    return work();
  } catch (const CLI::Success& request) {  // --help
    return program.exit(request);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program.get_name(), image::one_line(error.what()));
    return 2;
  }
}

}  // namespace lkao::bench
