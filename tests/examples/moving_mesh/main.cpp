// A small real-time renderer, and what it takes to give it lkao: the lines marked "lkao".
//
//   moving_mesh --frames 90 --size 640x360 --output out/moving_mesh
//
// A ball bounces and a cloth waves. Every frame draws a G-buffer, gets the occlusion of each pixel from lkao's pass,
// and shades with it. The context has no window; an engine has its own, and needs none of HeadlessContext.
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <lkao/gl.h>  // lkao

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "comparison.h"
#include "image/image.h"
#include "method/gl_words.h"
#include "method/median.h"
#include "method/plane_mask_words.h"
#include "method/stopwatch.h"
#include "moving_scene.h"
#include "renderer.h"

namespace {

using lkao::method::median;
using moving_mesh::Difference;
using moving_mesh::MovingScene;
using moving_mesh::Renderer;

constexpr double kSecondsAFrame = 1.0 / 30;

struct Options {
  std::string size = "640x360", output, device = "auto", masks = "nearest";
  int frame_count = 30, ray_count = 128;
  float radius = 0.5f;
};

struct Size {
  int width = 0, height = 0;
};

Size parse_size(const std::string& text) {
  Size size;
  int length = 0;
  const bool is_read = std::sscanf(text.c_str(), "%5dx%5d%n", &size.width, &size.height, &length) == 2;
  if (!is_read || static_cast<std::size_t>(length) != text.size() || std::min(size.width, size.height) < 1 ||
      std::max(size.width, size.height) > 8192) {
    throw std::invalid_argument(fmt::format("--size must be WIDTHxHEIGHT, each from 1 to 8192, not '{}'", text));
  }
  return size;
}

// The paper's approximate masks, fast enough for every frame, or exact ones.
lkao::PlaneMaskTableOptions table_options(const Options& options) {
  lkao::PlaneMaskTableOptions table;
  table.masks = parse_word(lkao::method::kPlaneMaskWords, options.masks);
  return table;
}

std::string picture_path(const std::string& folder, int frame) {
  return (std::filesystem::path(folder) / fmt::format("frame-{:04}.png", frame)).string();
}

void write_picture(const std::string& path, const Renderer& renderer) {
  lkao::image::Image image{renderer.width(), renderer.height(), {"R", "G", "B"}, {}};
  for (const std::uint8_t value : renderer.read_picture()) image.pixels.push_back(static_cast<float>(value) / 255);
  lkao::image::write_image(path, image);
}

// Milliseconds of each frame.
struct Times {
  std::vector<double> occlusion, all;

  void print() const {
    fmt::print("occlusion: {:.2f} ms a frame (draw and resolve, median of {})\n", median(occlusion), occlusion.size());
    fmt::print("all: {:.2f} ms a frame (without writing pictures)\n", median(all));
  }
};

// Waits for the GPU, so that a time says what was done within it.
double finished_milliseconds(const lkao::method::Stopwatch& watch) {
  glFinish();
  return 1000 * watch.seconds();
}

void run(const Options& options) {
  const auto [width, height] = parse_size(options.size);
  lkao::gl::HeadlessContext context(parse_word(lkao::method::kDeviceWords, options.device));
  context.make_current();
  if (!options.output.empty()) std::filesystem::create_directories(options.output);
  MovingScene scene;
  const lkao::scene::Mesh& mesh = scene.mesh();
  Renderer renderer(width, height, mesh.triangles, scene.colors());
  fmt::print("{}\n{} triangles, {}x{} pixels, {} rays, radius {}\n", context.renderer(), mesh.triangles.size(), width,
             height, options.ray_count, options.radius);

  const lkao::SamplePattern& pattern = lkao::SamplePattern::standard(options.ray_count);  // lkao
  lkao::gl::MaskPass pass;                                                                // lkao, once
  pass.set_table(lkao::PlaneMaskTable(pattern, table_options(options)));                  // lkao
  lkao::gl::Occluders occluders(mesh.positions, mesh.triangles);                          // lkao, for each mesh
  lkao::RayOptions ray_options;
  ray_options.radius = options.radius;

  Times times;
  for (int frame = 0; frame < options.frame_count; ++frame) {
    const lkao::method::Stopwatch of_all;
    scene.move_to(frame * kSecondsAFrame);
    renderer.draw_g_buffer(mesh.positions, lkao::scene::vertex_normals(mesh));
    occluders.update_positions(mesh.positions);  // lkao
    glFinish();
    const lkao::method::Stopwatch of_occlusion;
    pass.draw(occluders,                                                                                     // lkao
              {.width = width, .height = height, .depth = renderer.depth(), .normals = renderer.normals()},  // lkao
              {renderer.view(), renderer.projection(), lkao::gl::ClipDepth::zero_to_one}, ray_options);      // lkao
    pass.resolve({.occlusion = {renderer.occlusion()}});                                                     // lkao
    times.occlusion.push_back(finished_milliseconds(of_occlusion));
    renderer.shade();
    times.all.push_back(finished_milliseconds(of_all));
    if (!options.output.empty()) write_picture(picture_path(options.output, frame), renderer);
  }
  times.print();
  const Difference difference =
      moving_mesh::compare_with_query(pass, mesh.view(), pattern, ray_options, renderer.read_occlusion());
  fmt::print("last frame against the CPU's query: {:.3f} % of {} receivers equal at 8 bits, mean error {:.2g}\n",
             100 * difference.equal_share, difference.receiver_count, difference.mean_error);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Draws a moving mesh with ambient occlusion, frame by frame.", "moving_mesh");
  app.add_option("--frames", options.frame_count)->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_option("--size", options.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  app.add_option("--output", options.output, "folder for the frames as PNG files (default: none are written)");
  app.add_option("--radius", options.radius, "AO radius")->capture_default_str();
  app.add_option("--rays", options.ray_count, "a pixel, 1 to 1024")->capture_default_str();
  app.add_option("--masks", options.masks, "nearest: the paper's, fast; exact: the query's")
      ->check(CLI::IsMember(list_words(lkao::method::kPlaneMaskWords)))
      ->capture_default_str();
  app.add_option("--gl", options.device, "which OpenGL to use")
      ->check(CLI::IsMember(list_words(lkao::method::kDeviceWords)))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
    run(options);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const std::exception& error) {
    fmt::print(stderr, "moving_mesh: {}\n", error.what());
    return 2;
  }
}
