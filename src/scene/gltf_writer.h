// glTF and GLB out: a file as it was read, with occlusion in it.
//
// Everything else stays as it is. The JSON is changed as a text, in the few places that need it: numbers keep their
// spelling, members their order, and extras and extensions that nobody here knows are kept. Buffers keep their bytes;
// new ones lie behind them in a GLB, and in files beside a .gltf.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/contents.h"
#include "scene/mesh.h"

namespace lkao::scene {

// What occlusion of vertices is written as.
enum class GltfAttribute {
  occlusion,  // _OCCLUSION, a float: 1 = blocked
  colour,     // COLOR_0, three floats: the grey of the visibility, linear as glTF has it; viewers show it
};

// The occlusion of all that has one material.
struct OcclusionMap {
  std::uint32_t material = kNoMaterial;  // a number in Contents::materials; kNoMaterial: of what has none
  std::string png;                       // the bytes of a PNG file: R is the visibility, linear
  bool is_packed = false;                // G and B are roughness and metal, of packed_image()
};

// The image that a material has for occlusion, roughness and metal together.
struct PackedImage {
  std::string name;   // for messages
  std::string bytes;  // of a PNG or JPEG file
};

struct GltfOutput {
  struct File {
    std::string name;  // of a file in the same folder
    std::string bytes;
  };
  std::string bytes;         // of the file itself
  std::vector<File> beside;  // those that a .gltf names, but that were not there before
  std::vector<std::string> remarks;
};

// All throw std::runtime_error with one line naming the file and the fault.
class GltfFile {
 public:
  // Reads the file at `path`, which is to be written to `output`, in any folder, as a .glb if it ends so, as a .gltf
  // otherwise. Files that a .gltf names stay where they are; seen from another folder they are named anew. A .gltf that
  // becomes a .glb takes its first buffer and its PNG and JPEG images in; a .glb that becomes a .gltf has its buffer in
  // a .bin beside.
  GltfFile(const std::string& path, const std::string& output);
  ~GltfFile();
  GltfFile(const GltfFile&) = delete;
  GltfFile& operator=(const GltfFile&) = delete;

  // The files that it names, existing or not: none of them may be overwritten.
  std::vector<std::string> neighbours() const;

  // Throws what with_vertices() would throw, before there is anything to lose: where primitives have COLOR_0 already,
  // or are packed by Draco and stand unpacked beside that, in an order of their own.
  void check_vertices(GltfAttribute attribute) const;

  // `occlusion` has a value for every vertex of the scene, which `contents` says where to find. A mesh that several
  // nodes show is written anew for each that has other values; all that they share is shared still. Instances of one
  // node (EXT_mesh_gpu_instancing) have one mesh, and get their mean; a remark says so. Vertices without a value (NaN)
  // get 0. Throws std::invalid_argument where the number of values is not that of the vertices.
  GltfOutput with_vertices(const Contents& contents, std::span<const float> occlusion, GltfAttribute attribute) const;

  // The image of which a material's map of occlusion can become a part, as its R: where the material has one image for
  // occlusion, roughness and metal, with the same texture coordinates for all, and no other material has it. Nothing
  // otherwise, and where its file is missing or neither PNG nor JPEG.
  std::optional<PackedImage> packed_image(std::uint32_t material, int uv_set) const;

  // Gives each material an occlusionTexture, in the place of one that it has, whose strength stays. The image is its
  // own, or where is_packed becomes that of roughness and metal too. Texture coordinates are TEXCOORD_n, n = uv_set, as
  // open_mesh_file() reads them; primitives without them keep the material as it was. A material has one map at most;
  // throws std::invalid_argument where it is none of the file's.
  GltfOutput with_maps(std::span<const OcclusionMap> maps, int uv_set) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace lkao::scene
