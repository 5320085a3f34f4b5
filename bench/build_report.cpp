#include "bench/build_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/geometric_mean.h"

namespace lkao::bench {
namespace {

struct Ratios {
  double seconds, cpu_seconds, memory;  // lkao's over the other's
};

std::optional<Ratios> ratios(const BuildCell& cell, BuildMethod method) {
  const BuildResult *own = cell.find(BuildMethod::lkao), *other = cell.find(method);
  if (own == nullptr || other == nullptr) return std::nullopt;
  return Ratios{own->seconds / other->seconds, own->cpu_seconds / other->cpu_seconds,
                own->bytes_per_triangle / other->bytes_per_triangle};
}

// A member of what there may be.
template <class Object, class Member>
Value value(const std::optional<Object>& object, Member Object::*member) {
  return object ? Value((*object).*member) : Value();
}

std::string summarize(const std::vector<BuildCell>& cells, BuildMethod method) {
  std::vector<double> seconds, cpu_seconds, memory;
  for (const BuildCell& cell : cells) {
    const std::optional<Ratios> r = ratios(cell, method);
    if (!r) continue;
    seconds.push_back(r->seconds), cpu_seconds.push_back(r->cpu_seconds), memory.push_back(r->memory);
  }
  if (seconds.empty()) return "";
  const auto text = [](const std::vector<double>& values) {
    return fmt::format("{:.2f} ({:.2f})", geometric_mean(values), *std::max_element(values.begin(), values.end()));
  };
  return fmt::format("lkao over {}, geometric mean (most): time {}, processor time {}, memory {}\n",
                     word_of(kBuildMethodWords, method), text(seconds), text(cpu_seconds), text(memory));
}

}  // namespace

const BuildResult* BuildCell::find(BuildMethod method) const {
  const auto found = std::find_if(results.begin(), results.end(), [&](const auto& r) { return r.method == method; });
  return found == results.end() ? nullptr : &*found;
}

std::vector<Measurement> build_measurements(const BuildCell& cell) {
  std::vector<Measurement> measurements;
  for (const BuildResult& result : cell.results) {
    const std::optional<Ratios> r = ratios(cell, result.method);
    const std::optional<TreeQuality>& q = result.quality;
    measurements.push_back({{"scene", cell.scene},
                            {"triangles", cell.triangle_count},
                            {"threads", cell.thread_count},
                            {"method", word_of(kBuildMethodWords, result.method)},
                            {"seconds", result.seconds},
                            {"cpu_seconds", result.cpu_seconds},
                            {"bytes_per_triangle", result.bytes_per_triangle},
                            {"mesh_bytes_per_triangle", result.mesh_bytes_per_triangle},
                            {"time_ratio", value(r, &Ratios::seconds)},
                            {"cpu_time_ratio", value(r, &Ratios::cpu_seconds)},
                            {"memory_ratio", value(r, &Ratios::memory)},
                            {"nodes", value(q, &TreeQuality::node_count)},
                            {"references", value(q, &TreeQuality::reference_count)},
                            {"sah_nodes", value(q, &TreeQuality::visited_nodes)},
                            {"sah_leaves", value(q, &TreeQuality::visited_leaves)},
                            {"query_us", result.query_microseconds}});
  }
  return measurements;
}

Columns build_csv_columns() {
  return {{"scene"},
          {"triangles"},
          {"threads"},
          {"method"},
          {"seconds", "{:.6g}"},
          {"cpu_seconds", "{:.6g}"},
          {"bytes_per_triangle", "{:.5g}"},
          {"mesh_bytes_per_triangle", "{:.5g}"},
          {"time_ratio", "{:.5g}"},
          {"cpu_time_ratio", "{:.5g}"},
          {"memory_ratio", "{:.5g}"},
          {"nodes"},
          {"references"},
          {"sah_nodes", "{:.5g}"},
          {"sah_leaves", "{:.5g}"},
          {"query_us", "{:.5g}"}};
}

Columns build_quality_columns() {
  return {{"scene", "{}", -16},
          {"threads", "{}", 7},
          {"method", "{}", -15},
          {"nodes", "{}", 9},
          {"references", "{}", 10},
          {"sah_nodes", "{:.2f}", 9, "sah nodes"},
          {"sah_leaves", "{:.2f}", 10, "sah leaves"},
          {"query_us", "{:.3f}", 11, "us/receiver"}};
}

Columns build_table_columns(const std::vector<BuildMethod>& methods) {
  Columns columns = {{"scene", "{}", -16}, {"triangles", "{}", 9}, {"threads", "{}", 7}};
  for (const auto& [word, method] : kBuildMethodWords) {
    if (std::find(methods.begin(), methods.end(), method) == methods.end()) continue;
    const std::string name(word);
    columns.insert(columns.end(),
                   {kBar, {name, "{:.3f} s", 14}, {name + " bytes_per_triangle", "{:.1f}", 8, "bytes/t"}});
    if (method == BuildMethod::lkao) continue;
    columns.insert(columns.end(),
                   {{name + " time_ratio", "{:.2f}", 6, "x time"}, {name + " memory_ratio", "{:.2f}", 8, "x memory"}});
  }
  return columns;
}

Measurement build_table_measurement(const BuildCell& cell) {
  Measurement measurement = {{"scene", cell.scene}, {"triangles", cell.triangle_count}, {"threads", cell.thread_count}};
  for (const auto& [word, method] : kBuildMethodWords) {
    const BuildResult* const result = cell.find(method);
    const std::optional<Ratios> r = ratios(cell, method);
    const std::string name(word);
    measurement.emplace_back(name, result != nullptr ? Value(result->seconds) : Value());
    measurement.emplace_back(name + " bytes_per_triangle",
                             result != nullptr ? Value(result->bytes_per_triangle) : Value());
    measurement.emplace_back(name + " time_ratio", value(r, &Ratios::seconds));
    measurement.emplace_back(name + " memory_ratio", value(r, &Ratios::memory));
  }
  return measurement;
}

std::string build_summary(const std::vector<BuildCell>& cells) {
  std::string summary;
  for (const auto& [word, method] : kBuildMethodWords) {
    if (method != BuildMethod::lkao) summary += summarize(cells, method);
  }
  return summary;
}

}  // namespace lkao::bench
