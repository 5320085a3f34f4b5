#include <string>

#include "bench/csv_file.h"
#include "bench/report/measured.h"
#include "bench/report/report.h"

namespace lkao::bench {
namespace {

using nlohmann::ordered_json;

Columns csv_columns() {
  return {{"scene"},
          {"radius", "{:.6g}"},
          {"contestant"},
          {"family"},
          {"device"},
          {"milliseconds", "{:.5g}"},
          {"query_ratio", "{:.4g}"},
          {"bias", "{:.4g}"},
          {"mae", "{:.4g}"},
          {"rmse", "{:.4g}"},
          {"median", "{:.4g}"},
          {"percentile_95", "{:.4g}"},
          {"percentile_99", "{:.4g}"},
          {"largest", "{:.4g}"},
          {"psnr", "{:.4g}"},
          {"equal_8bit_share", "{:.6f}"},
          {"log_error", "{:.4g}"},
          {"own_falloff"},
          {"own_falloff_rmse", "{:.4g}"},
          {"mismatch_rate", "{:.4g}"},
          {"noise_floor_rmse", "{:.4g}"},
          {"beaten_by"},
          {"left_out"}};
}

// A number of an object, or nothing.
Value number(const ordered_json& object, const char* key) {
  return object.contains(key) && object.at(key).is_number() ? Value(object.at(key).get<double>()) : Value();
}

// A text of an object, or nothing; in quotes, since contestants have commas in their names.
std::string text(const ordered_json& object, const char* key) {
  const bool is_text = object.contains(key) && object.at(key).is_string();
  return is_text ? '"' + object.at(key).get<std::string>() + '"' : std::string();
}

}  // namespace

void write_report_csv(const std::string& folder, const ordered_json& report) {
  const ordered_json figures = to_json(PictureErrors{});
  CsvFile csv(folder + "/report.csv", csv_columns());
  for (const ordered_json& subject : report.at("subjects")) {
    const auto write = [&](const ordered_json& result) {
      Measurement row = {{"scene", subject.at("scene").get<std::string>()},
                         {"radius", number(subject, "radius")},
                         {"contestant", text(result, "contestant")},
                         {"family", result.at("family").get<std::string>()},
                         {"device", text(result, "device")},
                         {"query_ratio", number(result, "query_ratio")},
                         {"own_falloff", text(result, "own_falloff")},
                         {"mismatch_rate", number(result, "mismatch_rate")},
                         {"noise_floor_rmse", number(subject, "noise_floor_rmse")},
                         {"beaten_by", text(result, "beaten_by")},
                         {"left_out", text(result, "left_out")}};
      row.emplace_back("milliseconds",
                       result.contains("seconds") ? Value(1000 * result.at("seconds").get<double>()) : Value());
      const ordered_json errors = result.value("errors", ordered_json::object());
      for (const auto& [key, value] : figures.items()) row.emplace_back(key, number(errors, key.c_str()));
      row.emplace_back("own_falloff_rmse", number(result.value("own_falloff_errors", ordered_json::object()), "rmse"));
      csv.write(row);
    };
    for (const ordered_json& result : subject.at("results")) write(result);
    for (const ordered_json& result : subject.at("left_out")) write(result);
  }
}

}  // namespace lkao::bench
