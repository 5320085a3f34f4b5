#include "scene/formats/cut_outs.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

namespace lkao::scene {

namespace {

struct Words {
  const char* what;          // of a material
  const char* what_of_many;  // of several
  const char* consequence;   // for their triangles
};

constexpr Words kUnread = {"has holes by transparency", "have holes by transparency", "block as if whole"};
constexpr Words kBlend = {"is half-transparent", "are half-transparent",
                          "block each ray with the probability of their alpha"};

// Of cut-outs in order.
void add_remarks(std::span<const CutOut> cut_outs, CutOut::Kind kind, const Words& words, Contents& contents) {
  constexpr std::size_t kNamedCount = 3;
  std::size_t count = 0, unnamed_triangle_count = 0;
  for (const CutOut& cut_out : cut_outs) {
    if (cut_out.kind != kind) continue;
    if (++count > kNamedCount) {
      unnamed_triangle_count += cut_out.triangle_count;
      continue;
    }
    contents.remarks.push_back(fmt::format("material \"{}\" {}: its {} triangles {}", cut_out.material, words.what,
                                           cut_out.triangle_count, words.consequence));
  }
  if (count > kNamedCount) {
    contents.remarks.push_back(fmt::format("{} more materials {}: their {} triangles {}", count - kNamedCount,
                                           words.what_of_many, unnamed_triangle_count, words.consequence));
  }
}

}  // namespace

void add_cut_outs(std::vector<CutOut> cut_outs, Contents& contents) {
  std::erase_if(cut_outs, [](const CutOut& cut_out) { return cut_out.triangle_count == 0; });
  std::sort(cut_outs.begin(), cut_outs.end(), [](const CutOut& a, const CutOut& b) {
    return a.triangle_count != b.triangle_count ? a.triangle_count > b.triangle_count : a.material < b.material;
  });
  for (const CutOut& cut_out : cut_outs) contents.cut_out_count += cut_out.triangle_count;
  add_remarks(cut_outs, CutOut::Kind::unread, kUnread, contents);
  add_remarks(cut_outs, CutOut::Kind::blend, kBlend, contents);
}

}  // namespace lkao::scene
