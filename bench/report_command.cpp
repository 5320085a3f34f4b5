// lkao-bench report: speed against error, over all methods, as a page to look at and a CSV.
#include <charconv>
#include <memory>
#include <string>
#include <string_view>

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

// Of a report that is not quick, on two cores.
constexpr double kFullMinutes = 50;
constexpr int kLargestSide = 16384;

int side_of(std::string_view text) {
  int side = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  return is_whole && side <= kLargestSide ? side : 0;
}

// "320x240"
void set_size(const std::string& text, StudySceneOptions& scenes) {
  const std::size_t cross = text.find('x');
  const int width = side_of(std::string_view(text).substr(0, cross));
  const int height = cross == std::string::npos ? 0 : side_of(std::string_view(text).substr(cross + 1));
  if (width < 1 || height < 1) {
    throw CLI::ValidationError("--size", fmt::format("expected WIDTHxHEIGHT, up to {}, got '{}'", kLargestSide, text));
  }
  scenes.width = width;
  scenes.height = height;
}

int make_report(ReportOptions options) {
  if (options.is_quick) {
    options.scenes.width = 160;
    options.scenes.height = 120;
    options.turn_count = 2;
  } else if (!options.minutes) {
    options.minutes = kFullMinutes;
  }
  if (options.minutes == 0) options.minutes.reset();
  const nlohmann::ordered_json report = measure_report(options);
  write_report_csv(options.folder, report);
  image::write_file(options.folder + "/report.html", make_page(report));
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
  app->add_option_function<std::string>(
         "--size", [options](const std::string& text) { set_size(text, options->scenes); },
         fmt::format("Pixels of the views (default: {}x{})", options->scenes.width, options->scenes.height))
      ->type_name("WxH");
  app->add_option("--methods", options->methods, "Some kinds of contestants")
      ->delimiter(',')
      ->check(CLI::IsMember(method::list_words(kFamilyWords)));
  app->add_option("--rounds", options->round_count, "measurements of time, of which the median counts")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app->add_option("--minutes", options->minutes,
                  fmt::format("How long it may take, earlier starts included: what would take longest is left out, and "
                              "told of; 0: no limit (default: {:g}; --quick: 0)",
                              kFullMinutes))
      ->check(CLI::Range(0.0, 1e6));
  app->add_flag("--quick", options->is_quick, "Fewer contestants, one radius a scene, 160x120 pixels");
  return {app, [options] { return make_report(*options); }};
}

}  // namespace lkao::bench
