#include "bench/rays_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace lkao::bench {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

// The rows of one file, by the names of their columns.
class Reader {
 public:
  Reader(std::string path, std::string heading) : path_(std::move(path)), columns_(split(heading)) {}

  RaysCsvRow row(const std::string& line) const {
    const std::vector<std::string> fields = split(line);
    if (fields.size() != columns_.size()) {
      throw std::runtime_error(fmt::format("{}: a row of {} columns under a heading of {}: '{}'", path_, fields.size(),
                                           columns_.size(), line));
    }
    const auto field = [&](const char* column) { return fields[place_of(column)]; };
    return {field("scene"),  field("radius"), field("samples"), field("isa"),
            field("method"), field("group"),  field("threads"), ratio(field("ratio_best"))};
  }

 private:
  std::size_t place_of(const std::string& column) const {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    if (found == columns_.end()) throw std::runtime_error(fmt::format("{}: has no column '{}'", path_, column));
    return static_cast<std::size_t>(found - columns_.begin());
  }

  double ratio(const std::string& text) const {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && rest == end && std::isfinite(value) && value > 0) return value;
    throw std::runtime_error(fmt::format("{}: ratio_best must be a number above 0, not '{}'", path_, text));
  }

  std::string path_;
  std::vector<std::string> columns_;
};

}  // namespace

Columns rays_csv_columns() {
  return {{"scene"},
          {"radius", "{:g}"},
          {"samples"},
          {"isa"},
          {"method"},
          {"mrays_per_second", "{:.6g}"},
          {"best_embree_mode"},
          {"best_embree_mrays", "{:.6g}"},
          {"occluded1_mrays", "{:.6g}"},
          {"ratio_best", "{:.5g}"},
          {"ratio_occluded1", "{:.5g}"},
          {"ray_mismatch_rate", "{:.4g}"},
          {"group"},
          {"threads"}};
}

std::vector<Measurement> rays_measurements(const Cell& cell) {
  const MethodResult& best = cell.best_embree();
  const MethodResult& occluded1 = cell.occluded1();
  std::vector<Measurement> measurements;
  for (const MethodResult& result : cell.results) {
    measurements.push_back({{"scene", cell.scene},
                            {"radius", cell.radius},
                            {"samples", cell.ray_count},
                            {"isa", cell.isa.name},
                            {"method", result.method},
                            {"mrays_per_second", result.mrays_per_second},
                            {"best_embree_mode", best.method},
                            {"best_embree_mrays", best.mrays_per_second},
                            {"occluded1_mrays", occluded1.mrays_per_second},
                            {"ratio_best", speed_ratio(result, best)},
                            {"ratio_occluded1", speed_ratio(result, occluded1)},
                            {"ray_mismatch_rate", result.mismatch_rate},
                            {"group", cell.group},
                            {"threads", cell.thread_count}});
  }
  return measurements;
}

RaysCsv read_rays_csv(const std::string& path) {
  std::ifstream file(path);
  RaysCsv csv{path, {}, {}};
  std::string line;
  while (std::getline(file, line) && line.starts_with('#')) csv.comments.push_back(line);
  const Reader reader(path, line);
  while (std::getline(file, line)) csv.rows.push_back(reader.row(line));
  if (!file.is_open() || file.bad()) throw std::runtime_error(fmt::format("{}: cannot be read", path));
  if (csv.rows.empty()) throw std::runtime_error(fmt::format("{}: has no rows", path));
  return csv;
}

}  // namespace lkao::bench
