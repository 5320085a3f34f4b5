#include "bvh/hole_grids.h"

#include <stdexcept>
#include <unordered_map>

#include <tbb/parallel_for.h>

#include "bvh/cut_outs.h"

namespace lkao::bvh {
namespace {

constexpr std::uint32_t kUnseen = 0xffffffffu;

// For all triangles that differ, so that a build of many does not take much longer for them.
constexpr std::size_t kMostSquares = std::size_t{1} << 22;
// A grid is fine enough where no more than this share of the triangle is mixed.
constexpr double kMixedShare = 1.0 / 32;

struct Square {
  int column, row;
};

// One triangle, from one square to many: only those that are mixed are divided.
class Surveyor {
 public:
  Surveyor(const CutOutSurvey& survey, std::uint32_t primitive) : survey_(survey), primitive_(primitive) {}

  // The level, and its parts in `parts`, row by row; those beyond the triangle are mixed.
  int run(int finest, std::vector<CutOutPart>& parts) {
    parts.assign(1, survey_(primitive_, 0, 0, 1));
    std::vector<Square> mixed;
    if (parts[0] == CutOutPart::mixed) mixed.push_back({0, 0});
    int level = 0;
    while (level<finest&& static_cast<double>(mixed.size())> kMixedShare * 0.5 * (1 << (2 * level))) {
      refine(level++, parts);
      mixed = ask(level, mixed, parts);
    }
    return level;
  }

 private:
  // Every square becomes four like it.
  static void refine(int level, std::vector<CutOutPart>& parts) {
    const std::size_t size = std::size_t{1} << level;
    std::vector<CutOutPart> finer(4 * parts.size());
    for (std::size_t row = 0; row < 2 * size; ++row) {
      for (std::size_t column = 0; column < 2 * size; ++column) {
        finer[row * 2 * size + column] = parts[row / 2 * size + column / 2];
      }
    }
    parts.swap(finer);
  }

  // About the quarters of squares of the level above. Returns those that are mixed.
  std::vector<Square> ask(int level, const std::vector<Square>& squares, std::vector<CutOutPart>& parts) const {
    const int size = 1 << level;
    const float width = 1.0f / static_cast<float>(size);
    std::vector<Square> mixed;
    mixed.reserve(4 * squares.size());
    for (const Square& square : squares) {
      for (int i = 0; i < 4; ++i) {
        const Square quarter{2 * square.column + i % 2, 2 * square.row + i / 2};
        // Points with u + v = 1 may be beyond by rounding.
        if (quarter.column + quarter.row > size) continue;
        const CutOutPart part = survey_(primitive_, width * static_cast<float>(quarter.column),
                                        width * static_cast<float>(quarter.row), width);
        parts[static_cast<std::size_t>(quarter.row * size + quarter.column)] = part;
        if (part == CutOutPart::mixed) mixed.push_back(quarter);
      }
    }
    return mixed;
  }

  const CutOutSurvey& survey_;
  std::uint32_t primitive_;
};

// As words of 16.
std::vector<std::uint32_t> packed(const std::vector<CutOutPart>& parts) {
  std::vector<std::uint32_t> words((parts.size() + 15) / 16);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    words[i / 16] |= static_cast<std::uint32_t>(parts[i]) << (2 * (i % 16));
  }
  return words;
}

struct Grid {
  int level = 0;
  std::vector<std::uint32_t> words = {};
};

int finest_of(std::size_t grid_count) {
  int level = HoleGrids::kFinest;
  while (level > 0 && grid_count << (2 * level - 1) > kMostSquares) --level;
  return level;
}

}  // namespace

HoleGrids::HoleGrids(const CutOuts& cut_outs, std::size_t triangle_count) {
  if (!cut_outs.survey) return;
  // One of the triangles of each look, and which look a triangle has.
  std::vector<std::uint32_t> examples, looks(triangle_count, kUnseen);
  std::unordered_map<std::uint32_t, std::uint32_t> known;
  for (std::uint32_t i = 0; i < triangle_count; ++i) {
    if (!has_holes(cut_outs, i)) continue;
    const std::uint32_t name = cut_outs.looks.empty() ? i : cut_outs.looks[i];
    const auto [entry, is_new] = known.try_emplace(name, static_cast<std::uint32_t>(examples.size()));
    if (is_new) examples.push_back(i);
    looks[i] = entry->second;
  }
  std::vector<Grid> grids(examples.size());
  const int finest = finest_of(examples.size());
  tbb::parallel_for(std::size_t{0}, examples.size(), [&](std::size_t i) {
    std::vector<CutOutPart> parts;
    grids[i].level = Surveyor(cut_outs.survey, examples[i]).run(finest, parts);
    grids[i].words = packed(parts);
  });
  // The first word is of what nothing is known of.
  words_.push_back(0);
  std::vector<std::uint32_t> entries(grids.size());
  for (std::size_t i = 0; i < grids.size(); ++i) {
    entries[i] = static_cast<std::uint32_t>(words_.size()) | static_cast<std::uint32_t>(grids[i].level) << kLevelShift;
    words_.insert(words_.end(), grids[i].words.begin(), grids[i].words.end());
  }
  entries_.resize(triangle_count);
  for (std::size_t i = 0; i < triangle_count; ++i) entries_[i] = looks[i] == kUnseen ? 0 : entries[looks[i]];
}

}  // namespace lkao::bvh
