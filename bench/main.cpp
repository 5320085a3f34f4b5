// The program `lkao-bench`: comparisons of speed that always say what the answers are worth.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.h"

namespace lkao::bench {
namespace {

int run(int argc, char** argv) {
  CLI::App program("Speed of lkao, against Embree on the same rays.", "lkao-bench");
  program.require_subcommand(1);
  const std::vector<Command> commands = {add_rays_command(program), add_build_command(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help
    return program.exit(request);
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) command.run();
  }
  return 0;
}

}  // namespace
}  // namespace lkao::bench

int main(int argc, char** argv) {
  try {
    return lkao::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::string message = error.what();
    std::replace(message.begin(), message.end(), '\n', ' ');  // one line, whatever a library says
    fmt::print(stderr, "lkao-bench: {}\n", message);
    return 2;
  }
}
