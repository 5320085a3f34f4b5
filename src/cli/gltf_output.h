// A model that is written as it was read, with its occlusion in it.
#pragma once

#include <memory>
#include <string>

#include "cli/output_files.h"
#include "scene/gltf_writer.h"

namespace lkao::cli {

// Whether a name ends as glTF's do.
bool is_gltf(const std::string& path);

// Opens the scene, which is to be written to `output`. Throws std::invalid_argument naming --output where the scene is
// none that can be written so.
std::unique_ptr<scene::GltfFile> open_gltf(const std::string& scene, const std::string& output);

// Writes the file to the temporary path that was claimed for `output`, and claims and writes what is to lie beside it.
void write_gltf(const scene::GltfOutput& result, const std::string& output, const std::string& temporary_path,
                OutputFiles& files);

}  // namespace lkao::cli
