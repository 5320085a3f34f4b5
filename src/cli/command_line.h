// All that the program does, but for how it takes interruptions.
#pragma once

#include <string>
#include <vector>

namespace lkao::cli {

// Parses the command line, runs one subcommand, and turns errors into one line on stderr. Returns the exit code. May be
// called again: tests do so in one process.
int answer_command_line(int argc, char** argv);

// Runs the subcommand that these arguments begin with, for another one. Returns its exit code; throws std::exception
// with one line for whatever is wrong.
int run_command(std::vector<std::string> arguments);

}  // namespace lkao::cli
