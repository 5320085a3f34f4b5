// lkao-bench bake: how far interpolated values of vertices are from occlusion all over the faces.
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bake/corner_receivers.h"
#include "bake/face_samples.h"
#include "bake/least_squares.h"
#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/options.h"
#include "lkao/lkao.h"
#include "method/stopwatch.h"
#include "scene/defects.h"
#include "scene/facet.h"
#include "scene/load.h"
#include "scene/radius.h"

namespace lkao::bench {
namespace {

using bake::FaceSamples, bake::Per, bake::Places;

struct BakeOptions {
  std::vector<std::string> scenes;
  int ray_count = 256;
  std::vector<double> smoothness = {0, 0.01, 0.1};
  std::string csv;
};

constexpr int kTruthRayCount = 1024;
// Of the truth: places at random, none of them one that a fit has seen.
constexpr bake::SampleDensity kTruthDensity{.per_triangle = 8, .least_rows = 1, .most_rows = 32, .seed = 1};

Columns bake_csv_columns() {
  return {{"scene"},         {"triangles"},          {"vertices"}, {"radius", "{:g}"},    {"values"},
          {"per"},           {"smoothness", "{:g}"}, {"rays"},     {"seconds", "{:.3g}"}, {"rmse", "{:.4f}"},
          {"mae", "{:.4f}"}, {"bias", "{:.4f}"}};
}

Columns bake_table_columns() {
  return {{"scene", "{}", -16},
          {"triangles", "{}", 9},
          {"radius", "{:g}", 7},
          kBar,
          {"values", "{}", -14},
          {"per", "{}", -6},
          {"smoothness", "{:g}", 6, "smooth"},
          {"rays", "{}", 10},
          {"seconds", "{:.2f}", 7},
          kBar,
          {"rmse", "{:.4f}", 7, "RMSE"},
          {"mae", "{:.4f}", 7, "MAE"},
          {"bias", "{:+.4f}", 8}};
}

// The values of corners: interpolated over triangles they stand for the occlusion of the surface.
struct Baked {
  const char* values;
  const char* per;
  Value smoothness;
  Places places;
  std::vector<float> of_places;
  std::size_t receiver_count;
  double seconds;
};

struct BakeErrors {
  double rmse = 0, mae = 0, bias = 0;
};

class BakeStudy {
 public:
  BakeStudy(const std::string& scene, const BakeOptions& options)
      : options_(options),
        name_(scene.substr(scene.find_last_of("/:") + 1)),
        mesh_(load(scene)),
        bounds_(scene::bounds_of(mesh_)),
        radius_(scene::suggest_radii(bounds_).large),
        occluders_(mesh_.view()) {}

  void run(CsvFile& csv, const Columns& columns) {
    const scene::CornerNormals normals(mesh_, scene::usual_normals(mesh_));
    truth_ = bake::sample_faces(normals, kTruthDensity);
    truth_occlusion_ = ask(truth_.receivers, kTruthRayCount);
    report(at_vertices(), csv, columns);
    for (const Per per : {Per::vertex, Per::corner}) {
      report(at_corners(normals, per), csv, columns);
      for (const double smoothness : options_.smoothness) report(fit(normals, per, smoothness), csv, columns);
    }
  }

 private:
  static scene::Mesh load(const std::string& scene) {
    scene::Mesh mesh = scene::load(scene);
    scene::drop_bad_triangles(mesh);
    return mesh;
  }

  static const char* word_of(Per per) { return per == Per::vertex ? "vertex" : "corner"; }

  std::vector<float> ask(const std::vector<Receiver>& receivers, int ray_count) const {
    const AmbientOcclusion ao(occluders_, SamplePattern::standard(ray_count), {.radius = radius_});
    std::vector<float> occlusion(receivers.size());
    ao.query(receivers, {.occlusion = occlusion});
    return occlusion;
  }

  // What a receiver on the vertex itself sees, along the mean normal of its triangles.
  Baked at_vertices() const {
    const method::Stopwatch watch;
    const std::vector<glm::vec3> normals = scene::vertex_normals(mesh_);
    std::vector<Receiver> receivers;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      receivers.push_back({.position = mesh_.positions[i], .normal = normals[i]});
    }
    Places places{.of_corner = mesh_.triangles, .count = receivers.size()};
    std::vector<float> values = ask(receivers, options_.ray_count);
    return {"on-vertex", "vertex", {}, std::move(places), std::move(values), receivers.size(), watch.seconds()};
  }

