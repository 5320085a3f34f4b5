// Runs the program `lkao` as a user does, and looks at what it printed, returned and left behind.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lkao::test {

struct ProgramResult {
  int exit_code = 0;  // -signal where a signal ended it
  std::string out;
  std::string err;
};

using Arguments = std::vector<std::string>;

// Runs the program to its end: as a process of its own, or, with LKAO_RUN_IN_PROCESS (tests/cli/CMakeLists.txt), what
// it does in this process.
ProgramResult run_program(const Arguments& arguments);

// A process of its own, always.
ProgramResult run_as_process(const Arguments& arguments);

// A process of its own, always, that a test can interrupt. Its output goes nowhere.
class RunningProgram {
 public:
  explicit RunningProgram(const Arguments& arguments);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  // The exit code, or -signal.
  int wait();

 private:
  pid_t process_;
  bool waited_ = false;
};

// Tests of the program have a folder of their own, empty at first and removed at the end.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write_file(const std::string& name, const std::string& bytes) const;
  std::string read_file(const std::string& name) const;
  nlohmann::json read_json(const std::string& name) const { return nlohmann::json::parse(read_file(name)); }
  // Names of all files in the folder, hidden ones too, sorted.
  std::vector<std::string> files() const;

  // The arguments are answered with exit code 2, nothing on stdout, one line on stderr that begins with the program's
  // name and contains `words`, and no file made or changed.
  void expect_rejected(const Arguments& arguments, const std::vector<std::string>& words) const;
  // As a process of its own the program returns, prints and writes into `output`, if that is not empty, what it does in
  // this process. Returns the exit code.
  int expect_same_as_process(const Arguments& arguments, const std::string& output = "") const;
  // Exit code 0 and nothing on stderr.
  ProgramResult expect_success(const Arguments& arguments) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace lkao::test
