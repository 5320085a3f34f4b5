#include "scene/formats/cut_outs.h"

#include <algorithm>

#include <fmt/format.h>

namespace lkao::scene {

void add_cut_outs(std::vector<CutOut> cut_outs, Contents& contents) {
  constexpr std::size_t kNamedCount = 3;
  std::erase_if(cut_outs, [](const CutOut& cut_out) { return cut_out.triangle_count == 0; });
  std::sort(cut_outs.begin(), cut_outs.end(), [](const CutOut& a, const CutOut& b) {
    return a.triangle_count != b.triangle_count ? a.triangle_count > b.triangle_count : a.material < b.material;
  });
  std::size_t other_count = 0;
  for (std::size_t i = 0; i < cut_outs.size(); ++i) {
    const auto& [material, triangle_count] = cut_outs[i];
    contents.cut_out_count += triangle_count;
    if (i < kNamedCount) {
      contents.remarks.push_back(
          fmt::format("material \"{}\" has holes by transparency: its {} triangles block as if "
                      "whole",
                      material, triangle_count));
    } else {
      other_count += triangle_count;
    }
  }
  if (other_count > 0) {
    contents.remarks.push_back(
        fmt::format("{} more materials have holes by transparency: their {} triangles block as "
                    "if whole",
                    cut_outs.size() - kNamedCount, other_count));
  }
}

}  // namespace lkao::scene
