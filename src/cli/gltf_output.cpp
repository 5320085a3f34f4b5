#include "cli/gltf_output.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace lkao::cli {
namespace {

void write_bytes(const std::string& path, const std::string& bytes, const std::string& name) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error(fmt::format("cannot write '{}'", name));
}

}  // namespace

bool is_gltf(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".gltf" || ending == ".glb";
}

std::unique_ptr<scene::GltfFile> open_gltf(const std::string& scene, const std::string& output) {
  if (!is_gltf(scene)) {
    throw std::invalid_argument(
        fmt::format("--output: '{}' would be a model with all that it has, but '{}' is no .gltf or .glb; write a .ply "
                    "or .obj",
                    output, scene));
  }
  return std::make_unique<scene::GltfFile>(scene, output);
}

void write_gltf(const scene::GltfOutput& result, const std::string& output, const std::string& temporary_path,
                OutputFiles& files) {
  write_bytes(temporary_path, result.bytes, output);
  const std::filesystem::path folder = std::filesystem::path(output).parent_path();
  for (const scene::GltfOutput::File& file : result.beside) {
    const std::string path = (folder / file.name).string();
    write_bytes(files.claim(path), file.bytes, path);
  }
}

}  // namespace lkao::cli
