// Where errors come from: pictures compared with those that differ from them by one assumption alone.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/report/contestants.h"

namespace lkao::bench {

// What converged rays are called among pictures: "rays", or with a falloff of its own.
std::string rays_of(OwnFalloff falloff);

// The picture of a contestant, or of rays_of() some falloff; none where it took no part.
using FindPicture = std::function<std::optional<std::vector<float>>(const std::string& name)>;

// [{cause, from, to, rmse, bias}]: what changes from one to the other.
nlohmann::ordered_json errors_by_cause(const std::vector<Contestant>& contestants, const FindPicture& find);

}  // namespace lkao::bench
