// What a bake into textures found, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "cli/json_output.h"
#include "cli/texture_baking.h"

namespace lkao::cli {

Json texture_document(const BakingOptions& options, const TextureSettings& settings, const TextureBaking& result);

// `written`: names of files.
void print_texture_table(const BakingOptions& options, const TextureSettings& settings, const TextureBaking& result,
                         const std::vector<std::string>& written);

// Lines on stderr: what an artist must know of the texture coordinates.
void report_texture_oddities(const TextureBaking& result);

}  // namespace lkao::cli
