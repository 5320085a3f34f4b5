// Output files that appear complete or not at all, even when the program is interrupted.
#pragma once

#include <string>

namespace lkao::image {

// A temporary file beside `path`, renamed to it by commit() and removed by the destructor otherwise (and by
// remove_unfinished_files(), which is safe to call from a signal handler).
class AtomicFile {
 public:
  // Throws std::runtime_error with one line where the place cannot be written to (no such folder, a directory, not allowed).
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Where to write; has the ending of `path`.
  const std::string& temporary_path() const { return temporary_path_; }
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;
  bool committed_ = false;
};

// Removes the temporary files of every AtomicFile alive. Async-signal-safe.
void remove_unfinished_files();

}  // namespace lkao::image
