// What a study of the rasterised method prints and writes.
#pragma once

#include <string>
#include <vector>

#include "bench/measurement.h"
#include "bench/raster_frames.h"

namespace lkao::bench {

// One study of a scene at a radius: frames that differ in one thing.
struct RasterStudy {
  std::string scene;
  float radius = 0;
  std::string name;
  std::vector<std::string> variants;
  std::vector<FrameResult> results;  // of each variant
};

// Of each variant. Relative fragments and speed are those of the last variant, as in the paper's Table 2, and unknown
// where fragments were not counted.
std::vector<Measurement> raster_measurements(const RasterStudy& study);
Columns raster_csv_columns();
Columns raster_table_columns();

}  // namespace lkao::bench
