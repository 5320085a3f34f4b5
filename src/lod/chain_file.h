// Chains in files: a JSON document that names the epsilons, the ranges and one PLY file a level beside it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lod/chain.h"

namespace lkao::lod {

// The files of a chain: `path` itself, which must end in ".json", then for "NAME.json" "NAME.0.ply", "NAME.1.ply" and
// so on. Throws std::invalid_argument where the path has another ending.
std::vector<std::string> chain_files(const std::string& path, std::size_t level_count);

// Writes the files of chain_files(path, ...) to `targets`, one for each: the same names, or temporary ones that the
// caller renames when all are complete. Throws std::runtime_error with one line naming the file that cannot be written.
void write_chain(const Chain& chain, const std::string& path, std::span<const std::string> targets);

// Bit for bit what was written. The meshes' origin is `origin`, or without it that of level 0. Throws
// std::runtime_error with one line naming the file, the place in it and the fault: missing, no such document, epsilons
// or ranges that make no chain, a mesh that does not fit.
Chain load_chain(const std::string& path, const std::optional<glm::dvec3>& origin = {});

}  // namespace lkao::lod
