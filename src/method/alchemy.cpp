// Obscurance by the pixels around each one, by OpenGL (McGuire et al., HPG 2011).
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "method/kinds.h"
#include "method/screen.h"

namespace lkao::method {
namespace {

constexpr Word<gl::ObscuranceFalloff> kFalloffWords[] = {{"cut_off", gl::ObscuranceFalloff::cut_off},
                                                         {"smooth", gl::ObscuranceFalloff::smooth},
                                                         {"medium", gl::ObscuranceFalloff::medium},
                                                         {"low", gl::ObscuranceFalloff::low}};
constexpr Word<gl::DiscPattern> kPatternWords[] = {{"jittered", gl::DiscPattern::jittered},
                                                   {"spiral", gl::DiscPattern::spiral},
                                                   {"even_spiral", gl::DiscPattern::even_spiral}};
constexpr int kMaxBands = 16;
constexpr int kConvergedSamples = 4096;
// Turns of a spiral for each sample that spread them best: the golden angle.
const double kGoldenTurn = (3 - std::sqrt(5.0)) / 2;

const Setting& intensity_setting() {
  static const Setting setting{
      .name = "alchemy-intensity",
      .help =
          "How dark: the paper's sigma, which is a length, in AO radii. Its pictures have 2; nearest to rays is "
          "less, and depends on the scene",
      .values = Range{0, 1e6},
      .default_text = "2"};
  return setting;
}

const Setting& bias_setting() {
  static const Setting setting{
      .name = "alchemy-bias",
      .help = "What is lower over a receiver's plane does not obscure: a share of the distance",
      .values = Range{0, 1},
      .default_text = "0.0001"};
  return setting;
}

const Setting& epsilon_setting() {
  static const Setting setting{.name = "alchemy-epsilon",
                               .help = "Added to squared distances, in squared AO radii, so that contact is not black",
                               .values = Range{1e-9, 1e3},
                               .default_text = "0.0004"};
  return setting;
}

const Setting& contrast_setting() {
  static const Setting setting{.name = "alchemy-contrast",
                               .help = "Visibility is taken to this power",
                               .values = Range{0.01, 100},
                               .default_text = "1"};
  return setting;
}

const Setting& falloff_setting() {
  static const Setting setting =
      word_setting("alchemy-falloff",
                   "How obscurance falls with the distance: the paper's, which ends at the radius, or those of its "
                   "successor, which have ever less contrast",
                   kFalloffWords, gl::ObscuranceFalloff::cut_off);
  return setting;
}

const Setting& samples_setting() {
  static const Setting setting{.name = "alchemy-samples",
                               .help = "Pixels that are looked at for each band of a receiver",
                               .values = Range{1, 1024, true},
                               .default_text = "4"};
  return setting;
}

const Setting& bands_setting() {
  static const Setting setting{.name = "alchemy-bands",
                               .help = "Bands at most; each halving of the AO radius on the screen takes one",
                               .values = Range{1, kMaxBands, true},
                               .default_text = "3"};
  return setting;
}

const Setting& full_radius_setting() {
  static const Setting setting{.name = "alchemy-full-radius",
                               .help = "Pixels that the AO radius is long on the screen where all bands are taken",
                               .values = Range{0, 1e6},
                               .default_text = "32"};
  return setting;
}

const Setting& pattern_setting() {
  static const Setting setting =
      word_setting("alchemy-pattern",
                   "Where samples lie: as often everywhere (jittered), on the successor's spiral, where what is near "
                   "counts for more, or on one where it does not (even_spiral)",
                   kPatternWords, gl::DiscPattern::jittered);
  return setting;
}

const Setting& turns_setting() {
  static const Setting setting{
      .name = "alchemy-turns", .help = "Turns of a spiral", .values = Range{0.01, 1e4}, .default_text = "7"};
  return setting;
}

class Alchemy : public ScreenMethod {
 public:
  explicit Alchemy(const Settings& settings)
      : ScreenMethod(settings, screen_abilities(),
                     {&samples_setting(), &bands_setting(), &full_radius_setting(), &turns_setting()}) {
    const auto number = [&](const Setting& setting) { return static_cast<float>(settings.number(setting)); };
    options_.intensity = number(intensity_setting());
    options_.bias = number(bias_setting());
    options_.epsilon = number(epsilon_setting());
    options_.contrast = number(contrast_setting());
    options_.falloff = settings.value(falloff_setting(), kFalloffWords);
    options_.pattern = settings.value(pattern_setting(), kPatternWords);
    options_.samples_per_band = is_converged() ? kConvergedSamples : whole(settings, samples_setting());
    options_.max_band_count = is_converged() ? 1 : whole(settings, bands_setting());
    options_.full_radius = number(full_radius_setting());
    options_.spiral_turns =
        is_converged() ? static_cast<float>(kGoldenTurn * kConvergedSamples) : number(turns_setting());
  }

 private:
  void set_question(const Question& question, const scene::Mesh&) override {
    options_.radius = question.radius;
    options_.seed = static_cast<std::uint32_t>(question.seed);
  }

  void draw(const gl::GBuffer& g_buffer, const gl::Camera& camera, const gl::OcclusionTarget& to) override {
    pass_.draw(g_buffer, camera, options_, to);
  }

  void add_remarks(Remarks& remarks) const override {
    remarks.keys["alchemy"] = {{"intensity", options_.intensity},
                               {"bias", options_.bias},
                               {"epsilon", options_.epsilon},
                               {"contrast", options_.contrast},
                               {"falloff", word_of(kFalloffWords, options_.falloff)},
                               {"samples", options_.samples_per_band},
                               {"bands", options_.max_band_count},
                               {"full_radius", options_.full_radius},
                               {"pattern", word_of(kPatternWords, options_.pattern)},
                               {"turns", options_.spiral_turns}};
    remarks.rows.emplace_back("obscurance",
                              fmt::format("intensity {:g} radii, falloff {}, contrast {:g}", options_.intensity,
                                          word_of(kFalloffWords, options_.falloff), options_.contrast));
    remarks.rows.emplace_back("samples",
                              fmt::format("at most {} a pixel, {}", options_.samples_per_band * options_.max_band_count,
                                          word_of(kPatternWords, options_.pattern)));
  }

  gl::AlchemyPass pass_;
  gl::AlchemyOptions options_;
};

}  // namespace

MethodKind alchemy_kind() {
  return {
      .summary = "OpenGL, obscurance by the pixels around each one",
      .settings = screen_settings({&intensity_setting(), &bias_setting(), &epsilon_setting(), &contrast_setting(),
                                   &falloff_setting(), &samples_setting(), &bands_setting(), &full_radius_setting(),
                                   &pattern_setting(), &turns_setting()}),
      .abilities = [](const Settings&) { return screen_abilities(); },
      .open = [](const Settings& settings) -> std::unique_ptr<Method> { return std::make_unique<Alchemy>(settings); }};
}

}  // namespace lkao::method
