// What only papers ask for: time against the radius, and what culling saves.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/report/budget.h"
#include "bench/report/contestants.h"
#include "bench/report/store.h"
#include "bench/report/subject.h"

namespace lkao::bench {

struct PaperStudies {
  PreparedScene& scene;
  const Subject& subject;
  const std::vector<Contestant>& contestants;
  const ReportStore& store;
  int round_count;
  Budget time;  // what does not fit in it is left out

  // Times of some contestants at shares of the radius: [{radius, CONTESTANT: seconds or null}]. `results` of the
  // subject tell which of Embree's modes is best.
  nlohmann::ordered_json sweep(const nlohmann::ordered_json& results);
  // Table 2 of Laine & Karras, {width, height, rows: [{tests, fragments, speed}]}, of the largest picture that there is
  // time for; null where there is none.
  nlohmann::ordered_json culls();
};

}  // namespace lkao::bench
