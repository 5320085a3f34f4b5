// The rasterised method of Laine & Karras: masks of all pixels, drawn by OpenGL.
#include <fmt/format.h>

#include "method/frame.h"
#include "method/gl_device.h"
#include "method/kinds.h"
#include "method/plane_mask_words.h"
#include "raster/rasterizer.h"

namespace lkao::method {
namespace {

const Setting& masks_setting() {
  static const Setting setting = word_setting(
      "masks", "What is taken from the table: exact tests the rays that a cell leaves open, nearest does not",
      kPlaneMaskWords, PlaneMasks::must_may);
  return setting;
}

Abilities mask_abilities(const Settings&) { return {.infinite_lengths = false, .any_receivers = false}; }

class Masks : public Method {
 public:
  explicit Masks(const Settings& settings)
      : Method(mask_abilities(settings)),
        masks_(settings.value(masks_setting(), kPlaneMaskWords)),
        rasterizer_(prepare_device(settings)) {}

  std::string device() const override { return device_text(rasterizer_.context()); }

  void require_size(int width, int height) const override { rasterizer_.require_size(width, height); }

  void prepare(const Task& task) override {
    const Stopwatch watch;
    const View& view = task.view.value();
    rasterizer_.set_view(view.camera, view.image);
    rasterizer_.start_pass({}, task.occluders.drawn_mesh(), task.question.table(masks_), task.occluders.drawn_ranges());
    rays_ = task.question.ray_options();
    rasterizer_.warm_up(rays_);
    setup_seconds_ = watch.seconds();
    geometry_ = word_of(kGeometryWords, rasterizer_.pass().geometry());
    accumulator_ = word_of(kAccumulatorWords, rasterizer_.pass().accumulator());
    ray_count_ = task.question.ray_count;
  }

  Answered answer(std::span<const Receiver>, const QueryOutputs& outputs, std::uint64_t) override {
    const bool with_bent_normals = !outputs.bent_normals.empty();
    times_ = draw_repeatedly([&] { return rasterizer_.draw(rays_, {}, with_bent_normals); });
    const std::vector<float> occlusion = rasterizer_.read_occlusion();
    copy_frame(occlusion, outputs.occlusion);
    if (with_bent_normals) copy_frame(rasterizer_.read_bent_normals(), outputs.bent_normals);
    if (!outputs.mask_words.empty()) copy_frame(rasterizer_.pass().read_masks(), outputs.mask_words);
    return {count_receivers(occlusion, ray_count_), times_.seconds};
  }

  Remarks remarks() const override {
    const gl::HeadlessContext& context = rasterizer_.context();
    const std::string_view masks = word_of(kPlaneMaskWords, masks_);
    const double milliseconds = 1000 * times_.seconds;

    nlohmann::ordered_json gl = device_keys(context);
    gl["geometry"] = geometry_;
    gl["accumulator"] = accumulator_;
    gl["setup_seconds"] = setup_seconds_;
    gl["draw_milliseconds"] = milliseconds;
    gl["draw_count"] = times_.frame_count;
    const std::string draws = times_.frame_count == 1 ? "drawn once" : fmt::format("median of {}", times_.frame_count);
    return {.keys = {{"masks", masks}, {"gl", gl}},
            .rows = {{"OpenGL", fmt::format("{}{}, {}, {}", context.renderer(),
                                            context.is_software() ? ", software" : "", geometry_, accumulator_)},
                     {"frame", fmt::format("{:.2f} ms, {}, {} masks; {:.3f} s to set up", milliseconds, draws, masks,
                                           setup_seconds_)}}};
  }

 private:
  PlaneMasks masks_;
  raster::Rasterizer rasterizer_;
  RayOptions rays_ = {.radius = 1};
  int ray_count_ = 0;
  double setup_seconds_ = 0;  // mesh, table and shaders
  std::string_view geometry_, accumulator_;
  FrameTimes times_;
};

}  // namespace

MethodKind masks_kind() {
  return {
      .summary = "OpenGL, which rasterises what occluders can darken",
      .settings = {&device_setting(), &masks_setting()},
      .abilities = mask_abilities,
      .open = [](const Settings& settings) -> std::unique_ptr<Method> { return std::make_unique<Masks>(settings); }};
}

}  // namespace lkao::method
