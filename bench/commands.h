// The subcommands of lkao-bench.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace lkao::bench {

struct Command {
  CLI::App* app;
  std::function<int()> run;  // once the command line is parsed; returns an exit code, throws with one line
};

// Ray casting against Embree.
Command add_rays_command(CLI::App& program);
// Several runs of it together.
Command add_spread_command(CLI::App& program);
// Soft shadows against Embree.
Command add_shadows_command(CLI::App& program);
// Cards with leaves on them against Embree.
Command add_foliage_command(CLI::App& program);
// Builds against Embree.
Command add_build_command(CLI::App& program);
// Scenes of instances against Embree's.
Command add_instances_command(CLI::App& program);
// Refits of deformed meshes against builds.
Command add_refit_command(CLI::App& program);
// The rasterised method against the query; where OpenGL is built.
Command add_raster_command(CLI::App& program);
// Ambient occlusion volumes against rays; where OpenGL is built.
Command add_volumes_command(CLI::App& program);
// Spheres of pixels and of the scene against rays; where OpenGL is built.
Command add_splats_command(CLI::App& program);
// Methods in screen space against rays and against themselves; where OpenGL is built.
Command add_screen_command(CLI::App& program);
// Speed against error, over all methods.
Command add_report_command(CLI::App& program);
// Levels of detail, by every method that takes them.
Command add_lod_command(CLI::App& program);
// Baked values of vertices against occlusion all over the faces.
Command add_bake_command(CLI::App& program);
// Maps of occlusion against Embree.
Command add_texture_command(CLI::App& program);
// Plane mask tables by size and kind.
Command add_tables_command(CLI::App& program);
// Sample patterns against the integral.
Command add_patterns_command(CLI::App& program);

}  // namespace lkao::bench
