#include "cli/raster_method.h"

#include <vector>

#include "cli/median.h"
#include "cli/stopwatch.h"
#include "raster/rasterizer.h"

namespace lkao::cli {
namespace {

// A frame is drawn again while its time is short, so that it does not hang on what a driver does once.
constexpr int kMaxDrawCount = 5;
constexpr double kEnoughSeconds = 1;

const char* name_of(gl::GeometryBackEnd geometry) {
  return geometry == gl::GeometryBackEnd::geometry_shader ? "geometry_shader" : "vertex_pulling";
}
const char* name_of(gl::Accumulator accumulator) {
  return accumulator == gl::Accumulator::logic_op ? "logic_op" : "ssbo";
}

std::vector<double> draw_repeatedly(raster::Rasterizer& rasterizer, const RayOptions& options, bool with_bent_normals) {
  std::vector<double> seconds;
  const Stopwatch watch;
  do {
    seconds.push_back(rasterizer.draw(options, {}, with_bent_normals));
  } while (seconds.size() < kMaxDrawCount && watch.seconds() < kEnoughSeconds);
  return seconds;
}

}  // namespace

struct RasterMethod::State {
  explicit State(const RasterOptions& options)
      : masks(options.masks.value_or(PlaneMasks::must_may)),
        rasterizer(options.device.value_or(gl::Device::automatic)) {}

  PlaneMasks masks;
  raster::Rasterizer rasterizer;
};

RasterMethod::RasterMethod(const RasterOptions& options, const Size& size) : state_(std::make_unique<State>(options)) {
  state_->rasterizer.require_size(size.width, size.height);
}

RasterMethod::~RasterMethod() = default;

RasterFrame RasterMethod::draw(const scene::Mesh& mesh, std::span<const glm::vec2> ranges, const scene::Camera& camera,
                               const scene::ReceiverImage& view, const OcclusionOptions& options,
                               const FrameOptions& wanted) {
  raster::Rasterizer& rasterizer = state_->rasterizer;
  const gl::HeadlessContext& context = rasterizer.context();
  RasterFrame frame;
  RasterReport& report = frame.report;
  const Stopwatch watch;
  rasterizer.set_view(camera, view);
  rasterizer.start_pass({}, mesh, make_table(options, state_->masks), ranges);
  report.setup_seconds = watch.seconds();
  const std::vector<double> seconds = draw_repeatedly(rasterizer, ray_options(options), wanted.bent_normals);

  report.renderer = context.renderer();
  report.version = context.version();
  report.is_software = context.is_software();
  report.masks = state_->masks;
  report.geometry = name_of(rasterizer.pass().geometry());
  report.accumulator = name_of(rasterizer.pass().accumulator());
  report.draw_seconds = median(seconds);
  report.draw_count = static_cast<int>(seconds.size());
  frame.ray_count = options.ray_count;
  frame.occlusion = rasterizer.read_occlusion();
  if (wanted.bent_normals) frame.bent_normals = rasterizer.read_bent_normals();
  if (wanted.masks) frame.mask_words = rasterizer.pass().read_masks();
  return frame;
}

void require_raster_method() {}

}  // namespace lkao::cli
