// The report as one page that needs nothing beside it.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace lkao::bench {

// The page of these values (measure_report()), as HTML.
std::string make_page(const nlohmann::ordered_json& report);

}  // namespace lkao::bench
