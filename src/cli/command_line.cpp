#include "cli/command_line.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "cli/commands.h"
#include "lkao/isa.h"
#include "lkao/version.h"
#include "scene/embree_version.h"

namespace lkao::cli {
namespace {

int fail(std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');  // one line, whatever a library says
  fmt::print(stderr, "lkao: {}\n", message);
  return kFailure;
}

// Throws for a first argument that is neither an option nor a subcommand: in clearer words than the parser's.
void check_command_name(const std::vector<Command>& commands, std::string_view name) {
  std::string known;
  for (const Command& command : commands) {
    if (name == command.app->get_name()) return;
    known += (known.empty() ? "" : ", ") + command.app->get_name();
  }
  throw std::invalid_argument(fmt::format("unknown subcommand '{}' (known: {})", name, known));
}

// What was printed must have arrived: a full disk is an error like any other.
int end(int exit_code) { return std::fflush(stdout) == 0 ? exit_code : fail("cannot write to standard output"); }

std::string version_report() {
  return fmt::format("lkao {}\nEmbree {}, as the reference and for camera rays\ninstruction sets: {}", version(),
                     scene::embree_version(), fmt::join(available_isas(), ", "));
}

int run(int argc, char** argv) {
  CLI::App program("Laine-Karras bitmask ambient occlusion: mesh files in, images of occlusion out.", "lkao");
  program.set_version_flag("--version", version_report());
  program.require_subcommand(0, 1);
  const std::vector<Command> commands = {add_render_command(program),   add_bake_command(program),
                                         add_compare_command(program),  add_info_command(program),
                                         add_simplify_command(program), add_merge_command(program)};

  if (argc > 1 && argv[1][0] != '-') check_command_name(commands, argv[1]);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    return program.exit(request);
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  fmt::print("{}", program.help());
  return kSuccess;
}

}  // namespace

int run_command(std::vector<std::string> arguments) {
  std::string program = "lkao";
  std::vector<char*> argv = {program.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  return run(static_cast<int>(argv.size()), argv.data());
}

int answer_command_line(int argc, char** argv) {
  try {
    return end(run(argc, argv));
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

}  // namespace lkao::cli
