// What a bake into textures writes.
#pragma once

#include <string>
#include <vector>

#include "cli/output_files.h"
#include "cli/texture_baking.h"
#include "scene/gltf_writer.h"

namespace lkao::cli {

// Throws std::invalid_argument or std::runtime_error where textures cannot be written to `output`: its ending, its
// folder, the settings.
void check_texture_output(const std::string& output, const TextureSettings& settings);

// Writes the maps as images, claimed from `outputs`: visibility, 1 less the occlusion, linear; in an .exr with the
// share of each texel that triangles cover, and with bent normals; in a .png as grey, with bent normals in a second
// one, each component v as v / 2 + 1/2. Where there are several maps, the name of each has its material, its UDIM
// number or both in it: "ao.brass.1001.png". With a model, writes that with the maps in it instead. Returns the names.
std::vector<std::string> write_textures(const std::string& output, const TextureBaking& result,
                                        const TextureSettings& settings, const scene::GltfFile* model,
                                        OutputFiles& outputs);

}  // namespace lkao::cli
