// A deferred renderer, and what it takes to give it lkao: the lines marked "lkao". The G-buffer is that of a well-known
// tutorial or of any other kind (kinds.cpp); all of them are right at lkao's defaults.
//
//   deferred builtin:atrium --output out/deferred
//
// Each kind is compared with the query of the CPU at the points that the pixels' centres see, which no texture has
// rounded: `--csv FILE` writes that as bench/results/g_buffers.csv has it.
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <lkao/gl.h>    // lkao
#include <lkao/lkao.h>  // for the comparison

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bench/provenance.h"
#include "examples/gl_objects.h"
#include "image/image.h"
#include "kinds.h"
#include "renderer.h"
#include "scene/builtin.h"
#include "scene/camera.h"

namespace {

using deferred::Kind;
using deferred::Renderer;

struct Options {
  std::string scene = "builtin:atrium", output, csv;
  int ray_count = 128, width = 320, height = 240;
  float radius = 0.5f;
};

// What the pixels' centres see, row by row from the bottom, as the pass numbers them.
std::vector<lkao::Receiver> exact_receivers(const lkao::scene::Mesh& mesh, const lkao::scene::Camera& camera, int width,
                                            int height) {
  return examples::upside_down(lkao::scene::find_receivers(mesh, camera, width, height).receivers,
                               static_cast<std::size_t>(width));
}

struct Comparison {
  int pixel_count = 0, off_count = 0;  // off: by more than 25 of 255 steps
  double error_sum = 0;

  Comparison(const std::vector<float>& expected, const std::vector<float>& found) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (std::isnan(expected[i]) || std::isnan(found[i])) continue;
      const double error = std::abs(static_cast<double>(found[i]) - static_cast<double>(expected[i]));
      ++pixel_count;
      off_count += error > 25.0 / 255;
      error_sum += error;
    }
  }
  double off_share() const { return static_cast<double>(off_count) / pixel_count; }
  double mean_error() const { return error_sum / pixel_count; }
};

void write_picture(const Options& options, const std::string& name, const std::vector<float>& occlusion) {
  if (options.output.empty()) return;
  const lkao::image::Image image{options.width,
                                 options.height,
                                 {"occlusion"},
                                 examples::upside_down(occlusion, static_cast<std::size_t>(options.width))};
  lkao::image::write_image((std::filesystem::path(options.output) / (name + ".png")).string(),
                           lkao::image::visibility_preview(image));
}

class Report {
 public:
  explicit Report(const std::string& csv_path, const std::string& device) {
    if (csv_path.empty()) return;
    csv_.open(csv_path);
    if (!csv_) throw std::runtime_error(fmt::format("cannot write '{}'", csv_path));
    csv_ << lkao::bench::provenance_comment() << "# device: " << device << "\n"
         << "g_buffer,surface_offset,pixels,off_by_25_share,mean_error\n";
  }
  void add(const Kind& kind, const char* offset, const Comparison& comparison) {
    fmt::print("{:32} {:10} {:8} {:9.4f} % {:9.2f}/255\n", kind.name, offset, comparison.pixel_count,
               100 * comparison.off_share(), 255 * comparison.mean_error());
    if (!csv_.is_open()) return;
    csv_ << fmt::format("{},{},{},{:.6f},{:.6f}\n", kind.name, offset, comparison.pixel_count, comparison.off_share(),
                        comparison.mean_error());
  }

 private:
  std::ofstream csv_;
};

void run(const Options& options) {
  if (!options.scene.starts_with("builtin:")) throw std::invalid_argument("the scene must be builtin:NAME");
  const std::string name = options.scene.substr(8);
  const lkao::scene::Mesh mesh = lkao::scene::make_builtin(name);
  const lkao::scene::Camera camera = lkao::scene::builtin_scene(name).camera;
  lkao::gl::HeadlessContext context;
  context.make_current();
  if (!options.output.empty()) std::filesystem::create_directories(options.output);
  Renderer renderer(mesh, camera, options.width, options.height);

  lkao::gl::MaskPass pass;                                                                 // lkao, once
  pass.set_table(lkao::PlaneMaskTable(lkao::SamplePattern::standard(options.ray_count)));  // lkao
  lkao::gl::BilateralFilter filter;                                                        // lkao, for half resolution
  const lkao::gl::Occluders occluders(mesh.positions, mesh.triangles);                     // lkao, for each mesh
  const lkao::RayOptions at_defaults{.radius = options.radius};                            // lkao
  const auto draw = [&](const Kind& kind, const lkao::RayOptions& rays) {
    renderer.draw_g_buffer(kind);
    const lkao::gl::OcclusionTarget whole{renderer.occlusion(), NAN}, half{renderer.half_occlusion()};
    pass.draw(occluders, renderer.g_buffer(), renderer.camera(), rays);                                      // lkao
    pass.resolve({.occlusion = kind.step == 1 ? whole : half});                                              // lkao
    if (kind.step > 1) filter.upsample(renderer.g_buffer(), renderer.camera(), half, whole, {.radius = 2});  // lkao
    return renderer.read_occlusion();
  };

  const auto receivers = exact_receivers(mesh, camera, options.width, options.height);
  std::vector<float> expected(receivers.size());
  lkao::AmbientOcclusion(lkao::OccluderBvh(mesh.view()), lkao::SamplePattern::standard(options.ray_count), at_defaults)
      .query(receivers, {.occlusion = expected});
  write_picture(options, "query", expected);

  fmt::print("{}\n{:32} {:10} {:>8} {:>11} {:>13}\n", context.renderer(), "G-buffer", "offset", "pixels", "off by > 25",
             "mean error");
  Report report(options.csv, context.renderer());
  lkao::RayOptions of_query = at_defaults;
  of_query.surface_offset = lkao::kQuerySurfaceOffset;
  for (const Kind& kind : deferred::all_kinds()) {
    const std::vector<float> occlusion = draw(kind, at_defaults);
    report.add(kind, "automatic", Comparison(expected, occlusion));
    for (const std::string& warning : pass.warnings()) fmt::print("  {}\n", warning);
    write_picture(options, kind.name, occlusion);
    report.add(kind, "query's", Comparison(expected, draw(kind, of_query)));
  }

  // The trap: the tutorial's positions taken for positions in the world.
  renderer.draw_g_buffer(deferred::all_kinds().front());
  lkao::gl::GBuffer wrong = renderer.g_buffer();
  wrong.position_space = lkao::gl::PositionSpace::world;
  const lkao::gl::Status status = pass.try_draw(occluders, wrong, renderer.camera(), at_defaults);
  fmt::print("view-space positions as positions in the world: {}\n", status ? "not noticed" : status.message);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Ambient occlusion of every kind of G-buffer, against the query.", "deferred");
  app.add_option("scene", options.scene, "builtin:NAME")->capture_default_str();
  app.add_option("--radius", options.radius, "AO radius")->capture_default_str();
  app.add_option("--rays", options.ray_count, "a pixel, 1 to 1024")->capture_default_str();
  app.add_option("--width", options.width)->check(CLI::Range(1, 8192))->capture_default_str();
  app.add_option("--height", options.height)->check(CLI::Range(1, 8192))->capture_default_str();
  app.add_option("--output", options.output, "folder for pictures of the visibility as PNG files");
  app.add_option("--csv", options.csv, "the table as a file");
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "deferred: {}\n", error.what());
    return 2;
  }
}
