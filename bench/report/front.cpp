#include "bench/report/front.h"

#include <cstddef>
#include <vector>

namespace lkao::bench {
namespace {

struct Place {
  double seconds, rmse;
};

bool beats(const Place& one, const Place& other) {
  return one.seconds <= other.seconds && one.rmse <= other.rmse &&
         (one.seconds < other.seconds || one.rmse < other.rmse);
}

}  // namespace

void add_front(nlohmann::ordered_json& results) {
  std::vector<Place> places;
  places.reserve(results.size());
  for (const auto& result : results) {
    places.push_back({result.at("seconds").get<double>(), result.at("errors").at("rmse").get<double>()});
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::size_t best = i;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (beats(places[k], places[i]) && (best == i || places[k].seconds < places[best].seconds)) best = k;
    }
    results[i]["beaten_by"] = best == i ? nlohmann::ordered_json() : results[best].at("contestant");
  }
}

}  // namespace lkao::bench
