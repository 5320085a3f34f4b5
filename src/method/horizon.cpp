// Ambient occlusion by horizons (GTAO: Jimenez et al. 2016) and by masks of sectors (VBAO: Therrien et al. 2023), drawn
// by OpenGL.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "method/kinds.h"
#include "method/screen.h"
#include "raster/mean_frame.h"

namespace lkao::method {
namespace {

// --converged: so many slices in all, on which each pixel is stepped, over so many frames.
constexpr int kConvergedSliceCount = 32;
constexpr int kConvergedFrameCount = 8;
// Of slices and steps, HorizonOptions.
constexpr int kMaxStepCount = 16384;

constexpr Word<gl::SliceDensity> kSliceDensityWords[] = {{"cosine", gl::SliceDensity::cosine},
                                                         {"even", gl::SliceDensity::even}};
constexpr Word<gl::SectorMeasure> kSectorMeasureWords[] = {{"cosine", gl::SectorMeasure::cosine},
                                                           {"angle", gl::SectorMeasure::angle}};

const Setting& slices_setting() {
  static const Setting setting{
      .name = "slices",
      .help = "Slices a pixel: half-discs around the normal that hold the direction to the eye",
      .values = Range{1, 512, true},
      .default_text = "2"};
  return setting;
}

const Setting& slice_steps_setting() {
  static const Setting setting{.name = "slice-steps",
                               .help = "Pixels that are looked at on each side of a slice, at most",
                               .values = Range{1, kMaxStepCount, true},
                               .default_text = "16"};
  return setting;
}

const Setting& step_exponent_setting() {
  static const Setting setting{.name = "step-exponent",
                               .help = "How they lie: 1 evenly, more the nearer to the receiver",
                               .values = Range{1, 4},
                               .default_text = "2"};
  return setting;
}

const Setting& slice_density_setting() {
  static const Setting setting =
      word_setting("slice-density",
                   "How slices lie around the direction to the eye: by how much of the cosine-weighted hemisphere they "
                   "hold, or evenly and weighed",
                   kSliceDensityWords, gl::SliceDensity::cosine);
  return setting;
}

const Setting& screen_radius_setting() {
  static const Setting setting{.name = "screen-radius",
                               .help = "Pixels of the screen beyond which nothing blocks, whatever the AO radius",
                               .values = Range{1, 65536},
                               .default_text = "512"};
  return setting;
}

const Setting& falloff_begin_setting() {
  static const Setting setting{.name = "falloff-begin",
                               .help = "Share of the AO radius up to which occluders count in full; then less and less",
                               .values = Range{0, 1},
                               .default_text = "1"};
  return setting;
}

const Setting& angle_bias_setting() {
  static const Setting setting{.name = "angle-bias",
                               .help = "What rises less above the tangent plane blocks nothing, in radians",
                               .values = Range{0, 1},
                               .default_text = "0.03"};
  return setting;
}

const Setting& sinking_setting() {
  static const Setting setting{
      .name = "sinking",
      .help =
          "Share of the AO radius over which horizons sink to what is farther on, for light behind thin things; 0: "
          "never, as in a height field",
      .values = Range{0, 1000},
      .default_text = "0"};
  return setting;
}

const Setting& thickness_setting() {
  static const Setting setting{
      .name = "thickness",
      .help = "How thick all occluders are, as a share of the AO radius; 0: endless, as in a height field",
      .values = Range{0, 1000},
      .default_text = "0.5"};
  return setting;
}

const Setting& sector_measure_setting() {
  static const Setting setting =
      word_setting("sector-measure",
                   "What the sectors of a mask have in common: cosine-weighted solid angles, or angles, the paper's",
                   kSectorMeasureWords, gl::SectorMeasure::cosine);
  return setting;
}

std::vector<const Setting*> shared_settings() {
  return {&slices_setting(),        &slice_steps_setting(),   &step_exponent_setting(), &slice_density_setting(),
          &screen_radius_setting(), &falloff_begin_setting(), &angle_bias_setting()};
}

std::vector<const Setting*> bitmask_settings() {
  std::vector<const Setting*> settings = shared_settings();
  settings.insert(settings.end(), {&thickness_setting(), &sector_measure_setting()});
  return settings;
}

std::vector<const Setting*> horizons_settings() {
  std::vector<const Setting*> settings = shared_settings();
  settings.push_back(&sinking_setting());
  return settings;
}

Abilities horizons_abilities(const Settings&) { return screen_abilities(); }

// Sectors have lengths as rays have.
Abilities bitmask_abilities(const Settings&) {
  Abilities abilities = screen_abilities();
  abilities.linear_falloff = true;
  return abilities;
}

class Horizon : public ScreenMethod {
 public:
  Horizon(const Settings& settings, gl::HorizonEstimator estimator)
      : ScreenMethod(settings, is_bitmask(estimator) ? bitmask_abilities(settings) : horizons_abilities(settings),
                     {&slices_setting(), &slice_steps_setting(), &step_exponent_setting(), &slice_density_setting()}),
        falloff_begin_(static_cast<float>(settings.number(falloff_begin_setting()))),
        has_falloff_begin_(is_chosen(settings, falloff_begin_setting())),
        thickness_share_(settings.number(is_bitmask(estimator) ? thickness_setting() : sinking_setting())) {
    options_.estimator = estimator;
    options_.slice_count = is_converged() ? kConvergedSliceCount : whole(settings, slices_setting());
    options_.step_count = whole(settings, slice_steps_setting());
    options_.step_exponent = static_cast<float>(settings.number(step_exponent_setting()));
    options_.slice_density = settings.value(slice_density_setting(), kSliceDensityWords);
    options_.screen_radius = static_cast<float>(settings.number(screen_radius_setting()));
    options_.angle_bias = static_cast<float>(settings.number(angle_bias_setting()));
    if (is_bitmask(estimator)) {
      options_.sector_measure = settings.value(sector_measure_setting(), kSectorMeasureWords);
    }
  }

