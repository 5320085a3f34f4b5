// What a study of sample patterns prints and writes.
#pragma once

#include <string>
#include <vector>

#include "bench/measurement.h"
#include "bench/pattern_errors.h"

namespace lkao::bench {

struct PatternRow {
  std::string scene;
  PatternError error;
};

Columns patterns_csv_columns();
Measurement pattern_measurement(const PatternRow& row);

// Tables for the documents: by kind for each falloff, by scene, by falloff and by jitter; then the time that it takes
// to make a pattern.
void print_pattern_tables(const std::vector<PatternRow>& rows);

}  // namespace lkao::bench
