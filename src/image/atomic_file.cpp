#include "image/atomic_file.h"

#include <cerrno>
#include <cstdio>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "image/unfinished_files.h"

namespace lkao::image {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
}

[[noreturn]] void fail(const std::string& path, int error_number) {
  fail(path, std::generic_category().message(error_number));
}

// True for what cannot be replaced by a rename: pipes, devices, and the links in /dev to open files.
bool is_written_in_place(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return false;
  return fs::is_other(status) || (path.starts_with("/dev/") && fs::is_symlink(fs::symlink_status(path, error)));
}

void check_target(const std::string& path, const fs::path& target) {
  std::error_code error;
  if (fs::is_directory(target, error)) fail(path, "is a directory");
  if (!target.has_filename()) fail(path, "has no file name");
  const fs::path folder = target.parent_path();
  if (!fs::exists(folder, error)) fail(path, fmt::format("there is no folder '{}'", folder.string()));
  if (!fs::is_directory(folder, error)) fail(path, fmt::format("'{}' is not a folder", folder.string()));
  // A rename would replace a write-protected file without asking.
  if (fs::exists(target, error) && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail(path, errno);
}

std::string temporary_name(const fs::path& target, int attempt) {
  constexpr std::size_t kLongestStem = 200;  // leaves room in the 255 bytes of a file name
  const std::string stem = target.stem().string().substr(0, kLongestStem);
  const std::string number = attempt == 0 ? "" : fmt::format("-{}", attempt);
  const std::string ending = target.extension().string();
  return (target.parent_path() / fmt::format(".{}.partial-{}{}{}", stem, ::getpid(), number, ending)).string();
}

// 0, or the error number. Never opens what is there already.
int create_exclusively(const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  ::close(file);
  return 0;
}

void copy_permissions(const std::string& from, const std::string& to) {
  struct stat status;
  if (::stat(from.c_str(), &status) == 0) ::chmod(to.c_str(), status.st_mode & 0777);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  if (path.empty()) throw std::runtime_error("cannot write: the file name is empty");
  if (is_written_in_place(path)) {
    temporary_path_ = path;
    return;
  }
  std::error_code error;
  const fs::path resolved = fs::canonical(path, error);  // fails where there is no file yet
  const fs::path target = error ? fs::absolute(path) : resolved;
  check_target(path, target);
  target_ = target.string();
  create_temporary();
  copy_permissions(target_, temporary_path_);
}

void AtomicFile::create_temporary() {
  int error_number = EEXIST;
  // Names may be taken: by another AtomicFile for the same path, or by what a killed process left behind.
  for (int attempt = 0; error_number == EEXIST && attempt < 100; ++attempt) {
    temporary_path_ = temporary_name(target_, attempt);
    // Entered before the file is there, so that no interruption falls between.
    slot_ = remember_unfinished_file(temporary_path_);
    if (slot_ < 0) fail(path_, "the path is too long, or too many files are being written");
    error_number = create_exclusively(temporary_path_);
    if (error_number != 0) forget_unfinished_file(slot_);
  }
  if (error_number != 0) fail(path_, error_number);
}

AtomicFile::~AtomicFile() {
  if (slot_ < 0) return;
  ::unlink(temporary_path_.c_str());
  forget_unfinished_file(slot_);
}

void AtomicFile::commit() {
  if (slot_ < 0) return;
  if (std::rename(temporary_path_.c_str(), target_.c_str()) != 0) fail(path_, errno);
  forget_unfinished_file(slot_);
  slot_ = -1;
}

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile target(path);
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file(std::fopen(target.temporary_path().c_str(), "wb"));
  if (!file || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) fail(path, errno);
  if (std::fclose(file.release()) != 0) fail(path, errno);
  target.commit();
}

}  // namespace lkao::image
