// What a study of the rasterised method prints and writes.
#pragma once

#include <string>
#include <vector>

#include "raster_frames.h"

namespace lkao::bench {

// One study of a scene at a radius: frames that differ in one thing.
struct RasterStudy {
  std::string scene;
  float radius = 0;
  std::string name;
  std::vector<std::string> variants;
  std::vector<FrameResult> results;  // of each variant
};

std::string raster_csv_heading();
std::string raster_csv_rows(const RasterStudy& study);

std::string raster_table_heading();
// Fragments and speed are relative to the last variant that counts any, as in the paper's Table 2.
std::string raster_table_rows(const RasterStudy& study);

}  // namespace lkao::bench
