// Where errors come from: pictures compared with those that differ from them by one assumption alone.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/report/contestants.h"

namespace lkao::bench {

// The picture of a contestant, or of "rays"; none where it took no part.
using FindPicture = std::function<std::optional<std::vector<float>>(const std::string& name)>;

// [{cause, from, to, rmse, bias}]: what changes from one to the other.
nlohmann::ordered_json errors_by_cause(const std::vector<Contestant>& contestants, const FindPicture& find);

}  // namespace lkao::bench
