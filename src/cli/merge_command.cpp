// lkao merge: what the parts of a run make together.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/part_method.h"

namespace lkao::cli {
namespace {

struct MergeOptions {
  std::vector<std::string> parts;
  std::string output;
  std::vector<std::string> common;  // as given
};

// The run whose parts they are, as if none of it had been a part, with the answers of these files.
std::vector<std::string> arguments_of(const MergeOptions& options) {
  std::vector<std::string> arguments = open_parts(options.parts).front().header().arguments;
  const std::string output = "--output=";
  if (!options.output.empty()) {
    for (std::string& argument : arguments) {
      if (argument.starts_with(output)) argument = output + options.output;
    }
  }
  for (const std::string& part : options.parts) arguments.push_back("--merged=" + part);
  arguments.insert(arguments.end(), options.common.begin(), options.common.end());
  return arguments;
}

void pass_on(CLI::App& app, const std::string& name, const std::string& type, const std::string& help,
             std::vector<std::string>& arguments) {
  const auto take = [&arguments, name](const std::string& value) { arguments.push_back(name + "=" + value); };
  app.add_option_function<std::string>(name, take, help)->type_name(type);
}

}  // namespace

Command add_merge_command(CLI::App& program) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App* const app =
      program.add_subcommand("merge", "Make of the parts of a rendering or a bake (--part K/N) what they are parts of");
  app->add_option("part", options->parts, "Files of all parts, in any order")->required()->type_name("FILE...");
  app->add_option("-o,--output", options->output, "Instead of the output that the parts were made for")
      ->type_name("FILE");
  pass_on(*app, "--threads", "N", "Threads to use (default: all)", options->common);
  pass_on(*app, "--json", "FILE", "Write the results as JSON; - for stdout, instead of the table", options->common);
  app->add_flag_callback(
      "--quiet", [options] { options->common.emplace_back("--quiet"); }, "No table and no progress bar");
  app->footer(
      "Runs where the parts ran: the scene is read again, by the name that they had for it. Nothing is traced again.");
  const auto run = [options] { return run_command(arguments_of(*options)); };
  return {app, run};
}

}  // namespace lkao::cli
