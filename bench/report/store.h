// What a report has measured so far, in files of its folder: each is whole or not there, and a program that was stopped
// goes on where it was.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace lkao::bench {

// Of one program: what another build measured counts as not measured.
class ReportStore {
 public:
  // In FOLDER/measured, which is made. Throws std::runtime_error with one line where that cannot be.
  ReportStore(const std::string& folder, std::string program);

  // What was put under this name, by this program; none where there is nothing. A file that is no such thing counts as
  // nothing.
  std::optional<nlohmann::ordered_json> find(const std::string& name) const;
  // Throws std::runtime_error with one line where it cannot be written.
  void put(const std::string& name, const nlohmann::ordered_json& values) const;

  // Pictures, one float a pixel; NaN where there is no receiver.
  std::optional<std::vector<float>> find_picture(const std::string& name, std::size_t pixel_count) const;
  void put_picture(const std::string& name, const std::vector<float>& picture) const;

 private:
  std::string path_of(const std::string& name, const char* ending) const;

  std::string folder_;
  std::string program_;
};

// Of any bytes: tells apart what differs.
std::string fingerprint(std::string_view bytes);
// Tells builds apart: of the program that is running.
std::string program_fingerprint();

}  // namespace lkao::bench
