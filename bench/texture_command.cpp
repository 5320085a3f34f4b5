// lkao-bench texture: a map of occlusion, and the same rays through Embree.
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bake/texture.h"
#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/embree_modes.h"
#include "bench/options.h"
#include "bench/unwrapped.h"
#include "lkao/lkao.h"
#include "method/median.h"
#include "method/stopwatch.h"
#include "reference/embree_reference.h"
#include "reference/embree_scene.h"
#include "scene/defects.h"
#include "scene/load.h"
#include "scene/radius.h"

namespace lkao::bench {
namespace {

struct TextureStudyOptions {
  std::vector<std::string> scenes;
  int size = 2048;
  int ray_count = 256;
  std::size_t share = 1;  // every so manieth tile
  bool is_alone = false;
  std::string csv;
};

Columns texture_columns() {
  return {{"scene", "{}", -10},
          {"triangles", "{}", 9},
          {"radius", "{:g}", 7},
          {"size", "{}", 5},
          {"rays", "{}", 5},
          {"tiles_of", "{}", 8},
          {"texels", "{}", 9},
          {"receivers", "{}", 9},
          {"method", "{}", -30},
          {"seconds", "{:.4g}", 8},
          {"mrays_per_second", "{:.4g}", 8, "Mrays/s"},
          {"lkao_is_faster_by", "{:.3g}", 8, "lkao x"},
          {"ray_mismatch_rate", "{:.3g}", 9, "mismatch"},
          {"other_seconds", "{:.3g}", 8, "other s"},
          {"finish_seconds", "{:.3g}", 8, "finish s"},
          {"worst_seam_before", "{:.4f}", 8, "seam"},
          {"worst_seam_after", "{:.4f}", 8, "levelled"},
          {"peak_mib", "{}", 8, "peak MiB"}};
}

// One way to the answers, and how long each batch of them took.
struct TextureRival {
  std::string name;
  // Masks; occlusion as well, but for Embree.
  std::function<void(std::span<const Receiver>, const QueryOutputs&, std::uint64_t)> answer;
  std::vector<double> seconds = {};
  std::uint64_t mismatch_count = 0;

  double total() const {
    double sum = 0;
    for (const double of_batch : seconds) sum += of_batch;
    return sum;
  }
};

scene::Mesh load_textured(const std::string& name, int size) {
  scene::MeshFile file = scene::open(name, {.origin = {}, .uv_set = 0});
  scene::drop_bad_triangles(file.mesh);
  if (file.mesh.uv_corners.empty()) unwrap(file.mesh, size);
  return std::move(file.mesh);
}

std::int64_t peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

class TextureStudy {
 public:
  TextureStudy(const std::string& scene, const TextureStudyOptions& options)
      : options_(options),
        name_(scene.substr(scene.find_last_of("/:") + 1)),
        mesh_(load_textured(scene, options.size)),
        bounds_(scene::bounds_of(mesh_)),
        radius_(scene::suggest_radii(bounds_).large),
        ao_(OccluderBvh(mesh_.view()), SamplePattern::standard(options.ray_count), {.radius = radius_}) {
    rivals_.push_back({"lkao", [this](auto receivers, const QueryOutputs& outputs, std::uint64_t first_index) {
                         ray_count_ += ao_.query(receivers, outputs, first_index).ray_count;
                       }});
    if (!options.is_alone) add_embree();
  }

  void run(CsvFile& csv, const Columns& columns) {
    const scene::CornerNormals normals(mesh_, scene::usual_normals(mesh_));
    const bake::TextureOptions texture{.width = options_.size, .height = options_.size};
    const method::Stopwatch watch;
    bake::TextureBake baked = bake::bake_texels(
        normals, bounds_, texture, [this](auto... arguments) { answer(arguments...); }, {0, options_.share});
    const double other_seconds = watch.seconds() - ask_seconds_;
    method::Stopwatch finish_watch;
    bake::finish_texture(normals, texture, baked);
    const double finish_seconds = finish_watch.seconds();
    for (const TextureRival& rival : rivals_) {
      const bool is_lkao = &rival == rivals_.data();
      const Measurement measurement = {
          {"scene", name_},
          {"triangles", mesh_.triangles.size()},
          {"radius", radius_},
          {"size", options_.size},
          {"rays", options_.ray_count},
          {"tiles_of", options_.share},
          {"texels", baked.report.covered_texel_count},
          {"receivers", baked.report.receiver_count},
          {"method", rival.name},
          {"seconds", rival.total()},
          {"mrays_per_second", static_cast<double>(ray_count_) / rival.total() / 1e6},
          {"lkao_is_faster_by", is_lkao ? Value() : Value(slower_by(rival))},
          {"ray_mismatch_rate",
           oracle_ ? Value(static_cast<double>(rival.mismatch_count) / static_cast<double>(ray_count_)) : Value()},
          {"other_seconds", is_lkao ? Value(other_seconds) : Value()},
          {"finish_seconds", is_lkao ? Value(finish_seconds) : Value()},
          // Between tiles of which one is missing there is nothing to compare.
          {"worst_seam_before", is_lkao && options_.share == 1 ? Value(baked.report.worst_seam_before) : Value()},
          {"worst_seam_after", is_lkao && options_.share == 1 ? Value(baked.report.worst_seam_after) : Value()},
          {"peak_mib", is_lkao && options_.is_alone ? Value(peak_mib()) : Value()}};
      csv.write(measurement);
      fmt::print("{}", table_row(columns, measurement));
    }
    std::fflush(stdout);
  }

