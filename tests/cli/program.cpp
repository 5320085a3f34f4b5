#include "cli/program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#ifdef LKAO_RUN_IN_PROCESS
#include "cli/in_process.h"
#endif

namespace lkao::test {
namespace fs = std::filesystem;
namespace {

std::string contents_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

fs::path make_folder() {
  std::string pattern = (fs::temp_directory_path() / "lkao-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + pattern);
  return pattern;
}

// With the signals as a shell in the foreground gives them, whatever started the test.
pid_t start(const Arguments& arguments, const std::string& out, const std::string& err) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t usual;
  sigemptyset(&usual);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaddset(&usual, signal);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);

  std::string program = LKAO_PROGRAM;
  Arguments words = arguments;
  std::vector<char*> argv = {program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t process = -1;
  const int error = posix_spawn(&process, program.c_str(), &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::runtime_error("cannot start " + program);
  return process;
}

int wait_for(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// run(arguments, file of stdout, file of stderr) returns the exit code.
template <typename Run>
ProgramResult result_of(const Run& run, const Arguments& arguments) {
  const fs::path folder = make_folder();
  const fs::path out = folder / "out";
  const fs::path err = folder / "err";
  ProgramResult result;
  result.exit_code = run(arguments, out, err);
  result.out = contents_of(out);
  result.err = contents_of(err);
  fs::remove_all(folder);
  return result;
}

using Snapshot = std::vector<std::pair<std::string, std::string>>;

Snapshot snapshot_of(const fs::path& folder, const std::vector<std::string>& names) {
  Snapshot snapshot;
  for (const std::string& name : names) {
    const fs::path file = folder / name;
    snapshot.emplace_back(name, fs::is_directory(file) ? "" : contents_of(file));
  }
  return snapshot;
}

}  // namespace

ProgramResult run_program(const Arguments& arguments) {
#ifdef LKAO_RUN_IN_PROCESS
  return result_of(run_in_process, arguments);
#else
  return run_as_process(arguments);
#endif
}

ProgramResult run_as_process(const Arguments& arguments) {
  return result_of([](auto&&... all) { return wait_for(start(all...)); }, arguments);
}

RunningProgram::RunningProgram(const Arguments& arguments) : process_(start(arguments, "/dev/null", "/dev/null")) {}

RunningProgram::~RunningProgram() {
  if (waited_) return;
  send(SIGKILL);
  wait();
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

int RunningProgram::wait() {
  waited_ = true;
  return wait_for(process_);
}

void ProgramTest::SetUp() { folder_ = make_folder(); }

std::string ProgramTest::write_file(const std::string& name, const std::string& bytes) const {
  std::ofstream(folder_ / name, std::ios::binary) << bytes;
  return path(name);
}

std::string ProgramTest::read_file(const std::string& name) const { return contents_of(folder_ / name); }

std::vector<std::string> ProgramTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

void ProgramTest::expect_rejected(const Arguments& arguments, const std::vector<std::string>& words) const {
  const Snapshot before = snapshot_of(folder_, files());
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(result.out, "");
  const std::string name = fs::path(LKAO_PROGRAM).filename().string();
  EXPECT_EQ(result.err.find(name + ": "), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(result.err.ends_with('\n')) << result.err;
  for (const std::string& word : words)
    EXPECT_NE(result.err.find(word), std::string::npos) << word << " / " << result.err;
  EXPECT_TRUE(snapshot_of(folder_, files()) == before)
      << "files were changed, now: " << ::testing::PrintToString(files());
}

int ProgramTest::expect_same_as_process(const Arguments& arguments, const std::string& output) const {
  const ProgramResult here = run_program(arguments);
  std::string written;
  if (!output.empty()) {
    written = read_file(output);
    EXPECT_FALSE(written.empty()) << output;
    fs::remove(path(output));
  }
  const ProgramResult there = run_as_process(arguments);
  EXPECT_EQ(there.exit_code, here.exit_code);
  EXPECT_EQ(there.out, here.out);
  EXPECT_EQ(there.err, here.err);
  EXPECT_TRUE(output.empty() || read_file(output) == written) << output << " is not the same";
  return there.exit_code;
}

ProgramResult ProgramTest::expect_success(const Arguments& arguments) const {
  ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return result;
}

}  // namespace lkao::test
