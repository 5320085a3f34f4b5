// Ambient occlusion volumes (McGuire 2010): no rays, a sum over the triangles near each pixel, drawn by OpenGL.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "method/frame.h"
#include "method/gl_device.h"
#include "method/kinds.h"
#include "raster/volume_rasterizer.h"

namespace lkao::method {
namespace {

enum class Volumes { kept, every_frame };

constexpr Word<gl::Accessibility> kAccessibilityWords[] = {
    {"8", gl::Accessibility::bits8}, {"16", gl::Accessibility::bits16}, {"32", gl::Accessibility::bits32}};
constexpr Word<bool> kClampWords[] = {{"on", true}, {"off", false}};
constexpr Word<bool> kCompensationWords[] = {{"none", false}, {"fitted", true}};
constexpr Word<Volumes> kVolumesWords[] = {{"kept", Volumes::kept}, {"every_frame", Volumes::every_frame}};

const Setting& delta_setting() {
  static const Setting setting{"delta",
                               "How far volumes reach, as a share of the radius: the paper's 0.6 is for rays of linear "
                               "falloff",
                               Range{0.01, 100}, "0.6"};
  return setting;
}

const Setting& opacity_setting() {
  static const Setting setting{"opacity", "How much every triangle blocks of what it covers: the paper's mean alpha",
                               Range{0, 1}, "1"};
  return setting;
}

const Setting& clamp_setting() {
  static const Setting setting =
      word_setting("clamp", "Whether no corner of a volume is farther than 2 delta from its triangle's", kClampWords,
                   gl::VolumeOptions().clamps_extensions);
  return setting;
}

const Setting& accessibility_setting() {
  static const Setting setting = word_setting(
      "accessibility", "Bits of the buffer that triangles are taken from: with the paper's 8 small ones are lost",
      kAccessibilityWords, gl::VolumePassSetup().accessibility);
  return setting;
}

const Setting& compensation_setting() {
  static const Setting setting = word_setting(
      "compensation", "A curve that makes up for occluders that are counted twice", kCompensationWords, false);
  return setting;
}

const Setting& volumes_setting() {
  static const Setting setting = word_setting("volumes", "Found once, as for static scenes, or by every frame",
                                              kVolumesWords, Volumes::every_frame);
  return setting;
}

const Setting& geometry_setting() {
  static const Setting setting =
      word_setting("geometry", "How volumes are made", kGeometryWords, gl::GeometryBackEnd::vertex_pulling);
  return setting;
}

const Setting& sparse_setting() {
  static const Setting setting{"sparse", "Draw one pixel of so many x so many, and find the others by a filter",
                               Range{1, 16}, "1"};
  return setting;
}

Abilities volumes_abilities(const Settings&) {
  return {.masks = false,
          .bent_normals = false,
          .levels = false,
          .infinite_lengths = false,
          .any_receivers = false,
          .infinite_radius = false,
          .min_distance = false,
          .uniform_weighting = false,
          .constant_falloff = false,
          .other_falloffs = false};
}

class VolumesMethod : public Method {
 public:
  explicit VolumesMethod(const Settings& settings)
      : Method(volumes_abilities(settings)), settings_(settings), rasterizer_(prepare_device(settings)) {
    options_.clamps_extensions = settings_.value(clamp_setting(), kClampWords);
    if (settings_.value(compensation_setting(), kCompensationWords)) options_.compensation = gl::kFittedCompensation;
  }

  std::string device() const override { return device_text(rasterizer_.context()); }

  void require_size(int width, int height) const override { raster::require_texture_size(width, height); }

  void prepare(const Task& task) override {
    const Stopwatch watch;
    const View& view = task.view.value();
    rasterizer_.set_view(view.camera, view.image);
    rasterizer_.set_occluders(task.occluders.mesh(), static_cast<float>(settings_.number(opacity_setting())));
    rays_ = task.question.ray_options();
    rays_.radius *= static_cast<float>(settings_.number(delta_setting()));
    start_pass(true);
    rasterizer_.draw(rays_, options_);
    fragments_ = rasterizer_.pass().read_fragment_counts();
    start_pass(false);
    warm_up();
    setup_seconds_ = watch.seconds();
    geometry_ = word_of(kGeometryWords, rasterizer_.pass().geometry());
  }

