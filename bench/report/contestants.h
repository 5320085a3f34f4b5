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

// What a method means by how much an occluder at a distance counts: rays of the same are what its own assumptions, and
// nothing of its falloff, are told apart by.
enum class OwnFalloff {
  constant,  // that of all rays here
  linear,    // 1 - distance / radius
  alchemy,   // Eq. 8 of the paper, with its intensity
  ball,      // ray ends spread evenly in the ball of VAO
};
inline constexpr method::Word<OwnFalloff> kOwnFalloffWords[] = {{"constant", OwnFalloff::constant},
                                                                {"linear", OwnFalloff::linear},
                                                                {"alchemy", OwnFalloff::alchemy},
                                                                {"ball", OwnFalloff::ball}};

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
  OwnFalloff falloff = OwnFalloff::constant;
  bool is_quick = false;      // takes part in quick reports, and is the last to be left out where time is short
  bool is_for_paper = false;  // takes part for a paper's table alone: at one radius a scene, without a picture

  // What an artist would type; "" where the program has no such command.
  std::string command(const std::string& scene, float radius) const;
  bool is_embree_mode() const { return embree || is_best_embree; }
};

// A column of Table 1 of Alchemy, and its milliseconds there.
struct AlchemyColumn {
  const char* card;
  int samples, bands, filter_width;
  double obscurance, filter;

  // Behind "alchemy, ".
  std::string name(bool is_filtered) const;
};
inline constexpr AlchemyColumn kAlchemyColumns[] = {{"Xbox 360", 3, 1, 11, 2.3, 2.0},
                                                    {"GTX 460 SE", 4, 1, 11, 0.6, 1.6},
                                                    {"GTX 580", 4, 3, 13, 2.0, 1.0},
                                                    {"GTX 580", 3, 3, 13, 1.5, 1.0},
                                                    {"GTX 580", 2, 3, 9, 1.0, 0.7}};

// All of them; those that draw with OpenGL where `has_gl`.
std::vector<Contestant> all_contestants(bool has_gl);

}  // namespace lkao::bench
