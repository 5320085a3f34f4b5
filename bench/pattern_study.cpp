// How far sample patterns are from the integral: kinds, ray counts, falloffs, and how they are turned.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "image/image.h"
#include "options.h"
#include "pattern_errors.h"
#include "pattern_image.h"
#include "program.h"
#include "study_scenes.h"

namespace lkao::bench {
namespace {

struct Row {
  std::string scene;
  PatternError error;
};
using Rows = std::vector<Row>;
using Test = std::function<bool(const PatternError&)>;
using Value = std::function<double(const PatternError&)>;

struct Options {
  StudySceneOptions scenes;
  PatternStudyOptions study;
  int receiver_count = 2048;
  std::string csv;
  std::string image;
  std::string image_scene = "atrium";
};

constexpr PatternKind kKinds[] = {PatternKind::lloyd, PatternKind::paper, PatternKind::fibonacci, PatternKind::sobol,
                                  PatternKind::random};
constexpr int kRayCounts[] = {64, 128, 256, 512, 1024};
// Without --views and --scenes.
const std::vector<std::string> kBuiltIn = {"atrium", "city", "hairball", "wall", "sphere"};
constexpr Jitter kPlainJitter{.rotation = 1, .tilt = 0};

bool is_plain(const Jitter& jitter) {
  return jitter.rotation == kPlainJitter.rotation && jitter.tilt == kPlainJitter.tilt;
}

std::vector<Jitter> study_jitters() {
  std::vector<Jitter> jitters;
  for (float rotation : {1.0f, 0.125f, 0.0f}) {
    for (float tilt : {0.0f, 0.02f, 0.05f}) jitters.push_back({rotation, tilt});
  }
  return jitters;
}

std::vector<PatternCase> study_cases() {
  std::vector<PatternCase> cases;
  for (PatternKind kind : kKinds) {
    for (int ray_count : kRayCounts) cases.push_back({kind, ray_count, kPlainJitter});
  }
  for (const Jitter& jitter : study_jitters()) {
    if (is_plain(jitter)) continue;
    for (int ray_count : {128, 1024}) cases.push_back({PatternKind::lloyd, ray_count, jitter});
  }
  return cases;
}

// Neighbouring pixels two by two, evenly over the picture.
std::vector<Receiver> choose_pairs(const std::vector<Receiver>& pixels, int receiver_count) {
  const std::size_t pair_count = std::min(pixels.size(), static_cast<std::size_t>(receiver_count)) / 2;
  std::vector<Receiver> chosen;
  for (std::size_t pair = 0; pair < pair_count; ++pair) {
    const std::size_t first = pair * (pixels.size() - 1) / pair_count;
    chosen.push_back(pixels[first]);
    chosen.push_back(pixels[first + 1]);
  }
  return chosen;
}

Rows measure(const Options& options) {
  Rows rows;
  const std::vector<PatternCase> cases = study_cases();
  for (const StudyScene& scene : load_study_scenes(options.scenes)) {
    const std::vector<Receiver> receivers = choose_pairs(scene.receivers, options.receiver_count);
    fmt::print(stderr, "{}: {} receivers, radius {}\n", scene.name, receivers.size(), scene.radii.back());
    for (const PatternError& error :
         measure_pattern_errors(scene.mesh, scene.radii.back(), receivers, cases, options.study)) {
      rows.push_back({scene.name, error});
    }
  }
  return rows;
}

void write_csv(const std::string& path, const Rows& rows) {
  std::ofstream file(path);
  file << "scene,pattern,falloff,rays,rotation,tilt,rmse,bias,neighbour_correlation,independent_rmse\n";
  for (const auto& [scene, e] : rows) {
    fmt::print(file, "{},{},{},{},{},{},{:.6g},{:.3g},{:.3f},{:.6g}\n", scene, pattern_kind_name(e.what.kind),
               e.falloff, e.what.ray_count, e.what.jitter.rotation, e.what.jitter.tilt, e.rmse, e.bias,
               e.neighbour_correlation, e.independent_rmse);
  }
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

Test is_case(PatternKind kind, int ray_count, const std::string& falloff, const Jitter& jitter = kPlainJitter) {
  return [=](const PatternError& e) {
    return e.what.kind == kind && e.what.ray_count == ray_count && e.falloff == falloff &&
           e.what.jitter.rotation == jitter.rotation && e.what.jitter.tilt == jitter.tilt;
  };
}

double rmse(const PatternError& e) { return e.rmse; }
double independent_rmse(const PatternError& e) { return e.independent_rmse; }

// Over scenes. Those without any error (an open plane) say nothing.
double geometric_mean(const Rows& rows, const Test& test, const Value& value) {
  double sum = 0;
  int count = 0;
  for (const auto& [scene, e] : rows) {
    if (!test(e) || value(e) <= 0) continue;
    sum += std::log(value(e));
    ++count;
  }
  return std::exp(sum / count);
}

double mean(const Rows& rows, const Test& test, const Value& value) {
  double sum = 0;
  int count = 0;
  for (const auto& [scene, e] : rows) {
    if (test(e)) sum += value(e), ++count;
  }
  return sum / count;
}

double largest_bias(const Rows& rows, const Test& test) {
  double largest = 0;
  for (const auto& [scene, e] : rows) {
    if (test(e) && std::abs(e.bias) > std::abs(largest)) largest = e.bias;
  }
  return largest;
}

void print_kinds(const Rows& rows, const std::string& falloff) {
  fmt::print("\nFalloff {}: RMSE relative to Owen-scrambled Sobol, geometric mean over scenes (largest bias)\n\n",
             falloff);
  fmt::print("| pattern |");
  for (int ray_count : kRayCounts) fmt::print(" {} rays |", ray_count);
  fmt::print("\n|---|---|---|---|---|---|\n");
  for (PatternKind kind : kKinds) {
    fmt::print("| {} |", pattern_kind_name(kind));
    for (int ray_count : kRayCounts) {
      const Test test = is_case(kind, ray_count, falloff);
      const double sobol = geometric_mean(rows, is_case(PatternKind::sobol, ray_count, falloff), rmse);
      fmt::print(" {:.3f} ({:+.4f}) |", geometric_mean(rows, test, rmse) / sobol, largest_bias(rows, test));
    }
    fmt::print("\n");
  }
}

void print_scenes(const Rows& rows) {
  for (int ray_count : {128, 1024}) {
    fmt::print("\nFalloff constant, {} rays: RMSE (bias)\n\n| scene |", ray_count);
    for (PatternKind kind : kKinds) fmt::print(" {} |", pattern_kind_name(kind));
    fmt::print(" independent rays |\n|---|---|---|---|---|---|---|\n");
    std::string last;
    for (const auto& row : rows) {
      if (row.scene == last) continue;
      last = row.scene;
      fmt::print("| {} |", row.scene);
      double independent = 0;
      for (PatternKind kind : kKinds) {
        const Test test = is_case(kind, ray_count, "constant");
        const auto found =
            std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.scene == last && test(r.error); });
        fmt::print(" {:.5f} ({:+.5f}) |", found->error.rmse, found->error.bias);
        independent = found->error.independent_rmse;
      }
      fmt::print(" {:.5f} |\n", independent);
    }
  }
}

void print_falloffs(const Rows& rows) {
  fmt::print("\nDefault pattern against the integral with closest hits; geometric means over scenes\n\n");
  fmt::print(
      "| falloff | rays | RMSE | of as many independent rays | independent rays for the same error | largest bias |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (const Falloff& falloff : study_falloffs()) {
    for (int ray_count : kRayCounts) {
      const Test test = is_case(PatternKind::lloyd, ray_count, falloff.name());
      const double own = geometric_mean(rows, test, rmse);
      const double independent = geometric_mean(rows, test, independent_rmse);
      fmt::print("| {} | {} | {:.5f} | {:.5f} | {:.0f} | {:+.5f} |\n", falloff.name(), ray_count, own, independent,
                 ray_count * (independent / own) * (independent / own), largest_bias(rows, test));
    }
  }
}

void print_jitters(const Rows& rows) {
  fmt::print("\nDefault pattern, falloff constant, by rotation and tilt (the tilt is cut short at the lowest ray)\n\n");
  fmt::print("| rays | rotation, turns | tilt | RMSE | largest bias | correlation of neighbours' errors |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  for (int ray_count : {128, 1024}) {
    for (const Jitter& jitter : study_jitters()) {
      const Test test = is_case(PatternKind::lloyd, ray_count, "constant", jitter);
      fmt::print("| {} | {} | {} | {:.5f} | {:+.5f} | {:+.2f} |\n", ray_count, jitter.rotation, jitter.tilt,
                 geometric_mean(rows, test, rmse), largest_bias(rows, test),
                 mean(rows, test, [](const PatternError& e) { return e.neighbour_correlation; }));
    }
  }
}

void print_generation_times() {
  using Clock = std::chrono::steady_clock;
  const auto milliseconds = [](const auto& make) {
    const auto start = Clock::now();
    make();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  };
  fmt::print("\nTime to make a pattern, in ms\n\n| pattern | 128 rays | 1024 rays |\n|---|---|---|\n");
  for (PatternKind kind : kKinds) {
    fmt::print("| {} |", pattern_kind_name(kind));
    for (int ray_count : {128, 1024}) {
      fmt::print(" {:.1f} |", milliseconds([&] { (void)SamplePattern::make(kind, ray_count); }));
    }
    fmt::print("\n");
  }
  fmt::print("| lengths, first falloff |");
  for (int ray_count : {128, 1024}) {
    const SamplePattern pattern = SamplePattern::make(PatternKind::fibonacci, ray_count);
    fmt::print(" {:.1f} |", milliseconds([&] { (void)pattern.with_falloff(Falloff::linear()); }));
  }
  fmt::print("\n");
}

void study(const Options& options) {
  const Rows rows = measure(options);
  if (!options.csv.empty()) write_csv(options.csv, rows);
  for (const Falloff& falloff : study_falloffs()) print_kinds(rows, falloff.name());
  print_scenes(rows);
  print_falloffs(rows);
  print_jitters(rows);
  print_generation_times();
}

int run(int argc, char** argv) {
  Options options;
  options.scenes.width = 1024;
  options.scenes.height = 768;
  CLI::App app("Errors of sample patterns against the integral with closest hits.", "lkao_bench_patterns");
  add_scene_options(app, options.scenes, fmt::format("{}", fmt::join(kBuiltIn, ", ")));
  app.add_option("--receivers", options.receiver_count, "receivers a scene")->check(CLI::Range(2, 1 << 20));
  app.add_option("--reference-rays", options.study.reference_ray_count)->check(CLI::Range(64, 1 << 20));
  app.add_option("--seeds", options.study.seed_count, "patterns of each kind")->check(CLI::Range(1, 100));
  add_csv_option(app, options.csv);
  app.add_option("--image", options.image, "only write a picture of every pattern at work (.png, .exr)");
  app.add_option("--image-scene", options.image_scene, "built-in scene of the picture");
  return run_program(app, argc, argv, [&] {
    if (options.scenes.views.empty() && options.scenes.names.empty()) {
      options.scenes.names = kBuiltIn;
    }
    if (options.image.empty()) {
      study(options);
    } else {
      image::write_image(options.image, pattern_image(options.image_scene));
    }
    return 0;
  });
}

}  // namespace
}  // namespace lkao::bench

int main(int argc, char** argv) { return lkao::bench::run(argc, argv); }
