// All that the program does, but for how it takes interruptions.
#pragma once

namespace lkao::cli {

// Parses the command line, runs one subcommand, and turns errors into one line on stderr. Returns the exit code. May be
// called again: tests do so in one process.
int answer_command_line(int argc, char** argv);

}  // namespace lkao::cli
