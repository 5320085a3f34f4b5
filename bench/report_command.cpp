// lkao-bench report: speed against error, over all methods, as a page to look at and a CSV.
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/options.h"
#include "bench/report/contestants.h"
#include "bench/report/page.h"
#include "bench/report/report.h"
#include "image/atomic_file.h"

namespace lkao::bench {
namespace {

constexpr int kStopped = 130;

int make_report(ReportOptions options) {
  if (options.is_quick) {
    options.scenes.width = 160;
    options.scenes.height = 120;
    options.turn_count = 2;
  }
  const std::optional<nlohmann::ordered_json> report = measure_report(options);
  if (!report) {
    fmt::print(stderr, "stopped; the same command goes on from here\n");
    return kStopped;
  }
  write_report_csv(options.folder, *report);
  image::write_file(options.folder + "/report.html", make_page(*report));
  fmt::print("wrote {0}/report.html and {0}/report.csv\n", options.folder);
  return 0;
}

}  // namespace

Command add_report_command(CLI::App& program) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* app = program.add_subcommand("report", "Speed against error, over all methods.");
  app->add_option("-o,--output", options->folder, "Folder of the report; what it holds already is not measured again")
      ->required()
      ->type_name("FOLDER");
  add_scene_options(*app, options->scenes);
  add_size_options(*app, options->scenes);
  app->add_option("--families", options->families, "Some kinds of contestants")
      ->delimiter(',')
      ->check(CLI::IsMember(method::list_words(kFamilyWords)));
  app->add_option("--rounds", options->round_count, "measurements of time, of which the median counts")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app->add_flag("--quick", options->is_quick, "Fewer contestants, one radius a scene, 160x120 pixels");
  return {app, [options] { return make_report(*options); }};
}

}  // namespace lkao::bench
