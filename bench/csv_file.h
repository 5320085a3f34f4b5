// Measurements written as they come, with what they were measured on.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "bench/measurement.h"

namespace lkao::bench {

// Fails before hours of measuring, not after. Without a path it writes nothing. A file that gets no rows is removed:
// the scene could not be loaded.
class CsvFile {
 public:
  // Begins with lines of '#': processor, compiler and commit, then the notes. Throws std::runtime_error with one line.
  CsvFile(const std::string& path, Columns columns, const std::vector<std::string>& notes = {});
  ~CsvFile();
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  // Throws std::runtime_error with one line.
  void write(const Measurement& measurement);

 private:
  void put(const std::string& text);

  Columns columns_;
  bool has_rows_ = false;
  std::string path_;
  std::ofstream file_;
};

// The note of where a figure was computed, none for the CPU.
std::vector<std::string> device_notes(const std::string& device);

}  // namespace lkao::bench
