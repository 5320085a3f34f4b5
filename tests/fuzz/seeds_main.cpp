// A fuzz target as an ordinary program, for every compiler: inputs made of seeds, or the files that are named.
//
//   lkao_fuzz_TARGET [--first SEED] [--seeds COUNT] [--seconds LIMIT] [FILE ...]
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fuzz/target.h"

namespace lkao::tests {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Options {
  std::string program;
  std::uint64_t first = 0;
  std::uint64_t seed_count = 3000;
  double seconds = 1e9;  // no more seeds are begun after that
  std::vector<std::string> files;
};

// The input under test: what to run to see a failure again.
char current_input[4096] = "";

extern "C" void name_current_input(int signal) {
  const char intro[] = "fails: ";
  if (write(STDERR_FILENO, intro, sizeof intro - 1) >= 0 &&
      write(STDERR_FILENO, current_input, std::strlen(current_input)) >= 0 && write(STDERR_FILENO, "\n", 1) >= 0) {
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void run(const Options& options, const std::string& name, const Bytes& bytes) {
  std::snprintf(current_input, sizeof current_input, "%s %s", options.program.c_str(), name.c_str());
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

Bytes bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

Options parse(int argc, char** argv) {
  Options options;
  options.program = argv[0];
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with("--")) {
      options.files.push_back(word);
      continue;
    }
    const std::string value = i + 1 < argc ? argv[++i] : "";
    if (word == "--first") {
      options.first = std::stoull(value);
    } else if (word == "--seeds") {
      options.seed_count = std::stoull(value);
    } else if (word == "--seconds") {
      options.seconds = std::stod(value);
    } else {
      throw std::invalid_argument("unknown option " + word);
    }
  }
  return options;
}

void run_seeds(const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t done = 0;
  for (; done < options.seed_count; ++done) {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    if (time.count() > options.seconds) break;
    const std::uint64_t seed = options.first + done;
    run(options, fmt::format("--first {} --seeds 1", seed), bytes_of_seed(seed));
  }
  fmt::print("{} seeds from {} on: no fault\n", done, options.first);
}

int main_of(int argc, char** argv) {
  const Options options = parse(argc, argv);
  std::signal(SIGABRT, name_current_input);
  for (const std::string& file : options.files) run(options, file, bytes_of_file(file));
  if (options.files.empty()) run_seeds(options);
  return 0;
}

}  // namespace
}  // namespace lkao::tests

int main(int argc, char** argv) {
  try {
    return lkao::tests::main_of(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 2;
  }
}
