// lkao-bench spread: how far the CSV files of several runs of `lkao-bench rays` lie apart.
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/rays_cell.h"
#include "bench/rays_csv.h"
#include "bench/spread.h"

namespace lkao::bench {

Command add_spread_command(CLI::App& program) {
  struct SpreadOptions {
    std::vector<std::string> files;
    std::string method = kSimdMethod;
  };
  auto options = std::make_shared<SpreadOptions>();
  CLI::App* app = program.add_subcommand("spread", "How far separate runs of rays lie apart, from their CSV files.");
  app->add_option("files", options->files, "of runs that measured the same cells")->required();
  app->add_option("--method", options->method, "whose ratios")->capture_default_str();
  return {app, [options] {
            std::vector<RaysCsv> runs;
            for (const std::string& file : options->files) runs.push_back(read_rays_csv(file));
            fmt::print("{}", spread_of_runs(runs, options->method));
            return 0;
          }};
}

}  // namespace lkao::bench
