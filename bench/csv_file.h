// Measurements written as they come.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace lkao::bench {

// Fails before hours of measuring, not after. Without a path it writes nothing. A file that gets no rows is removed:
// the scene could not be loaded.
class CsvFile {
 public:
  CsvFile(const std::string& path, const std::string& heading) : path_(path) {
    if (path_.empty()) return;
    file_.open(path_);
    put(heading);
  }

  ~CsvFile() {
    std::error_code ignored;
    if (!has_rows_ && std::filesystem::is_regular_file(path_, ignored)) std::filesystem::remove(path_, ignored);
  }
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  // Throws std::runtime_error with one line.
  void write(const std::string& rows) {
    put(rows);
    has_rows_ = true;
  }

 private:
  void put(const std::string& text) {
    if (path_.empty()) return;
    file_ << text << std::flush;
    if (!file_) throw std::runtime_error(path_ + ": cannot be written");
  }

  bool has_rows_ = false;
  std::string path_;
  std::ofstream file_;
};

}  // namespace lkao::bench
