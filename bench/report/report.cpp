#include "bench/report/report.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <variant>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "bench/provenance.h"
#include "bench/report/budget.h"
#include "bench/report/causes.h"
#include "bench/report/contestants.h"
#include "bench/report/front.h"
#include "bench/report/interrupt.h"
#include "bench/report/measured.h"
#include "bench/report/paper_studies.h"
#include "bench/report/papers.h"
#include "bench/report/picture.h"
#include "bench/report/store.h"
#include "bench/report/subject.h"
#include "method/list.h"

namespace lkao::bench {
namespace {

using nlohmann::ordered_json;

// Of pictures, behind the name of a contestant.
constexpr const char* kMismatch = " mismatch";

// Of the time for a subject: what is for contestants, the rest being for what only papers ask for; of that what is for
// those of quick reports, and what counts as short.
constexpr double kContestantsShare = 0.8, kQuickShare = 0.7, kShortShare = 0.03;

std::vector<Contestant> wanted_contestants(const ReportOptions& options) {
  std::vector<Contestant> wanted;
  for (Contestant& contestant : all_contestants(method::method_named("raster").is_built())) {
    const bool is_named =
        options.methods.empty() || std::find(options.methods.begin(), options.methods.end(),
                                             word_of(kFamilyWords, contestant.family)) != options.methods.end();
    if (is_named && (contestant.is_quick || !options.is_quick)) wanted.push_back(std::move(contestant));
  }
  if (wanted.empty()) throw std::invalid_argument("--methods: none of these is in a program without OpenGL");
  return wanted;
}

bool is_often_short(const Contestant* contestant) {
  for (const Family family : {Family::tables, Family::levels, Family::raster, Family::volumes}) {
    if (contestant->family == family) return false;
  }
  return true;
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
  if (measured.own_falloff) {
    values["own_falloff"] = word_of(kOwnFalloffWords, contestant.falloff);
    values["own_falloff_errors"] = to_json(*measured.own_falloff);
  }
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
  add_list(" --methods ", options.methods);
  text += options.is_quick ? std::string(" --quick")
                           : fmt::format(" --size {}x{}", options.scenes.width, options.scenes.height);
  if (options.minutes) text += fmt::format(" --minutes {:g}", *options.minutes);
  return text + fmt::format(" --rounds {}", options.round_count);
}

// A report under way.
class Measuring {
 public:
  explicit Measuring(const ReportOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        contestants_(wanted_contestants(options)),
        store_(options.folder, program_fingerprint()),
        spent_name_("seconds spent on " + fingerprint(command_of(options))),
        budget_(options.minutes ? 60 * *options.minutes : kNoLimit, spent_before()) {}

  void run() {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const StudyScene scene = load_study_scene(names_[i], options_.scenes);
      PreparedScene prepared(scene);
      std::vector<float> radii = scene.radii;
      if (options_.is_quick) radii = {scene.radii.front()};
      for (std::size_t k = 0; k < radii.size(); ++k) {
        // As if the scenes to come had as many radii.
        const std::size_t subject_count = radii.size() * (names_.size() - i) - k;
        measure(prepared, Subject(scene, radii[k]), Budget(budget_.left() / static_cast<double>(subject_count)));
      }
    }
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
  double spent_before() const {
    const auto spent = store_.find(spent_name_);
    return spent ? spent->at("seconds").get<double>() : 0;
  }

  std::string record_name(const Subject& subject, const std::string& contestant) const {
    return subject.key + ", " + contestant;
  }

  std::optional<std::vector<float>> picture(const Subject& subject, const std::string& contestant) const {
    return store_.find_picture(record_name(subject, contestant), subject.scene.view.receivers.size());
  }

  bool takes_part(const Contestant& contestant, const Subject& subject) const {
    return !contestant.is_for_paper || subject.radius == subject.scene.radii.front();
  }

  // Of the store; none where it has none. One that was left out for want of time gets another chance where there is
  // more, or less.
  std::optional<ordered_json> known(const Subject& subject, const Contestant& contestant) const {
    auto values = store_.find(record_name(subject, contestant.name));
    if (values && values->value("minutes", options_.minutes.value_or(0)) != options_.minutes.value_or(0)) return {};
    return values;
  }

  void put(const Subject& subject, const Contestant& contestant, const ordered_json& values) {
    store_.put(record_name(subject, contestant.name), values);
    store_.put(spent_name_, {{"seconds", budget_.spent()}});
  }

  void leave_out(const Subject& subject, const Contestant& contestant, const std::string& reason,
                 std::optional<double> seconds) {
    fmt::print("  {:36} left out: {}\n", contestant.name, reason);
    std::fflush(stdout);
    ordered_json values = {
        {"contestant", contestant.name}, {"family", word_of(kFamilyWords, contestant.family)}, {"left_out", reason}};
    if (seconds) {
      values["estimated_seconds"] = *seconds;
      values["minutes"] = options_.minutes.value_or(0);
    }
    put(subject, contestant, values);
  }

  // Puts it in the store, or returns what it would take where that is more than `allowed` seconds.
  std::optional<double> try_to_measure(Measurer& measurer, References& references, const Subject& subject,
                                       const Contestant& contestant, double allowed) {
    try {
      const auto answer = measurer.measure(contestant, references, allowed);
      if (const auto* const estimate = std::get_if<Estimate>(&answer)) return estimate->seconds;
      const auto& measured = std::get<Measured>(answer);
      if (!contestant.is_for_paper) {
        const std::string name = record_name(subject, contestant.name);
        store_.put_picture(name, measured.picture);
        if (!measured.mismatches.empty()) store_.put_picture(name + kMismatch, measured.mismatches);
      }
      fmt::print("  {:36} {:9.2f} ms  RMSE {:.4f}\n", contestant.name, 1000 * measured.seconds, measured.errors.rmse);
      std::fflush(stdout);
      put(subject, contestant, describe(contestant, subject, measured));
    } catch (const CannotAnswer& error) {
      leave_out(subject, contestant, error.what(), std::nullopt);
    }
    return std::nullopt;
  }

  // Those of quick reports first, so that these have the time that there is.
  void measure_contestants(PreparedScene& scene, const Subject& subject, References& references, const Budget& time) {
    std::vector<const Contestant*> quick, others;
    for (const Contestant& contestant : contestants_) {
      if (!takes_part(contestant, subject) || known(subject, contestant)) continue;
      (contestant.is_quick ? quick : others).push_back(&contestant);
    }
    if (quick.empty() && others.empty()) return;
    // A try of what may take minutes takes its time, too.
    for (auto* const some : {&quick, &others}) std::stable_partition(some->begin(), some->end(), is_often_short);
    Measurer measurer(scene, subject, options_.round_count);
    measure_some(measurer, subject, references, quick, Budget(kQuickShare * time.left()));
    measure_some(measurer, subject, references, others, Budget(time.left()));
  }

  // First all that is short, then the rest, the shortest first, as long as there is time.
  void measure_some(Measurer& measurer, const Subject& subject, References& references,
                    const std::vector<const Contestant*>& contestants, const Budget& time) {
    struct Late {
      const Contestant* contestant;
      double seconds;
    };
    std::vector<Late> late;
    const double short_seconds = kShortShare * time.left();
    for (const Contestant* contestant : contestants) {
      // The first is measured however little time there is: a page has something to show.
      const bool is_first = contestant == contestants_.data();
      if (time.left() <= 0 && !is_first) {
        leave_out(subject, *contestant, "there was no time left", 0);
        continue;
      }
      const auto seconds =
          try_to_measure(measurer, references, subject, *contestant, is_first ? kNoLimit : short_seconds);
      if (seconds) late.push_back({contestant, *seconds});
    }
    std::stable_sort(late.begin(), late.end(), [](const Late& a, const Late& b) { return a.seconds < b.seconds; });
    for (const auto& [contestant, seconds] : late) {
      // What levels take is known when they are there: their making may be all that was estimated.
      const double allowed = contestant->levels ? time.left() : kNoLimit;
      const auto longer = seconds <= time.left() ? try_to_measure(measurer, references, subject, *contestant, allowed)
                                                 : std::optional(seconds);
      if (longer) leave_out(subject, *contestant, fmt::format("it would take about {:.0f} s", *longer), *longer);
    }
  }

  // For the page. Mismatches where there are some: a picture of them may be left from another program.
  ordered_json pictures_of(const Subject& subject, const Converged& rays, const ordered_json& results) const {
    PictureEncoder encoder(rays.mean, subject.scene.view.width);
    for (const ordered_json& result : results) {
      const std::string name = result.at("contestant");
      if (const auto own = picture(subject, name)) encoder.add(name, *own);
      if (result.value("mismatch_rate", 0.0) == 0) continue;
      if (const auto counts = picture(subject, name + kMismatch)) encoder.add_counts(name + kMismatch, *counts);
    }
    return encoder.take();
  }

  void measure(PreparedScene& scene, const Subject& subject, const Budget& time) {
    fmt::print(
        "{}{}\n", subject.name,
        options_.minutes ? fmt::format(", {:.0f} of {:g} minutes left", budget_.left() / 60, *options_.minutes) : "");
    std::fflush(stdout);
    References references(scene, subject, options_.turn_count, store_);
    const Converged& constant = references.of(OwnFalloff::constant);
    measure_contestants(scene, subject, references, Budget(kContestantsShare * time.left()));
    ordered_json results = ordered_json::array(), left_out = ordered_json::array();
    std::set<OwnFalloff> falloffs;
    for (const Contestant& contestant : contestants_) {
      if (!takes_part(contestant, subject)) continue;
      ordered_json values = known(subject, contestant).value();
      if (!values.contains("left_out")) falloffs.insert(contestant.falloff);
      (values.contains("left_out") ? left_out : results).push_back(std::move(values));
    }
    add_front(results);
    const scene::ReceiverImage& view = subject.scene.view;
    ordered_json pictures = pictures_of(subject, constant, results);
    ordered_json causes =
        errors_by_cause(contestants_, [&](const std::string& name) -> std::optional<std::vector<float>> {
          for (const OwnFalloff falloff : falloffs) {
            if (name == rays_of(falloff)) return references.of(falloff).mean;
          }
          return picture(subject, name);
        });
    ordered_json floors;
    for (const OwnFalloff falloff : falloffs) {
      floors[std::string(word_of(kOwnFalloffWords, falloff))] = 0.5 * references.of(falloff).between_halves.rmse;
    }
    ordered_json values = {{"scene", subject.scene.name},
                           {"radius", subject.radius},
                           {"width", view.width},
                           {"height", view.height},
                           {"triangles", subject.scene.mesh.triangles.size()},
                           {"receivers", view.receiver_count},
                           {"reference_rays", constant.ray_count},
                           // Of the mean of both halves: half as much as they differ.
                           {"noise_floor_rmse", 0.5 * constant.between_halves.rmse},
                           {"own_falloff_noise_floors", std::move(floors)},
                           {"results", std::move(results)},
                           {"left_out", std::move(left_out)},
                           {"causes", std::move(causes)},
                           {"pictures", std::move(pictures)}};
    if (!options_.is_quick) add_paper_studies(scene, subject, time, values);
    subjects_.push_back(std::move(values));
  }

  void add_paper_studies(PreparedScene& scene, const Subject& subject, const Budget& time, ordered_json& values) {
    const auto studies = [&](double share) {
      return PaperStudies{scene, subject, contestants_, store_, options_.round_count, Budget(share * time.left())};
    };
    if (subject.radius == subject.scene.radii.front()) values["sweep"] = studies(0.5).sweep(values.at("results"));
    values["culls"] = studies(1).culls();
    store_.put(spent_name_, {{"seconds", budget_.spent()}});
  }

  const ReportOptions& options_;
  std::vector<std::string> names_;
  std::vector<Contestant> contestants_;
  ReportStore store_;  // behind what finds faults: where there are some, no folder is made
  std::string spent_name_;
  Budget budget_;
  ordered_json subjects_ = ordered_json::array();
};

}  // namespace

ordered_json measure_report(const ReportOptions& options) {
  const StopsAtInterrupt stops;
  Measuring measuring(options);
  measuring.run();
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

}  // namespace lkao::bench
