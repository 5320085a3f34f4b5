// Output files that appear complete or not at all, even when the program is interrupted.
#pragma once

#include <string>
#include <string_view>

namespace lkao::image {

// A temporary file beside `path` (".NAME.partial-PID.ending"), renamed to it by commit() and removed by the destructor
// otherwise. For any kind of output: images, meshes, text.
//
// An existing file keeps its permissions, and a symbolic link stays a link: the file it leads to is replaced. What is
// no ordinary file (/dev/stdout, a pipe) cannot be replaced and is written in place; there is nothing atomic then.
//
// Different objects may be used from different threads; at most 64 may be alive at a time.
class AtomicFile {
 public:
  // Makes the temporary file, empty. Throws std::runtime_error with one line naming `path` where nothing can be
  // written there: no such folder, a directory, not allowed, a full disk.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Where to write; has the ending of `path`. Close the file before commit().
  const std::string& temporary_path() const { return temporary_path_; }

  // Puts the file in its place. Throws std::runtime_error with one line naming `path` where that fails.
  void commit();

 private:
  void create_temporary();

  std::string path_;    // as the caller named it
  std::string target_;  // with symbolic links followed
  std::string temporary_path_;
  int slot_ = -1;  // in the table of unfinished files; -1 where there is nothing to remove
};

// Makes a file of these bytes, through an AtomicFile. Throws as AtomicFile does, or where writing fails.
void write_file(const std::string& path, std::string_view bytes);

// Removes the temporary files of every AtomicFile alive. For the end of an interrupted program: their commit() fails
// afterwards. Async-signal-safe.
void remove_unfinished_files();

}  // namespace lkao::image
