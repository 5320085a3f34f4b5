#include "bench/report/report.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <optional>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "bench/csv_file.h"
#include "bench/provenance.h"
#include "bench/report/causes.h"
#include "bench/report/contestants.h"
#include "bench/report/measured.h"
#include "bench/report/page.h"
#include "bench/report/papers.h"
#include "bench/report/store.h"
#include "bench/report/subject.h"
#if LKAO_BENCH_GL
#include "bench/raster_frames.h"
#include "method/gl_device.h"
#endif
#include "method/list.h"

namespace lkao::bench {
namespace {

using nlohmann::ordered_json;

// Of pictures, behind the name of a contestant.
constexpr const char* kMismatch = " mismatch";

volatile std::sig_atomic_t is_stopped = 0;

// From then on Ctrl-C stops between two measurements.
class StopsAtInterrupt {
 public:
  StopsAtInterrupt() : before_(std::signal(SIGINT, [](int) { is_stopped = 1; })) {}
  ~StopsAtInterrupt() { std::signal(SIGINT, before_); }
  StopsAtInterrupt(const StopsAtInterrupt&) = delete;
  StopsAtInterrupt& operator=(const StopsAtInterrupt&) = delete;

 private:
  void (*before_)(int);
};

std::vector<Contestant> wanted_contestants(const ReportOptions& options) {
  std::vector<Contestant> wanted;
  for (Contestant& contestant : all_contestants(method::method_named("raster").is_built())) {
    const bool is_named =
        options.families.empty() || std::find(options.families.begin(), options.families.end(),
                                              word_of(kFamilyWords, contestant.family)) != options.families.end();
    if (is_named && (contestant.is_quick || !options.is_quick)) wanted.push_back(std::move(contestant));
  }
  return wanted;
}

ordered_json describe(const Contestant& contestant, const Subject& subject, const Measured& measured) {
  ordered_json values = {{"contestant", contestant.name},
                         {"family", word_of(kFamilyWords, contestant.family)},
                         {"command", contestant.command(subject.scene.name, subject.radius)},
                         {"device", measured.device},
                         {"mode", measured.mode},
                         {"seconds", measured.seconds},
                         {"query_ratio", measured.query_ratio},
                         {"keys", measured.keys},
                         {"errors", to_json(measured.errors)}};
  if (measured.own_falloff) values["own_falloff_errors"] = to_json(*measured.own_falloff);
  if (measured.mismatch_rate) values["mismatch_rate"] = *measured.mismatch_rate;
  return values;
}

// The command line that makes the same report.
std::string command_of(const ReportOptions& options) {
  std::string text = "lkao-bench report -o FOLDER";
  if (!options.scenes.views.empty()) text += " --views VIEWS";
  const auto add_list = [&text](const char* option, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? option : std::string(",")) + words[i];
  };
  add_list(" --scenes ", options.scenes.names);
  add_list(" --families ", options.families);
  if (options.is_quick) return text + " --quick";
  return text + fmt::format(" --width {} --height {} --rounds {}", options.scenes.width, options.scenes.height,
                            options.round_count);
}

// A report under way.
class Measuring {
 public:
  explicit Measuring(const ReportOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        contestants_(wanted_contestants(options)),
        store_(options.folder, program_fingerprint()) {}

  // False where it was stopped.
  bool run() {
    for (const std::string& name : names_) {
      const StudyScene scene = load_study_scene(name, options_.scenes);
      std::vector<float> radii = scene.radii;
      if (options_.is_quick) radii = {scene.radii.front()};
      for (const float radius : radii) {
        if (!measure(Subject(scene, radius))) return false;
      }
    }
    return true;
  }

  // That draws; "" where nothing is drawn.
  std::string device() const {
    for (const ordered_json& subject : subjects_) {
      for (const ordered_json& result : subject.at("results")) {
        const std::string device = result.at("device");
        if (!device.empty()) return device;
      }
    }
    return {};
  }

  ordered_json take_subjects() { return std::move(subjects_); }

 private:
  std::string record_name(const Subject& subject, const std::string& contestant) const {
    return subject.key + ", " + contestant;
  }

  std::optional<std::vector<float>> picture(const Subject& subject, const std::string& contestant) const {
    return store_.find_picture(record_name(subject, contestant), subject.scene.view.receivers.size());
  }

  // For the page. Mismatches where there are some: a picture of them may be left from another program.
  ordered_json pictures_of(const Subject& subject, const Converged& rays, const ordered_json& results) const {
    const int width = subject.scene.view.width;
    ordered_json pictures;
    pictures["rays"] = encode_picture(steps_of_occlusion(rays.mean), width);
    for (const ordered_json& result : results) {
      const std::string name = result.at("contestant");
      const auto own = picture(subject, name);
      if (own) pictures[name] = encode_picture(steps_of_occlusion(*own), width);
      if (result.value("mismatch_rate", 0.0) == 0) continue;
      const auto mismatches = picture(subject, name + kMismatch);
      if (mismatches) pictures[name + kMismatch] = encode_picture(steps_of_count(*mismatches), width);
    }
    return pictures;
  }

  // Of the store, or what `measure` finds, which is put there once its pictures are.
  template <class Measure>
  ordered_json stored(const std::string& name, const Measure& measure) const {
    if (const auto values = store_.find(name)) return *values;
    store_.put(name, measure());
    return *store_.find(name);
  }

  // Times at shares of the radius.
  ordered_json sweep(const Subject& subject) const {
    ordered_json steps = ordered_json::array();
    for (const float share : kSweptShares) {
      const Subject other(subject.scene, share * subject.radius);
      steps.push_back(stored(record_name(subject, fmt::format("times at {} of the radius", share)), [&] {
        Measurer measurer(other, options_.round_count);
        ordered_json step = {{"radius", other.radius}};
        for (const Contestant& contestant : contestants_) {
          if (is_swept(contestant)) step[contestant.name] = measurer.time(contestant).seconds;
        }
        return step;
      }));
    }
    return steps;
  }

#if LKAO_BENCH_GL
  // Table 2 of Laine & Karras.
  ordered_json culls(const Subject& subject) const {
    return stored(record_name(subject, "culls"),
                  [&] {
                    raster::Rasterizer rasterizer(method::prepare_device({}));
                    const std::vector<FrameSetup> setups = cull_setups();
                    const std::vector<FrameResult> results =
                        RasterFrames(rasterizer, subject.scene, subject.radius, {.round_count = options_.round_count})
                            .draw(setups, true);
                    const FrameResult& last = results.back();
                    ordered_json rows = ordered_json::array();
                    for (std::size_t i = 0; i < setups.size(); ++i) {
                      const double survivors = static_cast<double>(results[i].counts.survivors);
                      rows.push_back({{"tests", setups[i].name},
                                      {"fragments", survivors / static_cast<double>(last.counts.survivors)},
                                      {"speed", last.milliseconds / results[i].milliseconds}});
                    }
                    return ordered_json{{"rows", rows}};
                  })
        .at("rows");
  }
#endif

  // What only papers ask for, in full reports.
  void add_papers_own(const Subject& subject, ordered_json& values) const {
    if (options_.is_quick) return;
    if (subject.radius == subject.scene.radii.front()) values["sweep"] = sweep(subject);
#if LKAO_BENCH_GL
    const auto draws = [](const Contestant& contestant) { return contestant.family == Family::raster; };
    if (std::any_of(contestants_.begin(), contestants_.end(), draws)) values["culls"] = culls(subject);
#endif
  }

  bool measure(const Subject& subject) {
    fmt::print("{}: {} contestants\n", subject.name, contestants_.size());
    const Converged constant = converge(subject, Falloff::constant(), options_.turn_count, store_);
    if (is_stopped != 0) return false;
    const Converged linear = converge(subject, Falloff::linear(), options_.turn_count, store_);
    std::optional<Measurer> measurer;
    ordered_json results = ordered_json::array();
    for (const Contestant& contestant : contestants_) {
      if (is_stopped != 0) return false;
      const std::string name = record_name(subject, contestant.name);
      results.push_back(stored(name, [&] {
        if (!measurer) measurer.emplace(subject, options_.round_count);
        const Measured measured = measurer->measure(contestant, constant, linear);
        store_.put_picture(name, measured.picture);
        if (!measured.mismatches.empty()) store_.put_picture(name + kMismatch, measured.mismatches);
        fmt::print("  {:36} {:9.2f} ms  RMSE {:.4f}\n", contestant.name, 1000 * measured.seconds, measured.errors.rmse);
        std::fflush(stdout);
        return describe(contestant, subject, measured);
      }));
    }
    const scene::ReceiverImage& view = subject.scene.view;
    ordered_json pictures = pictures_of(subject, constant, results);
    ordered_json values = {{"scene", subject.scene.name},
                           {"radius", subject.radius},
                           {"width", view.width},
                           {"height", view.height},
                           {"triangles", subject.scene.mesh.triangles.size()},
                           {"receivers", view.receiver_count},
                           {"reference_rays", constant.ray_count},
                           // Of the mean of both halves: half as much as they differ.
                           {"noise_floor_rmse", 0.5 * constant.between_halves.rmse},
                           {"linear_noise_floor_rmse", 0.5 * linear.between_halves.rmse},
                           {"results", std::move(results)},
                           {"causes", errors_by_cause(contestants_,
                                                      [&](const std::string& name) {
                                                        return name == "rays" ? constant.mean : picture(subject, name);
                                                      })},
                           {"pictures", std::move(pictures)}};
    add_papers_own(subject, values);
    subjects_.push_back(std::move(values));
    return is_stopped == 0;
  }

  const ReportOptions& options_;
  std::vector<std::string> names_;
  std::vector<Contestant> contestants_;
  ReportStore store_;  // last: where the others find a fault, no folder is made
  ordered_json subjects_ = ordered_json::array();
};

Columns csv_columns() {
  return {{"scene"},
          {"radius", "{:.6g}"},
          {"contestant"},
          {"family"},
          {"device"},
          {"milliseconds", "{:.5g}"},
          {"query_ratio", "{:.4g}"},
          {"bias", "{:.4g}"},
          {"mae", "{:.4g}"},
          {"rmse", "{:.4g}"},
          {"median", "{:.4g}"},
          {"percentile_95", "{:.4g}"},
          {"percentile_99", "{:.4g}"},
          {"largest", "{:.4g}"},
          {"psnr", "{:.4g}"},
          {"equal_8bit_share", "{:.6f}"},
          {"log_error", "{:.4g}"},
          {"own_falloff_rmse", "{:.4g}"},
          {"mismatch_rate", "{:.4g}"},
          {"noise_floor_rmse", "{:.4g}"}};
}

// A number of an object, or nothing.
Value number(const ordered_json& object, const char* key) {
  return object.contains(key) && object.at(key).is_number() ? Value(object.at(key).get<double>()) : Value();
}

// Contestants have commas in their names.
std::string quoted(const std::string& text) { return '"' + text + '"'; }

}  // namespace

std::optional<ordered_json> measure_report(const ReportOptions& options) {
  is_stopped = 0;
  const StopsAtInterrupt stops;
  Measuring measuring(options);
  if (!measuring.run()) return std::nullopt;
  const Processor cpu = processor();
  const std::string device = measuring.device();
  ordered_json subjects = measuring.take_subjects();
  ordered_json papers = paper_tables(subjects);
  return ordered_json{{"processor", fmt::format("{}, family {}, model {}", cpu.name, cpu.family, cpu.model)},
                      {"compiler", compiler()},
                      {"device", device},
                      {"commit", commit()},
                      {"date", fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))},
                      {"command", command_of(options)},
                      {"subjects", std::move(subjects)},
                      {"papers", std::move(papers)}};
}

void write_report_csv(const std::string& folder, const ordered_json& report) {
  CsvFile csv(folder + "/report.csv", csv_columns());
  for (const ordered_json& subject : report.at("subjects")) {
    for (const ordered_json& result : subject.at("results")) {
      Measurement row = {{"scene", subject.at("scene").get<std::string>()},
                         {"radius", number(subject, "radius")},
                         {"contestant", quoted(result.at("contestant").get<std::string>())},
                         {"family", result.at("family").get<std::string>()},
                         {"device", quoted(result.at("device").get<std::string>())},
                         {"milliseconds", 1000 * result.at("seconds").get<double>()},
                         {"query_ratio", number(result, "query_ratio")},
                         {"mismatch_rate", number(result, "mismatch_rate")},
                         {"noise_floor_rmse", number(subject, "noise_floor_rmse")}};
      for (const auto& [key, value] : result.at("errors").items())
        row.emplace_back(key, number(result.at("errors"), key.c_str()));
      row.emplace_back("own_falloff_rmse", result.contains("own_falloff_errors")
                                               ? number(result.at("own_falloff_errors"), "rmse")
                                               : Value());
      csv.write(row);
    }
  }
}

}  // namespace lkao::bench
