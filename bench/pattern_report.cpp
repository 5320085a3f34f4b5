#include "bench/pattern_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "bench/geometric_mean.h"
#include "bench/pattern_cases.h"
#include "method/stopwatch.h"

namespace lkao::bench {
namespace {

using Rows = std::vector<PatternRow>;
using Test = std::function<bool(const PatternError&)>;
using Number = std::function<double(const PatternError&)>;

Test is_case(PatternKind kind, int ray_count, const std::string& falloff, const Jitter& jitter = kPlainJitter) {
  return [=](const PatternError& e) {
    return e.what.kind == kind && e.what.ray_count == ray_count && e.falloff == falloff &&
           e.what.jitter.rotation == jitter.rotation && e.what.jitter.tilt == jitter.tilt;
  };
}

double rmse(const PatternError& e) { return e.rmse; }
double independent_rmse(const PatternError& e) { return e.independent_rmse; }

// Over scenes. Those without any error (an open plane) say nothing.
double geometric_mean_of(const Rows& rows, const Test& test, const Number& value) {
  std::vector<double> values;
  for (const auto& [scene, e] : rows) {
    if (test(e) && value(e) > 0) values.push_back(value(e));
  }
  return bench::geometric_mean(values);
}

double mean(const Rows& rows, const Test& test, const Number& value) {
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
  for (int ray_count : kStudyRayCounts) fmt::print(" {} rays |", ray_count);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < std::size(kStudyRayCounts); ++i) fmt::print("---|");
  fmt::print("\n");
  for (PatternKind kind : kPatternKinds) {
    fmt::print("| {} |", pattern_kind_name(kind));
    for (int ray_count : kStudyRayCounts) {
      const Test test = is_case(kind, ray_count, falloff);
      const double sobol = geometric_mean_of(rows, is_case(PatternKind::sobol, ray_count, falloff), rmse);
      fmt::print(" {:.3f} ({:+.4f}) |", geometric_mean_of(rows, test, rmse) / sobol, largest_bias(rows, test));
    }
    fmt::print("\n");
  }
}

void print_scenes(const Rows& rows) {
  for (int ray_count : {128, 1024}) {
    fmt::print("\nFalloff constant, {} rays: RMSE (bias)\n\n| scene |", ray_count);
    for (PatternKind kind : kPatternKinds) fmt::print(" {} |", pattern_kind_name(kind));
    fmt::print(" independent rays |\n|---|---|---|---|---|---|---|\n");
    std::string last;
    for (const auto& row : rows) {
      if (row.scene == last) continue;
      last = row.scene;
      fmt::print("| {} |", row.scene);
      double independent = 0;
      for (PatternKind kind : kPatternKinds) {
        const Test test = is_case(kind, ray_count, "constant");
        const auto found = std::find_if(rows.begin(), rows.end(),
                                        [&](const PatternRow& r) { return r.scene == last && test(r.error); });
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
    for (int ray_count : kStudyRayCounts) {
      const Test test = is_case(PatternKind::lloyd, ray_count, falloff.name());
      const double own = geometric_mean_of(rows, test, rmse);
      const double independent = geometric_mean_of(rows, test, independent_rmse);
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
                 geometric_mean_of(rows, test, rmse), largest_bias(rows, test),
                 mean(rows, test, [](const PatternError& e) { return e.neighbour_correlation; }));
    }
  }
}

void print_generation_times() {
  const auto milliseconds = [](const auto& make) {
    const method::Stopwatch watch;
    make();
    return 1000 * watch.seconds();
  };
  fmt::print("\nTime to make a pattern, in ms\n\n| pattern | 128 rays | 1024 rays |\n|---|---|---|\n");
  for (PatternKind kind : kPatternKinds) {
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

}  // namespace

Columns patterns_csv_columns() {
  return {{"scene"},
          {"pattern"},
          {"falloff"},
          {"rays"},
          {"rotation", "{:g}"},
          {"tilt", "{:g}"},
          {"rmse", "{:.6g}"},
          {"bias", "{:.3g}"},
          {"neighbour_correlation", "{:.3f}"},
          {"independent_rmse", "{:.6g}"}};
}

Measurement pattern_measurement(const PatternRow& row) {
  const PatternError& e = row.error;
  return {{"scene", row.scene},
          {"pattern", pattern_kind_name(e.what.kind)},
          {"falloff", e.falloff},
          {"rays", e.what.ray_count},
          {"rotation", e.what.jitter.rotation},
          {"tilt", e.what.jitter.tilt},
          {"rmse", e.rmse},
          {"bias", e.bias},
          {"neighbour_correlation", e.neighbour_correlation},
          {"independent_rmse", e.independent_rmse}};
}

void print_pattern_tables(const Rows& rows) {
  for (const Falloff& falloff : study_falloffs()) print_kinds(rows, falloff.name());
  print_scenes(rows);
  print_falloffs(rows);
  print_jitters(rows);
  print_generation_times();
}

}  // namespace lkao::bench
