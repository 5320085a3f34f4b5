// The program `lkao-bench`: measurements of speed that always say what the answers are worth.
#include <cstdio>
#include <exception>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "image/one_line.h"

namespace lkao::bench {
namespace {

std::vector<Command> add_commands(CLI::App& program) {
  return {
    add_rays_command(program), add_spread_command(program), add_shadows_command(program), add_foliage_command(program),
        add_build_command(program), add_instances_command(program), add_refit_command(program),
#if LKAO_BENCH_GL
        add_raster_command(program), add_volumes_command(program), add_splats_command(program),
        add_screen_command(program),
#endif
        add_report_command(program), add_lod_command(program), add_bake_command(program), add_texture_command(program),
        add_tables_command(program), add_patterns_command(program),
  };
}

int run(int argc, char** argv) {
  CLI::App program("Speed and error of lkao: against Embree on the same rays, of its methods and of their parts.",
                   "lkao-bench");
  program.require_subcommand(1);
  const std::vector<Command> commands = add_commands(program);
  try {
    program.parse(argc, argv);
    for (const Command& command : commands) {
      if (command.app->parsed()) return command.run();
    }
    return 0;
  } catch (const CLI::Success& request) {  // --help
    return program.exit(request);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program.get_name(), image::one_line(error.what()));
    return 2;
  }
}

}  // namespace
}  // namespace lkao::bench

int main(int argc, char** argv) { return lkao::bench::run(argc, argv); }
