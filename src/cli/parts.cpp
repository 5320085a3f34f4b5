#include "cli/parts.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/json_output.h"
#include "cli/output_files.h"
#include "cli/own_objects.h"
#include "cli/parse.h"
#include "cli/parsed_option.h"
#include "cli/part_method.h"
#include "cli/report.h"

namespace lkao::cli {
namespace {

constexpr int kMostParts = 65536;
constexpr const char* kMerged = "--merged";

Part parse_part(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == text.npos) {
    throw std::invalid_argument(fmt::format("expected K/N, part K of N, got '{}'", text));
  }
  Part part;
  part.count = parse_integer(text.substr(slash + 1), 1, kMostParts);
  part.number = parse_integer(text.substr(0, slash), 1, part.count);
  return part;
}

// What tells how to run, and not what comes out.
bool is_of_the_run(const std::string& name) {
  constexpr std::string_view kNames[] = {"--part", kMerged, "--threads", "--json", "--quiet"};
  return std::ranges::find(kNames, name) != std::end(kNames);
}

// The subcommand and what it was given, so that it can be given again.
std::vector<std::string> arguments_of(const CLI::App& app) {
  std::vector<std::string> arguments = {app.get_name()};
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || is_of_the_run(name)) continue;
    for (const std::string& value : option->results()) {
      if (option->get_positional()) {
        arguments.push_back(value);
      } else {
        arguments.push_back(option->get_expected_max() == 0 ? name : name + "=" + value);
      }
    }
  }
  return arguments;
}

}  // namespace

void add_part_options(CLI::App& app, PartOptions& options) {
  add_parsed(
      app, "--part", options.part, parse_part,
      "Answer only part K of N, from 1, into OUTPUT.KofN.part; lkao merge makes OUTPUT of all parts, the same as "
      "of one run, bit for bit")
      ->type_name("K/N");
  app.add_option(kMerged, options.merged)->group("");
  app.parse_complete_callback([&app, &options] { options.arguments = arguments_of(app); });
}

void check_part(const PartOptions& options, const MethodOptions& method) {
  if (options.part) require_ability(method, &method::Abilities::any_receivers, "--part");
}

std::string part_path(const std::string& output, const Part& part) {
  return fmt::format("{}.{}of{}.part", output, part.number, part.count);
}

std::unique_ptr<method::Method> open_method(const MethodOptions& method, const PartOptions& parts, bool own_object) {
  if (!parts.merged.empty()) return replay_parts(method.kind->abilities(method.settings), parts.merged);
  std::unique_ptr<method::Method> opened = own_object ? open_for_objects(method) : method.kind->open(method.settings);
  return parts.writer ? record_part(std::move(opened), *parts.writer) : std::move(opened);
}

void answer_part(PartOptions& parts, const std::string& output, const CommonOptions& common,
                 std::vector<std::string> inputs, const std::function<method::Batch(ProgressBar&)>& compute) {
  OutputFiles outputs(std::move(inputs));
  const JsonOutput json(common.json_path, outputs);
  const std::string path = part_path(output, *parts.part);
  parts.writer = std::make_shared<PartWriter>(outputs.claim(path), PartHeader{*parts.part, parts.arguments});
  ProgressBar progress(!common.quiet);
  const method::Batch batch = compute(progress);
  parts.writer->close();
  json.write_and_commit({{"part", parts.part->number},
                         {"parts", parts.part->count},
                         {"rays", batch.ray_count},
                         {"seconds", batch.seconds},
                         {"output", path}});
  if (!common.wants_table()) return;
  Table table;
  table.add("part", fmt::format("{} of {}", parts.part->number, parts.part->count));
  table.add("rays", fmt::format("{} in {:.3f} s", grouped(batch.ray_count), batch.seconds));
  table.add("wrote", path);
  table.print();
}

}  // namespace lkao::cli
