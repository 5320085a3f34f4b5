// Spheres of pixels and of the scene, by OpenGL (Shanmugam & Arikan, I3D 2007).
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lod/spheres.h"
#include "method/frame.h"
#include "method/gl_device.h"
#include "method/kinds.h"
#include "raster/splatter.h"

namespace lkao::method {
namespace {

enum class Halves { near_half, far_half, both };

constexpr Word<Halves> kHalvesWords[] = {
    {"near", Halves::near_half}, {"far", Halves::far_half}, {"both", Halves::both}};
constexpr Word<int> kLayerWords[] = {{"1", 1}, {"2", 2}};
constexpr Word<gl::SampleDensity> kDensityWords[] = {{"even", gl::SampleDensity::even},
                                                     {"falling", gl::SampleDensity::falling}};
constexpr Word<gl::SphereFormula> kFormulaWords[] = {
    {"cap", gl::SphereFormula::cap}, {"exact", gl::SphereFormula::exact}, {"printed", gl::SphereFormula::printed}};
constexpr Word<gl::InsideSphere> kInsideWords[] = {{"faded", gl::InsideSphere::faded},
                                                   {"nothing", gl::InsideSphere::nothing},
                                                   {"everything", gl::InsideSphere::everything}};
// An infinite AO radius is for the far half alone: the near one then takes its share of this part of the diagonal.
constexpr double kShareOfDiagonal = 0.05;

const Setting& halves_setting() {
  static const Setting setting =
      word_setting("halves", "Spheres of the pixels around a receiver (near), of the scene (far), or both",
                   kHalvesWords, Halves::both);
  return setting;
}

const Setting& near_share_setting() {
  static const Setting setting{
      .name = "near-share",
      .help =
          "With both halves, r_far of the near one, and where the far one begins: a share of the AO radius, or of "
          "5% of the scene's diagonal where that is infinite. The near half alone takes all of it",
      .values = Range{0.001, 1},
      .default_text = "0.25"};
  return setting;
}

const Setting& layers_setting() {
  static const Setting setting = word_setting(
      "layers", "Surfaces behind each other at a pixel that the near half looks at, by casting rays", kLayerWords, 2);
  return setting;
}

const Setting& near_samples_setting() {
  static const Setting setting{
      .name = "near-samples",
      .help = "Pixels that the near half looks at, at most; the sum is scaled to stand for all",
      .values = Range{1, 16384, true},
      .default_text = "64"};
  return setting;
}

const Setting& near_rate_setting() {
  static const Setting setting{.name = "near-rate",
                               .help = "How many for each pixel that r_far is long on the screen",
                               .values = Range{0, 1e6},
                               .default_text = "4"};
  return setting;
}

const Setting& near_density_setting() {
  static const Setting setting =
      word_setting("near-density", "Where they lie: everywhere as often, as the paper has it, or mostly near by",
                   kDensityWords, gl::SampleDensity::falling);
  return setting;
}

const Setting& pixel_sphere_setting() {
  static const Setting setting{.name = "pixel-sphere",
                               .help = "Radius of the sphere of a pixel, in widths of the pixel at its distance",
                               .values = Range{0.01, 16},
                               .default_text = "0.5"};
  return setting;
}

const Setting& spheres_setting() {
  static const Setting setting{.name = "spheres",
                               .help = "Spheres that stand for the scene in the far half, at most",
                               .values = Range{1, 1e6, true},
                               .default_text = "4096"};
  return setting;
}

const Setting& rounds_setting() {
  static const Setting setting{.name = "lloyd-rounds",
                               .help = "Rounds of Lloyd's algorithm that finds them",
                               .values = Range{0, 1000, true},
                               .default_text = "10"};
  return setting;
}

const Setting& edge_epsilon_setting() {
  static const Setting setting{.name = "epsilon",
                               .help = "What a sphere of the far half blocks where it ends; this says how far that is",
                               .values = Range{1e-6, 1},
                               .default_text = "0.01"};
  return setting;
}

const Setting& formula_setting() {
  static const Setting setting = word_setting(
      "formula", "What a sphere blocks: the paper's cap over pi, as rays have it (exact), or the cap as printed",
      kFormulaWords, gl::SphereFormula::cap);
  return setting;
}

const Setting& inside_setting() {
  static const Setting setting =
      word_setting("inside",
                   "What a sphere of the far half blocks of receivers inside of it: nothing, to which it fades from "
                   "three radii on; nothing; or, as the paper has it, everything",
                   kInsideWords, gl::InsideSphere::faded);
  return setting;
}

Abilities splat_abilities(const Settings&) {
  return {.masks = false,
          .bent_normals = false,
          .levels = false,
          .any_receivers = false,
          .min_distance = false,
          .one_sided = false,
          .uniform_weighting = false,
          .linear_falloff = false,
          .other_falloffs = false};
}

double diagonal_of(const scene::Mesh& mesh) {
  const Bounds box = scene::bounds_of(mesh);
  const double diagonal = glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper));
  return diagonal > 0 && std::isfinite(diagonal) ? diagonal : 1;
}

class Splat : public Method {
 public:
  explicit Splat(const Settings& settings)
      : Method(splat_abilities(settings)),
        halves_(settings.value(halves_setting(), kHalvesWords)),
        layer_count_(settings.value(layers_setting(), kLayerWords)),
        near_share_(settings.number(near_share_setting())),
        sphere_options_(
            {.count = whole(settings, spheres_setting()), .iteration_count = whole(settings, rounds_setting())}),
        splatter_(prepare_device(settings)) {
    options_.near_half = halves_ != Halves::far_half;
    options_.far_half = halves_ != Halves::near_half;
    options_.samples_per_pixel = static_cast<float>(settings.number(near_rate_setting()));
    options_.density = settings.value(near_density_setting(), kDensityWords);
    options_.max_sample_count = whole(settings, near_samples_setting());
    options_.pixel_sphere_radius = static_cast<float>(settings.number(pixel_sphere_setting()));
    options_.epsilon = static_cast<float>(settings.number(edge_epsilon_setting()));
    options_.formula = settings.value(formula_setting(), kFormulaWords);
    options_.inside = settings.value(inside_setting(), kInsideWords);
  }

