// The report as one page that needs nothing beside it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace lkao::bench {

// One number a pixel, as the page reads them: differences to the left, deflated, in base 64. Throws std::runtime_error
// where memory ends.
std::string encode_picture(const std::vector<std::uint16_t>& picture, int width);
// Occlusion in steps of 1/65000; 65535 where there is no receiver.
std::vector<std::uint16_t> steps_of_occlusion(const std::vector<float>& occlusion);

// Of small counts, which are as they are.
std::vector<std::uint16_t> steps_of_count(const std::vector<float>& counts);

// The page of these values (measure_report()), as HTML.
std::string make_page(const nlohmann::ordered_json& report);

}  // namespace lkao::bench
