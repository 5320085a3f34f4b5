#include "bench/table_report.h"

#include <algorithm>

#include "bench/table_words.h"
#include "method/speed.h"

namespace lkao::bench {
namespace {

double error_of(const RayErrors& errors, PlaneMasks masks) {
  return masks == PlaneMasks::nearest ? errors.wrong : errors.in_doubt;
}

}  // namespace

TableResult mean(const std::vector<TableResult>& results) {
  TableResult sum;
  const auto share = 1.0 / static_cast<double>(results.size());
  for (const TableResult& result : results) {
    sum.wrong_rays += share * result.wrong_rays;
    sum.error.mae += share * result.error.mae;
    sum.error.rmse += share * result.error.rmse;
    sum.error.equal_8bit_share += share * result.error.equal_8bit_share;
    sum.error.max_error = std::max(sum.error.max_error, result.error.max_error);
    sum.ray_count += result.ray_count;
    sum.seconds += result.seconds;
  }
  return sum;
}

Measurement table_measurement(const PlaneMaskTable& table, NodeMasks node_masks, const PlaneErrors& planes,
                              const TableResult& result) {
  const PlaneMaskTableOptions& options = table.options();
  return {{"rays", table.pattern().ray_count()},
          {"resolution", options.resolution},
          {"addressing", word_of(kAddressingWords, options.addressing)},
          {"masks", word_of(method::kPlaneMaskWords, options.masks)},
          {"node_masks", word_of(kNodeMaskWords, node_masks)},
          {"bytes", table.memory_bytes()},
          {"mib", static_cast<double>(table.memory_bytes()) / 0x1p20},
          {"build_seconds", table.build_seconds()},
          {"edge_rays", error_of(planes.edge, options.masks)},
          {"plane_rays", error_of(planes.plane, options.masks)},
          {"triangle_rays", error_of(planes.triangle, options.masks)},
          {"wrong_receiver_rays", result.wrong_rays},
          {"mae", result.error.mae},
          {"rmse", result.error.rmse},
          {"max_error", result.error.max_error},
          {"exact_8bit_share", result.error.equal_8bit_share},
          {"mrays_per_second", method::mrays_per_second(result.ray_count, result.seconds)}};
}

Columns tables_csv_columns() {
  return {{"scene"},
          {"radius", "{:g}"},
          {"receivers"},
          {"rays"},
          {"resolution"},
          {"addressing"},
          {"masks"},
          {"node_masks"},
          {"bytes"},
          {"build_seconds", "{:.4f}"},
          {"edge_rays", "{:.5f}"},
          {"plane_rays", "{:.5f}"},
          {"triangle_rays", "{:.5f}"},
          {"wrong_receiver_rays", "{:.6f}"},
          {"mae", "{:.8f}"},
          {"rmse", "{:.8f}"},
          {"max_error", "{:.6f}"},
          {"exact_8bit_share", "{:.6f}"},
          {"mrays_per_second", "{:.3f}"},
          {"scalar_mrays_per_second", "{:.3f}"},
          {"simd_mrays_per_second", "{:.3f}"}};
}

Columns tables_table_columns() {
  return {{"rays", "{}", 5},
          {"resolution", "{}", 5, "res."},
          {"addressing", "{}", -7, "cells"},
          {"masks", "{}", -8},
          {"node_masks", "{}", -7, "nodes"},
          {"mib", "{:.1f}", 7, "MiB"},
          {"build_seconds", "{:.3f}", 7, "build/s"},
          {"edge_rays", "{:.3f}", 6, "edge"},
          {"plane_rays", "{:.3f}", 6, "plane"},
          {"triangle_rays", "{:.4f}", 8, "triangle"},
          {"wrong_receiver_rays", "{:.4f}", 8, "receiver"},
          {"mae", "{:.6f}", 8, "MAE"},
          {"rmse", "{:.6f}", 8, "RMSE"},
          {"exact_8bit_share", "{:.4f}", 6, "exact"},
          {"mrays_per_second", "{:.2f}", 7, "Mrays/s"}};
}

}  // namespace lkao::bench
