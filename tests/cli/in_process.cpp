#include "cli/in_process.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "cli/command_line.h"

namespace lkao::test {
namespace {

// A stream of this process, led into a file while this lives.
class Redirection {
 public:
  Redirection(std::FILE* stream, const std::filesystem::path& file) : stream_(stream), descriptor_(fileno(stream)) {
    std::fflush(stream_);
    before_ = dup(descriptor_);
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (before_ < 0 || opened < 0) throw std::runtime_error("cannot write " + file.string());
    dup2(opened, descriptor_);
    close(opened);
  }
  ~Redirection() {
    std::fflush(stream_);
    dup2(before_, descriptor_);
    close(before_);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;

 private:
  std::FILE* stream_;
  int descriptor_;
  int before_ = -1;
};

}  // namespace

int run_in_process(const Arguments& arguments, const std::filesystem::path& out, const std::filesystem::path& err) {
  std::string program = "lkao";
  Arguments words = arguments;
  std::vector<char*> argv;
  argv.reserve(words.size() + 2);
  argv.push_back(program.data());
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const Redirection to_out(stdout, out), to_err(stderr, err);
  return cli::answer_command_line(static_cast<int>(argv.size()) - 1, argv.data());
}

}  // namespace lkao::test