 private:
  static bool is_bitmask(gl::HorizonEstimator estimator) { return estimator == gl::HorizonEstimator::bitmask; }
  static bool is_chosen(const Settings& settings, const Setting& setting) {
    const std::vector<const Setting*> chosen = settings.chosen();
    return std::find(chosen.begin(), chosen.end(), &setting) != chosen.end();
  }

  void set_question(const Question& question, const scene::Mesh&) override {
    options_.radius = question.radius;
    options_.thickness = thickness_share_ > 0 ? static_cast<float>(thickness_share_ * double{question.radius})
                                              : std::numeric_limits<float>::infinity();
    options_.seed = static_cast<std::uint32_t>(question.seed);
    const bool is_linear = question.falloff.name() == Falloff::linear().name();
    if (is_linear && has_falloff_begin_) {
      throw std::invalid_argument("--falloff-begin: not with --falloff linear, which begins at 0");
    }
    options_.falloff_begin = is_linear ? 0 : falloff_begin_;
  }

  void draw(const gl::GBuffer& g_buffer, const gl::Camera& camera, const gl::OcclusionTarget& to) override {
    if (!is_converged()) return pass_.draw(g_buffer, camera, options_, to);
    gl::HorizonOptions options = options_;
    options.step_count = std::min(std::max(g_buffer.width, g_buffer.height), kMaxStepCount);
    options.slice_count = std::min(kConvergedSliceCount, kMaxStepCount / options.step_count);
    const int frame_count = kConvergedSliceCount * kConvergedFrameCount / options.slice_count;
    raster::draw_mean(frame_count, to, g_buffer.width, g_buffer.height, [&](int i) {
      options.seed = options_.seed + static_cast<std::uint32_t>(i);
      pass_.draw(g_buffer, camera, options, to);
    });
  }

  void add_remarks(Remarks& remarks) const override {
    nlohmann::ordered_json& keys = remarks.keys;
    keys["slices"] = is_converged() ? kConvergedSliceCount * kConvergedFrameCount : options_.slice_count;
    // All pixels of a slice.
    keys["slice_steps"] = is_converged() ? nlohmann::ordered_json() : nlohmann::ordered_json(options_.step_count);
    keys["step_exponent"] = options_.step_exponent;
    keys["slice_density"] = word_of(kSliceDensityWords, options_.slice_density);
    keys["screen_radius"] = options_.screen_radius;
    keys["falloff_begin"] = options_.falloff_begin;
    keys["angle_bias"] = options_.angle_bias;
    const bool is_endless = std::isinf(options_.thickness);
    keys["thickness"] = is_endless ? nlohmann::ordered_json() : nlohmann::ordered_json(options_.thickness);
    if (is_bitmask(options_.estimator)) {
      keys["sector_measure"] = word_of(kSectorMeasureWords, options_.sector_measure);
    }
    const std::string samples = is_converged() ? fmt::format("{} slices, all pixels of each", keys["slices"].get<int>())
                                               : fmt::format("{} slices, up to {} steps on both sides of each",
                                                             options_.slice_count, options_.step_count);
    remarks.rows.emplace_back("samples", samples);
    remarks.rows.emplace_back("thickness", is_endless ? "endless" : fmt::format("{:.4g}", options_.thickness));
  }

  float falloff_begin_;
  bool has_falloff_begin_;
  double thickness_share_;
  gl::HorizonOptions options_;
  gl::HorizonPass pass_;
};

}  // namespace

MethodKind gtao_kind() {
  return {.summary = "OpenGL, horizons of the depth buffer",
          .settings = screen_settings(horizons_settings()),
          .abilities = horizons_abilities,
          .open = [](const Settings& settings) -> std::unique_ptr<Method> {
            return std::make_unique<Horizon>(settings, gl::HorizonEstimator::horizons);
          }};
}

MethodKind vbao_kind() {
  return {.summary = "OpenGL, masks of what the depth buffer blocks",
          .settings = screen_settings(bitmask_settings()),
          .abilities = bitmask_abilities,
          .open = [](const Settings& settings) -> std::unique_ptr<Method> {
            return std::make_unique<Horizon>(settings, gl::HorizonEstimator::bitmask);
          }};
}

}  // namespace lkao::method