 private:
  void add_embree() {
    embree_ = std::make_unique<reference::EmbreeScene>(mesh_.view(), false);
    oracle_ = std::make_unique<reference::EmbreeReference>(mesh_);
    using scene::embree::Order;
    for (const EmbreeMode mode : {EmbreeMode{1, Order::incoherent}, EmbreeMode{16, Order::incoherent},
                                  EmbreeMode{16, Order::coherent, Packing::receivers}}) {
      rivals_.push_back(
          {mode.name(), [this, mode](auto receivers, const QueryOutputs& outputs, std::uint64_t first_index) {
             const auto make = [&](std::size_t k, ReceiverRays& rays) {
               ao_.rays(receivers[k], first_index + k, rays);
             };
             cast(mode, embree_->plain(), {receivers.size(), options_.ray_count, make}, outputs.mask_words);
           }});
    }
  }

  // In turn, every time beginning with another one.
  void answer(std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index) {
    const method::Stopwatch watch;
    const std::size_t word_count = receivers.size() * static_cast<std::size_t>(word_count_of(options_.ray_count));
    std::vector<std::uint64_t> masks(word_count), expected(oracle_ ? word_count : 0);
    if (oracle_) oracle_->query(ao_, receivers, {.mask_words = expected}, first_index);
    for (std::size_t i = 0; i < rivals_.size(); ++i) {
      TextureRival& rival = rivals_[(i + batch_count_) % rivals_.size()];
      const method::Stopwatch rival_watch;
      rival.answer(receivers, {.occlusion = outputs.occlusion, .mask_words = masks}, first_index);
      rival.seconds.push_back(rival_watch.seconds());
      if (oracle_) rival.mismatch_count += reference::count_mismatched_rays(masks, expected);
    }
    ++batch_count_;
    ask_seconds_ += watch.seconds();
  }

  // The median over the batches.
  double slower_by(const TextureRival& rival) const {
    std::vector<double> ratios;
    ratios.reserve(rival.seconds.size());
    for (std::size_t i = 0; i < rival.seconds.size(); ++i) {
      ratios.push_back(rival.seconds[i] / rivals_[0].seconds[i]);
    }
    return method::median(std::move(ratios));
  }

  const TextureStudyOptions& options_;
  std::string name_;
  scene::Mesh mesh_;
  Bounds bounds_;
  float radius_;
  AmbientOcclusion ao_;
  std::unique_ptr<reference::EmbreeScene> embree_;
  std::unique_ptr<reference::EmbreeReference> oracle_;
  std::vector<TextureRival> rivals_;
  std::size_t batch_count_ = 0;
  std::uint64_t ray_count_ = 0;
  double ask_seconds_ = 0;
};

void run(const TextureStudyOptions& options) {
  CsvFile csv(options.csv, texture_columns());
  const Columns columns = texture_columns();
  bool has_heading = false;
  for (const std::string& scene : options.scenes) {
    TextureStudy study(scene, options);
    if (!std::exchange(has_heading, true)) fmt::print("{}", table_heading(columns));
    study.run(csv, columns);
  }
}

}  // namespace

Command add_texture_command(CLI::App& program) {
  auto options = std::make_shared<TextureStudyOptions>();
  CLI::App* app = program.add_subcommand(
      "texture",
      "A map of occlusion at the large radius that suits each scene, lkao and Embree in turn, batch by batch. A scene "
      "without texture coordinates gets some.");
  app->add_option("scenes", options->scenes, "mesh files or builtin:NAME")->required();
  app->add_option("--size", options->size, "of the map, texels each way")
      ->check(CLI::Range(1, bake::kMaxTextureSize))
      ->capture_default_str();
  app->add_option("--rays", options->ray_count, "of a receiver")
      ->check(CLI::Range(kMinRayCount, kMaxRayCount))
      ->capture_default_str();
  app->add_option("--tiles-of", options->share, "bake one of so many tiles of the map")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app->add_flag("--alone", options->is_alone, "without Embree: for the memory that a bake takes");
  add_csv_option(*app, options->csv);
  return {app, [options] {
            run(*options);
            return 0;
          }};
}

}  // namespace lkao::bench
