// The rasterised method: its options, a frame drawn by OpenGL, and what is told of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cli/batch.h"
#include "cli/options.h"
#include "cli/parse.h"
#include "cli/report.h"
#include "lkao/gl.h"
#include "scene/camera.h"
#include "scene/mesh.h"

namespace CLI {
class App;
}

namespace lkao::cli {

struct RasterOptions {
  std::optional<gl::Device> device;
  std::optional<PlaneMasks> masks;
};
void add_raster_options(CLI::App& app, RasterOptions& options);

// What drew a frame, and how fast.
struct RasterReport {
  std::string renderer;
  std::string version;
  bool is_software = false;
  PlaneMasks masks = PlaneMasks::must_may;
  std::string geometry;
  std::string accumulator;
  double setup_seconds = 0;  // mesh, table and shaders
  double draw_seconds = 0;   // masks and resolve; the median
  int draw_count = 0;
};
void add_raster_rows(Table& table, const RasterReport& report);
void add_raster_keys(Json& document, const RasterReport& report);

// A whole image's answers.
struct RasterFrame {
  std::vector<float> occlusion;           // one a pixel; NaN where there is no receiver
  std::vector<glm::vec3> bent_normals;    // where asked for
  std::vector<std::uint64_t> mask_words;  // where asked for
  int ray_count = 0;                      // that every valid receiver casts
  RasterReport report;

  // Hands the answers out, as a query would. The frame must outlive it.
  Answer answer() const;
};

struct FrameOptions {
  bool bent_normals = false;
  bool masks = false;
};

// OpenGL, ready to draw. In a program built without, the constructor throws.
class RasterMethod {
 public:
  // Throws std::runtime_error with one line where there is no such device or it cannot draw so large an image.
  RasterMethod(const RasterOptions& options, const Size& size);
  ~RasterMethod();
  RasterMethod(const RasterMethod&) = delete;
  RasterMethod& operator=(const RasterMethod&) = delete;

  // The pixels of `view`, which `camera` sees, among the occluders of `mesh`; `ranges` as gl::MaskPass wants them.
  // Needs the radius of `options`.
  RasterFrame draw(const scene::Mesh& mesh, std::span<const glm::vec2> ranges, const scene::Camera& camera,
                   const scene::ReceiverImage& view, const OcclusionOptions& options, const FrameOptions& wanted);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Threads of a rasteriser on the CPU: as many as given, where the environment does not say. Before any other thread
// runs.
void limit_gl_threads(std::optional<int> thread_count);

// Throws std::runtime_error in a program built without OpenGL.
void require_raster_method();

}  // namespace lkao::cli
