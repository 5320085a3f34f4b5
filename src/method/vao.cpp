// Volumetric ambient occlusion in screen space, by OpenGL (Boksansky et al., EGSR 2017).
#include <cstdint>
#include <memory>

#include <fmt/format.h>

#include "method/kinds.h"
#include "method/screen.h"

namespace lkao::method {
namespace {

constexpr Word<int> kSizeWords[] = {{"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}, {"32", 32}};
constexpr Word<gl::VaoCulling> kCullingWords[] = {
    {"off", gl::VaoCulling::off}, {"greedy", gl::VaoCulling::greedy}, {"careful", gl::VaoCulling::careful}};
constexpr int kConvergedCount = 4096;

const Setting& sample_count_setting() {
  static const Setting setting =
      word_setting("vao-samples", "Line samples a pixel, at most", kSizeWords, gl::VaoOptions().sample_count);
  return setting;
}

const Setting& fewest_setting() {
  static const Setting setting{
      .name = "vao-fewest-width",
      .help =
          "Where the ball is as wide on the screen as this share of the shorter side, 2 samples are taken, and twice "
          "as many where its area is twice as large; 0: always all",
      .values = Range{0, 10},
      .default_text = fmt::format("{:g}", gl::VaoOptions().fewest_samples_width)};
  return setting;
}

const Setting& culling_setting() {
  static const Setting setting = word_setting(
      "vao-culling", "Where a pre-pass finds nothing in the way, take no samples (greedy), at most 4 (careful), or all",
      kCullingWords, gl::VaoOptions().culling);
  return setting;
}

const Setting& sample_thickness_setting() {
  static const Setting setting{.name = "vao-thickness",
                               .help = "How thick what is seen is taken to be, in AO radii: u of the depth range check",
                               .values = Range{0, 1e6},
                               .default_text = fmt::format("{:g}", gl::VaoOptions().thickness)};
  return setting;
}

const Setting& width_setting() {
  static const Setting setting{
      .name = "vao-width", .help = "Width of the ball in AO radii", .values = Range{0.01, 100}, .default_text = "1"};
  return setting;
}

class Vao : public ScreenMethod {
 public:
  explicit Vao(const Settings& settings)
      : ScreenMethod(settings, screen_abilities(), {&sample_count_setting(), &fewest_setting(), &culling_setting()}),
        width_(static_cast<float>(settings.number(width_setting()))) {
    options_.sample_count = is_converged() ? kConvergedCount : settings.value(sample_count_setting(), kSizeWords);
    options_.fewest_samples_width = static_cast<float>(settings.number(fewest_setting()));
    options_.culling = is_converged() ? gl::VaoCulling::off : settings.value(culling_setting(), kCullingWords);
    options_.thickness = static_cast<float>(settings.number(sample_thickness_setting()));
  }

 protected:
  void set_question(const Question& question, const scene::Mesh&) override {
    options_.radius = width_ * question.radius;
    is_counted_ = false;
    options_.seed = static_cast<std::uint32_t>(question.seed);
  }

  void draw(const gl::GBuffer& g_buffer, const gl::Camera& camera, const gl::OcclusionTarget& to) override {
    // One frame alone, as that takes longer.
    (is_counted_ ? pass_ : counting_pass_).draw(g_buffer, camera, options_, to);
    is_counted_ = true;
  }

  void add_remarks(Remarks& remarks) const override {
    const gl::VaoCounts counts = counting_pass_.read_counts();
    const double receivers = counts.receivers > 0 ? static_cast<double>(counts.receivers) : 1;
    const double culled = static_cast<double>(counts.culled) / receivers;
    const double samples = static_cast<double>(counts.samples) / receivers;
    remarks.keys["culled_share"] = culled;
    remarks.keys["vao"] = {{"ball_width", options_.radius},
                           {"samples", options_.sample_count},
                           {"fewest_width", options_.fewest_samples_width},
                           {"culling", word_of(kCullingWords, options_.culling)},
                           {"thickness", options_.thickness},
                           {"samples_per_pixel", samples}};
    remarks.rows.emplace_back(
        "line samples", fmt::format("{:.1f} a pixel, at most {}; culling {}: {:.1f}% of the pixels", samples,
                                    options_.sample_count, word_of(kCullingWords, options_.culling), 100 * culled));
  }

 private:
  gl::VaoPass pass_, counting_pass_{{.count = true}};
  float width_;
  bool is_counted_ = false;
  gl::VaoOptions options_;
};

}  // namespace

MethodKind vao_kind() {
  return {.summary = "OpenGL, how much of a ball on the surface is free of what is seen (VAO++)",
          .settings = screen_settings({&sample_count_setting(), &fewest_setting(), &culling_setting(),
                                       &sample_thickness_setting(), &width_setting()}),
          .abilities = [](const Settings&) { return screen_abilities(); },
          .open = [](const Settings& settings) -> std::unique_ptr<Method> { return std::make_unique<Vao>(settings); }};
}

}  // namespace lkao::method
