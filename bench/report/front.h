// Who is on the Pareto front of a subject, and who keeps the others off it.
#pragma once

#include <nlohmann/json.hpp>

namespace lkao::bench {

// Adds "beaten_by" to each result of measure_report(): the fastest of those that are neither slower nor farther off,
// and better in one of the two; null where there is none, so that it is on the front.
void add_front(nlohmann::ordered_json& results);

}  // namespace lkao::bench
