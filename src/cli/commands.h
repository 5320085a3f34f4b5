// The subcommands of the program.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace lkao::cli {

enum ExitCode {
  kSuccess = 0,
  kOverLimit = 1,  // compare: the images differ by more than was allowed
  kFailure = 2,    // bad input; one line on stderr says what and where
};

// A subcommand: where its options are, and what to do once they are parsed. `run` returns an exit code, and throws
// std::exception with one line for whatever is wrong.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

Command add_render_command(CLI::App& program);
Command add_bake_command(CLI::App& program);
Command add_compare_command(CLI::App& program);
Command add_info_command(CLI::App& program);
Command add_simplify_command(CLI::App& program);
Command add_merge_command(CLI::App& program);

}  // namespace lkao::cli
