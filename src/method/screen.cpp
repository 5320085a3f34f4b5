#include "method/screen.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "method/gl_device.h"
#include "method/guard_band.h"

namespace lkao::method {
namespace {

const Setting& converged_setting() {
  static const Setting setting = flag_setting(
      "converged", "What the method's own assumptions lead to: thousands of samples a pixel, and no filter");
  return setting;
}

const Setting& guard_band_setting() {
  static const Setting setting{
      .name = "guard-band",
      .help = "Pixels beyond each edge of the picture that are drawn, block, and are thrown away",
      .values = Range{0, 2048, true},
      .default_text = "0"};
  return setting;
}

const Setting& step_setting() {
  static const Setting setting{
      .name = "step",
      .help = "2 answers every second pixel along each axis, and so on; the others are upsampled",
      .values = Range{1, 16, true},
      .default_text = "1"};
  return setting;
}

const Setting& filter_setting() {
  static const Setting setting{.name = "filter",
                               .help = "Radius in pixels of the cross-bilateral filter of the result; 0: none",
                               .values = Range{0, 16, true},
                               .default_text = "4"};
  return setting;
}

// Throws where something was chosen that --converged decides.
bool wants_converged(const Settings& settings, std::vector<const Setting*> estimator) {
  if (!settings.flag(converged_setting())) return false;
  estimator.insert(estimator.end(), {&step_setting(), &filter_setting()});
  const std::vector<const Setting*> chosen = settings.chosen();
  for (const Setting* setting : estimator) {
    if (std::find(chosen.begin(), chosen.end(), setting) == chosen.end()) continue;
    throw std::invalid_argument(fmt::format("--converged: not with --{}, which it decides by itself", setting->name));
  }
  return true;
}

raster::Smoothing smoothing_of(const Settings& settings, bool is_converged) {
  if (is_converged) return {};
  return {whole(settings, step_setting()), whole(settings, filter_setting())};
}

}  // namespace

std::vector<const Setting*> screen_settings(std::vector<const Setting*> own) {
  std::vector<const Setting*> all = {&device_setting(), &converged_setting(), &guard_band_setting(), &step_setting(),
                                     &filter_setting()};
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

Abilities screen_abilities() {
  return {.masks = false,
          .bent_normals = false,
          .levels = false,
          .any_receivers = false,
          .infinite_radius = false,
          .min_distance = false,
          .one_sided = false,
          .uniform_weighting = false,
          .linear_falloff = false,
          .other_falloffs = false};
}

ScreenMethod::ScreenMethod(const Settings& settings, const Abilities& abilities,
                           const std::vector<const Setting*>& estimator)
    : Method(abilities),
      is_converged_(wants_converged(settings, estimator)),
      margin_(whole(settings, guard_band_setting())),
      smoothing_(smoothing_of(settings, is_converged_)),
      drawer_(prepare_device(settings)) {}

std::string ScreenMethod::device() const { return device_text(drawer_.context()); }

void ScreenMethod::require_size(int width, int height) const {
  raster::require_texture_size(width + 2 * margin_, height + 2 * margin_);
}

void ScreenMethod::prepare(const Task& task) {
  const View& view = task.view.value();
  const scene::Mesh& mesh = task.occluders.mesh();
  set_question(task.question, mesh);
  frame_width_ = view.image.width + 2 * margin_;
  if (margin_ == 0) {
    drawer_.set_view(view.camera, view.image);
  } else {
    const GuardedView wide = widen(mesh, view.camera, view.image, margin_);
    drawer_.set_view(wide.camera, wide.image);
  }
}

Answered ScreenMethod::answer(std::span<const Receiver>, const QueryOutputs& outputs, std::uint64_t) {
  const auto pass = [this](const gl::GBuffer& g_buffer, const gl::Camera& camera, const gl::OcclusionTarget& to) {
    draw(g_buffer, camera, to);
  };
  times_ = draw_repeatedly([&] { return drawer_.draw(pass, smoothing_); });
  const std::vector<float> occlusion = without_margin(drawer_.read_occlusion(), frame_width_, margin_);
  copy_frame(occlusion, outputs.occlusion);
  return {count_receivers(occlusion, 0), times_.seconds};
}

Remarks ScreenMethod::remarks() const {
  const double milliseconds = 1000 * times_.seconds;
  Remarks remarks;
  remarks.keys["converged"] = is_converged_;
  remarks.keys["guard_band"] = margin_;
  remarks.keys["step"] = smoothing_.step;
  remarks.keys["filter"] = smoothing_.filter_radius;
  nlohmann::ordered_json gl = device_keys(drawer_.context());
  gl["draw_milliseconds"] = milliseconds;
  gl["draw_count"] = times_.frame_count;
  remarks.keys["gl"] = gl;
  remarks.rows.emplace_back("OpenGL", device());
  remarks.rows.emplace_back("frame", fmt::format("{:.2f} ms, median of {}", milliseconds, times_.frame_count));
  add_remarks(remarks);
  return remarks;
}

}  // namespace lkao::method
