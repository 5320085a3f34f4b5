// The program `lkao-bench`: comparisons of speed that always say what the answers are worth.
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "program.h"

int main(int argc, char** argv) {
  using namespace lkao::bench;
  CLI::App program("Speed of lkao, against Embree on the same rays.", "lkao-bench");
  program.require_subcommand(1);
  std::vector<Command> commands = {add_rays_command(program), add_spread_command(program), add_build_command(program)};
#if LKAO_BENCH_GL
  commands.push_back(add_raster_command(program));
  commands.push_back(add_lod_command(program));
#endif
  return run_program(program, argc, argv, [&] {
    for (const Command& command : commands) {
      if (command.app->parsed()) command.run();
    }
    return 0;
  });
}
