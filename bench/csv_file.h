// Measurements written as they come.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

namespace lkao::bench {

// Fails before hours of measuring, not after. Without a path it writes nothing.
class CsvFile {
 public:
  CsvFile(const std::string& path, const std::string& heading) : path_(path) {
    if (path_.empty()) return;
    file_.open(path_);
    write(heading);
  }

  // Throws std::runtime_error with one line.
  void write(const std::string& rows) {
    if (path_.empty()) return;
    file_ << rows << std::flush;
    if (!file_) throw std::runtime_error(path_ + ": cannot be written");
  }

 private:
  std::string path_;
  std::ofstream file_;
};

}  // namespace lkao::bench
