// The papers' tables and figures, made of what a report has measured, beside the papers' own numbers.
//
// Numbers of: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010 (GTX 480, 1024 x 768);
// M. McGuire, "Ambient Occlusion Volumes", HPG 2010 (GTX 280, 1280 x 720); M. McGuire et al., "The Alchemy Screen-Space
// Ambient Obscurance Algorithm", HPG 2011 (GTX 580); D. Bokšanský et al., "VAO++", 2017 (GTX 970).
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "bench/report/contestants.h"

namespace lkao::bench {

// [{title, note, heading, rows}], of the subjects of measure_report(). A table whose contestants took no part is left
// out.
nlohmann::ordered_json paper_tables(const nlohmann::ordered_json& subjects);

// Shares of a subject's radius at which times are measured for Figure 6 of Laine & Karras and Figure 9 of Alchemy, and
// who is timed.
inline constexpr float kSweptShares[] = {0.25f, 0.5f, 1, 2, 4};
bool is_swept(const Contestant& contestant);

}  // namespace lkao::bench
