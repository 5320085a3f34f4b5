// The subcommands of lkao-bench.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace lkao::bench {

struct Command {
  CLI::App* app;
  std::function<void()> run;  // once the command line is parsed; throws with one line
};

// Ray casting against Embree.
Command add_rays_command(CLI::App& program);
// Several runs of it together.
Command add_spread_command(CLI::App& program);
// Builds against Embree.
Command add_build_command(CLI::App& program);
// The rasterised method against the query; where it is built.
Command add_raster_command(CLI::App& program);
// Levels of detail, by both; where OpenGL is built.
Command add_lod_command(CLI::App& program);

}  // namespace lkao::bench
