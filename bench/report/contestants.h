// Who takes part in a report: ways to answer a view's pixels, each with the command that does the same.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/drawn_method.h"
#include "bench/embree_modes.h"
#include "lkao/pattern_kind.h"
#include "method/words.h"

namespace lkao::bench {

// Levels of detail as --lod has them.
struct ReportLevels {
  float k = 3;
  float epsilon_share = 1;  // of the automatic epsilon
};

// The kinds that are told apart by colour.
enum class Family { query, patterns, tables, levels, embree, raster, volumes, splats, alchemy, vao, gtao, vbao };
inline constexpr method::Word<Family> kFamilyWords[] = {
    {"query", Family::query},     {"patterns", Family::patterns}, {"tables", Family::tables},
    {"levels", Family::levels},   {"embree", Family::embree},     {"raster", Family::raster},
    {"volumes", Family::volumes}, {"splats", Family::splats},     {"alchemy", Family::alchemy},
    {"vao", Family::vao},         {"gtao", Family::gtao},         {"vbao", Family::vbao}};

struct Contestant {
  std::string name;  // unique, such as "query, 128 rays"
  Family family = Family::query;
  std::string method;  // of method::method_words()
  ChangedSettings settings = {};
  int ray_count = 128;
  PatternKind pattern = PatternKind::lloyd;
  int table_resolution = 0;  // 0: the default
  std::optional<ReportLevels> levels = {};
  std::optional<EmbreeMode> embree = {};  // in place of the method,
  bool is_best_embree = false;            // or the mode that is fastest on the subject
  bool has_linear_falloff = false;        // its own, so that it is compared with rays of that
  bool is_quick = false;                  // takes part in quick reports

  // What an artist would type; "" where the program has no such command.
  std::string command(const std::string& scene, float radius) const;
  bool is_embree_mode() const { return embree || is_best_embree; }
};

// All of them; those that draw with OpenGL where `has_gl`.
std::vector<Contestant> all_contestants(bool has_gl);

}  // namespace lkao::bench