  Baked at_corners(const scene::CornerNormals& normals, Per per) const {
    const method::Stopwatch watch;
    Places places = bake::make_places(normals, per);
    const std::vector<Receiver> receivers = bake::corner_receivers(normals, bounds_);
    std::vector<float> values = bake::average_at_places(mesh_, places, ask(receivers, options_.ray_count), bounds_);
    return {"corners", word_of(per), {}, std::move(places), std::move(values), receivers.size(), watch.seconds()};
  }

  Baked fit(const scene::CornerNormals& normals, Per per, double smoothness) const {
    const method::Stopwatch watch;
    Places places = bake::make_places(normals, per);
    const FaceSamples samples = bake::sample_faces(normals);
    std::vector<float> values = bake::least_squares_values(
        mesh_, places, samples, ask(samples.receivers, options_.ray_count), {.smoothness = smoothness});
    return {"least-squares",          word_of(per),   smoothness, std::move(places), std::move(values),
            samples.receivers.size(), watch.seconds()};
  }

  // Over the surface; a vertex without a value counts as open, as in a written mesh.
  BakeErrors errors_of(const Baked& baked) const {
    double area = 0, square = 0, absolute = 0, sum = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::uint32_t first = truth_.firsts[t], end = truth_.firsts[t + 1];
      const double weight = scene::Facet(mesh_, mesh_.triangles[t]).area() / (end - first);
      for (std::uint32_t i = first; i < end; ++i) {
        double value = 0;
        for (int corner = 0; corner < 3; ++corner) {
          const float at_corner = baked.of_places[baked.places.of_corner[t][corner]];
          if (!std::isnan(at_corner)) value += truth_.weights[i][corner] * static_cast<double>(at_corner);
        }
        const double error = value - static_cast<double>(truth_occlusion_[i]);
        area += weight;
        square += weight * error * error;
        absolute += weight * std::abs(error);
        sum += weight * error;
      }
    }
    return {std::sqrt(square / area), absolute / area, sum / area};
  }

  void report(const Baked& baked, CsvFile& csv, const Columns& columns) const {
    const BakeErrors errors = errors_of(baked);
    const auto ray_count = baked.receiver_count * static_cast<std::size_t>(options_.ray_count);
    const Measurement measurement = {{"scene", name_},
                                     {"triangles", mesh_.triangles.size()},
                                     {"vertices", mesh_.positions.size()},
                                     {"radius", radius_},
                                     {"values", baked.values},
                                     {"per", baked.per},
                                     {"smoothness", baked.smoothness},
                                     {"rays", ray_count},
                                     {"seconds", baked.seconds},
                                     {"rmse", errors.rmse},
                                     {"mae", errors.mae},
                                     {"bias", errors.bias}};
    csv.write(measurement);
    fmt::print("{}", table_row(columns, measurement));
    std::fflush(stdout);
  }

  const BakeOptions& options_;
  std::string name_;
  scene::Mesh mesh_;
  Bounds bounds_;
  float radius_;
  OccluderBvh occluders_;
  FaceSamples truth_;
  std::vector<float> truth_occlusion_;
};

void run(const BakeOptions& options) {
  CsvFile csv(options.csv, bake_csv_columns());
  const Columns columns = bake_table_columns();
  bool has_heading = false;
  for (const std::string& scene : options.scenes) {
    BakeStudy study(scene, options);
    if (!std::exchange(has_heading, true)) fmt::print("{}", table_heading(columns));
    study.run(csv, columns);
  }
}

}  // namespace

Command add_bake_command(CLI::App& program) {
  auto options = std::make_shared<BakeOptions>();
  CLI::App* app = program.add_subcommand(
      "bake", "Values of vertices against occlusion all over the faces, at the large radius that suits each scene.");
  app->add_option("scenes", options->scenes, "mesh files or builtin:NAME")->required();
  app->add_option("--rays", options->ray_count, "of a receiver; the truth has 1024")
      ->check(CLI::Range(kMinRayCount, kMaxRayCount))
      ->capture_default_str();
  app->add_option("--smoothness", options->smoothness, "of the least-squares fit")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_csv_option(*app, options->csv);
  return {app, [options] {
            run(*options);
            return 0;
          }};
}

}  // namespace lkao::bench