  std::string device() const override { return device_text(splatter_.context()); }
  void require_size(int width, int height) const override { raster::require_texture_size(width, height); }

  void prepare(const Task& task) override {
    const scene::Mesh& mesh = task.occluders.mesh();
    const View& view = task.view.value();
    set_radius(task.question.radius, mesh);
    options_.seed = static_cast<std::uint32_t>(task.question.seed);
    const Stopwatch watch;
    std::vector<glm::vec4> spheres;
    if (options_.far_half) spheres = lod::MeshSpheres(mesh.view(), sphere_options_).at(mesh.positions);
    build_seconds_ = watch.seconds();
    sphere_count_ = spheres.size();
    splatter_.pass().set_spheres(spheres);
    std::optional<scene::ReceiverImage> behind;
    if (options_.near_half && layer_count_ == 2) behind = scene::find_behind(mesh, view.camera, view.image);
    splatter_.set_view(view.camera, view.image, behind);
  }

  double build_seconds() const override { return build_seconds_; }

  Answered answer(std::span<const Receiver>, const QueryOutputs& outputs, std::uint64_t) override {
    times_ = draw_repeatedly([&] { return splatter_.draw(options_); });
    const std::vector<float> occlusion = splatter_.read_occlusion();
    copy_frame(occlusion, outputs.occlusion);
    fragment_count_ = splatter_.pass().read_fragment_count();
    pixel_count_ = occlusion.size();
    return {count_receivers(occlusion, 0), times_.seconds};
  }

  Remarks remarks() const override {
    const double fragments = static_cast<double>(fragment_count_) / static_cast<double>(pixel_count_);
    const double milliseconds = 1000 * times_.seconds;
    Remarks remarks;
    remarks.keys["halves"] = word_of(kHalvesWords, halves_);
    if (options_.near_half) add_near_keys(remarks.keys);
    if (options_.far_half) add_far_keys(remarks.keys, fragments);
    remarks.keys["formula"] = word_of(kFormulaWords, options_.formula);
    nlohmann::ordered_json gl = device_keys(splatter_.context());
    gl["draw_milliseconds"] = milliseconds;
    gl["draw_count"] = times_.frame_count;
    remarks.keys["gl"] = gl;
    remarks.rows.emplace_back("OpenGL", device());
    if (options_.near_half) {
      remarks.rows.emplace_back("near half",
                                fmt::format("up to {:.4g}, at most {} of its pixels, layers: {}", options_.near_radius,
                                            options_.max_sample_count, layer_count_));
    }
    if (options_.far_half) {
      remarks.rows.emplace_back(
          "far half", fmt::format("{} spheres in {:.3f} s, epsilon {:g}, {:.1f} fragments a pixel", sphere_count_,
                                  build_seconds_, options_.epsilon, fragments));
    }
    remarks.rows.emplace_back("frame", fmt::format("{:.2f} ms, median of {}", milliseconds, times_.frame_count));
    return remarks;
  }

 private:
  void set_radius(float radius, const scene::Mesh& mesh) {
    const double length = std::isinf(radius) ? kShareOfDiagonal * diagonal_of(mesh) : double{radius};
    options_.near_radius = static_cast<float>(halves_ == Halves::both ? near_share_ * length : length);
    options_.far_radius = radius;
  }

  void add_near_keys(nlohmann::ordered_json& keys) const {
    keys["near"] = {{"radius", options_.near_radius},
                    {"layers", layer_count_},
                    {"samples", options_.max_sample_count},
                    {"rate", options_.samples_per_pixel},
                    {"density", word_of(kDensityWords, options_.density)},
                    {"pixel_sphere", options_.pixel_sphere_radius}};
  }

  void add_far_keys(nlohmann::ordered_json& keys, double fragments) const {
    keys["far"] = {{"spheres", sphere_count_},
                   {"lloyd_rounds", sphere_options_.iteration_count},
                   {"epsilon", options_.epsilon},
                   {"reach", gl::sphere_reach(options_.epsilon, options_.formula)},
                   {"inside", word_of(kInsideWords, options_.inside)},
                   {"fragments_per_pixel", fragments}};
  }

  Halves halves_;
  int layer_count_;
  double near_share_;
  lod::SphereOptions sphere_options_;
  raster::Splatter splatter_;
  gl::SplatOptions options_;
  double build_seconds_ = 0;
  std::size_t sphere_count_ = 0, pixel_count_ = 1;
  std::uint64_t fragment_count_ = 0;
  FrameTimes times_;
};

}  // namespace

MethodKind splat_kind() {
  return {
      .summary = "OpenGL, spheres of the pixels and of the scene",
      .settings = {&device_setting(), &halves_setting(), &near_share_setting(), &layers_setting(),
                   &near_samples_setting(), &near_rate_setting(), &near_density_setting(), &pixel_sphere_setting(),
                   &spheres_setting(), &rounds_setting(), &edge_epsilon_setting(), &formula_setting(),
                   &inside_setting()},
      .abilities = splat_abilities,
      .open = [](const Settings& settings) -> std::unique_ptr<Method> { return std::make_unique<Splat>(settings); }};
}

}  // namespace lkao::method
