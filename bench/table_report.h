// What a study of plane mask tables prints and writes.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/measurement.h"
#include "bench/plane_errors.h"
#include "image/metrics.h"
#include "lkao/kernel.h"
#include "lkao/plane_mask_table.h"

namespace lkao::bench {

// One table in use: on a scene at a radius, or over several of them.
struct TableResult {
  double wrong_rays = 0;  // a receiver
  image::Metrics error;
  std::uint64_t ray_count = 0;
  double seconds = 0;
};

// The plain mean over scenes; times and rays are added up.
TableResult mean(const std::vector<TableResult>& results);

// Of planes, the rays that are wrong, or in doubt where the table knows its doubts.
Measurement table_measurement(const PlaneMaskTable& table, NodeMasks node_masks, const PlaneErrors& planes,
                              const TableResult& result);

// Of table_measurement() with what is known of the scene.
Columns tables_csv_columns();
// Of table_measurement() alone.
Columns tables_table_columns();

}  // namespace lkao::bench
