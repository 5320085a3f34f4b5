// Levels of detail on the command line.
#pragma once

#include <string>

#include "cli/progress_bar.h"
#include "cli/report.h"
#include "lod/simplify.h"

namespace lkao::cli {

// What --lod says: a file of lkao simplify, or what to make.
struct LodOption {
  std::string file;     // empty: make the chain
  lod::LevelRule rule;  // epsilon 0: from the radius
};

// "NAME.json", or "k=3,levels=4,epsilon=E,growth=3", of which any may be left out. Throws std::invalid_argument as the
// functions of parse.h do.
LodOption parse_lod(const std::string& text);

// Makes the levels of what blocks in `scene`, or loads them. Throws std::runtime_error with one line where the file
// cannot be read or was made of another mesh.
lod::Chain make_chain(const LodOption& option, const SceneInput& scene, float radius, ProgressBar& progress);

// lod::simplify, watched by the progress bar.
lod::Simplified simplify_watched(const scene::Mesh& mesh, const lod::LevelRule& rule, ProgressBar& progress);

// The chain and which of its levels are in use at this radius.
void add_lod_row(Table& table, const lod::Chain& chain, float radius, double seconds);
Json lod_json(const lod::Chain& chain, float radius, double seconds);

}  // namespace lkao::cli
