#include "scene/formats/cut_outs.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lkao::scene {

namespace {

// 1,200 for 1200.
std::string with_commas(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return digits;
}

}  // namespace

void CutOuts::report(Contents& contents) const {
  constexpr std::size_t kMostLines = 4;
  std::vector<std::pair<std::string, std::size_t>> materials(counts_.begin(), counts_.end());
  std::stable_sort(materials.begin(), materials.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::size_t other_count = 0;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const auto& [name, count] = materials[i];
    contents.cut_out_count += count;
    if (i >= kMostLines) {
      other_count += count;
      continue;
    }
    contents.remarks.push_back(fmt::format("material {} has holes by transparency: its {} triangles block as if whole",
                                           name, with_commas(count)));
  }
  if (other_count == 0) return;
  contents.remarks.push_back(
      fmt::format("{} more materials have holes by transparency: their {} triangles block as if whole",
                  materials.size() - kMostLines, with_commas(other_count)));
}

}  // namespace lkao::scene