  Answered answer(std::span<const Receiver>, const QueryOutputs& outputs, std::uint64_t) override {
    times_ = draw_repeatedly([&] { return rasterizer_.draw(rays_, options_); });
    const std::vector<float> occlusion = rasterizer_.read_occlusion();
    copy_frame(occlusion, outputs.occlusion);
    const QueryReport report = count_receivers(occlusion, 0);
    receiver_count_ = report.receiver_count - report.invalid_receiver_count;
    return {report, times_.seconds};
  }

  Remarks remarks() const override {
    const gl::HeadlessContext& context = rasterizer_.context();
    const double milliseconds = 1000 * times_.seconds;
    nlohmann::ordered_json gl = device_keys(context);
    gl["geometry"] = geometry_;
    gl["setup_seconds"] = setup_seconds_;
    gl["draw_milliseconds"] = milliseconds;
    gl["draw_count"] = times_.frame_count;
    const double fill =
        static_cast<double>(fragments_.drawn) / static_cast<double>(std::max<std::size_t>(1, receiver_count_));
    const std::string draws = times_.frame_count == 1 ? "drawn once" : fmt::format("median of {}", times_.frame_count);
    return {.keys = {{"volumes", volume_keys()}, {"gl", gl}},
            .rows = {{"OpenGL", fmt::format("{}{}, {}", context.renderer(), context.is_software() ? ", software" : "",
                                            geometry_)},
                     {"frame", fmt::format("{:.2f} ms, {}; {:.3f} s to set up", milliseconds, draws, setup_seconds_)},
                     {"volumes", fmt::format("delta {:g}, {:.1f} fragments a receiver", rays_.radius, fill)}}};
  }

 private:
  void start_pass(bool counts) {
    rasterizer_.start_pass({.geometry = settings_.value(geometry_setting(), kGeometryWords),
                            .accessibility = settings_.value(accessibility_setting(), kAccessibilityWords),
                            .keeps_volumes = settings_.value(volumes_setting(), kVolumesWords) == Volumes::kept,
                            .count_fragments = counts},
                           static_cast<int>(settings_.number(sparse_setting())));
  }

  // What a driver leaves to the first frame, such as compiling shaders, and volumes that are kept; with next to nothing
  // to draw where none are.
  void warm_up() {
    RayOptions rays = rays_;
    if (settings_.value(volumes_setting(), kVolumesWords) == Volumes::every_frame) rays.radius *= 1e-4f;
    rasterizer_.draw(rays, options_);
  }

  nlohmann::ordered_json volume_keys() const {
    nlohmann::ordered_json keys{{"delta", rays_.radius},
                                {"opacity", settings_.number(opacity_setting())},
                                {"fragments", fragments_.drawn},
                                {"fragments_inside", fragments_.inside},
                                {"fragments_blended", fragments_.blended}};
    for (const Setting* setting :
         {&clamp_setting(), &accessibility_setting(), &compensation_setting(), &volumes_setting(), &sparse_setting()}) {
      keys[setting->name] = settings_.text(*setting);
    }
    return keys;
  }

  Settings settings_;
  raster::VolumeRasterizer rasterizer_;
  gl::VolumeOptions options_;
  RayOptions rays_ = {.radius = 1};
  gl::VolumeFragments fragments_;
  std::size_t receiver_count_ = 0;
  double setup_seconds_ = 0;  // mesh, shaders, and the frame whose fragments are counted
  std::string_view geometry_;
  FrameTimes times_;
};

}  // namespace

MethodKind volumes_kind() {
  return {.summary =
              "OpenGL, which sums up what each triangle covers of the sky (ambient occlusion volumes; needs "
              "--falloff linear)",
          .settings = {&device_setting(), &delta_setting(), &clamp_setting(), &accessibility_setting(),
                       &compensation_setting(), &opacity_setting(), &volumes_setting(), &geometry_setting(),
                       &sparse_setting()},
          .abilities = volumes_abilities,
          .open = [](const Settings& settings) -> std::unique_ptr<Method> {
            return std::make_unique<VolumesMethod>(settings);
          }};
}

}  // namespace lkao::method
