#include "bench/report/causes.h"

#include <string_view>

#include <fmt/format.h>

#include "method/deviation.h"

namespace lkao::bench {
namespace {

struct Cause {
  std::string text, from, to;
};

constexpr const char* kExact = "query, 128 rays";

void add_causes_of(const Contestant& contestant, std::vector<Cause>& causes) {
  const std::string& name = contestant.name;
  const std::string rays = rays_of(OwnFalloff::constant);
  const auto add = [&](const char* text, const std::string& to) { causes.push_back({text, name, to}); };
  switch (contestant.family) {
    case Family::query:
      return add("rays: their number", rays);
    case Family::patterns:
      return add("rays: how they are spread", rays);
    case Family::tables:
      return add("table cells", kExact);
    case Family::levels:
      return add(contestant.method == "bvh" ? "levels of detail" : "levels of detail, and table cells", kExact);
    case Family::raster:
      return add("table cells, and floats", kExact);
    case Family::volumes:
      return add("the method's assumptions, falloff apart", rays_of(contestant.falloff));
    case Family::splats:
      return add("the method's assumptions", rays);
    case Family::embree:
      return;
    default:
      break;
  }
  // In screen space.
  const std::string own = contestant.method, converged = own + ", converged", unfiltered = own + ", no filter";
  if (name == converged) {
    return add(contestant.falloff == OwnFalloff::constant ? "what the screen shows, and assumptions"
                                                          : "what the screen shows, and assumptions, falloff apart",
               rays_of(contestant.falloff));
  }
  if (name == unfiltered) return add("the estimator: few samples", converged);
  if (name == own) return add("the filter", unfiltered);
}

// From rays of the falloffs that some have to those of the one that all are compared with.
void add_falloffs(std::vector<Cause>& causes) {
  for (const OwnFalloff falloff : {OwnFalloff::linear, OwnFalloff::alchemy, OwnFalloff::ball}) {
    causes.push_back({fmt::format("the falloff alone: {}", word_of(kOwnFalloffWords, falloff)), rays_of(falloff),
                      rays_of(OwnFalloff::constant)});
  }
}

}  // namespace

std::string rays_of(OwnFalloff falloff) {
  if (falloff == OwnFalloff::constant) return "rays";
  return fmt::format("rays, falloff {}", word_of(kOwnFalloffWords, falloff));
}

nlohmann::ordered_json errors_by_cause(const std::vector<Contestant>& contestants, const FindPicture& find) {
  std::vector<Cause> causes;
  for (const Contestant& contestant : contestants) add_causes_of(contestant, causes);
  add_falloffs(causes);
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& [text, from, to] : causes) {
    const auto one = find(from), other = find(to);
    if (!one || !other) continue;
    const method::Deviation change = method::deviation(*one, *other, std::nullopt, 0);
    all.push_back(
        {{"cause", text}, {"from", from}, {"to", to}, {"rmse", change.error.rmse}, {"bias", change.mean_change}});
  }
  return all;
}

}  // namespace lkao::bench
