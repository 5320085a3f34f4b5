#include "bench/csv_file.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "bench/provenance.h"

namespace lkao::bench {

CsvFile::CsvFile(const std::string& path, Columns columns, const std::vector<std::string>& notes)
    : columns_(std::move(columns)), path_(path) {
  if (path_.empty()) return;
  file_.open(path_);
  std::string text = provenance_comment();
  for (const std::string& note : notes) text += "# " + note + "\n";
  put(text + csv_heading(columns_));
}

CsvFile::~CsvFile() {
  std::error_code ignored;
  if (!has_rows_ && std::filesystem::is_regular_file(path_, ignored)) std::filesystem::remove(path_, ignored);
}

void CsvFile::write(const Measurement& measurement) {
  put(csv_row(columns_, measurement));
  has_rows_ = true;
}

void CsvFile::put(const std::string& text) {
  if (path_.empty()) return;
  file_ << text << std::flush;
  if (!file_) throw std::runtime_error(path_ + ": cannot be written");
}

std::vector<std::string> device_notes(const std::string& device) {
  return device.empty() ? std::vector<std::string>{} : std::vector{"device: " + device};
}

}  // namespace lkao::bench
