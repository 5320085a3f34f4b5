// What a scene's file holds besides triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lkao::scene {

// Vertices of a mesh that come from one place in a glTF: all those of some primitives of a mesh, as a node shows them.
struct VertexBlock {
  std::size_t node = 0;
  std::size_t instance = 0;  // of those of the node (EXT_mesh_gpu_instancing)
  std::size_t mesh = 0;
  std::vector<std::uint32_t> primitives = {};  // of the mesh; more than one share their vertices
  std::size_t first_vertex = 0;                // the others follow, as the file has them
  std::size_t vertex_count = 0;
};

// What textures show outside of [0, 1]: the same again; again, every other time backwards; or their borders.
enum class TextureWrap { repeat, mirror, clamp };
struct TextureWraps {
  TextureWrap u = TextureWrap::repeat;
  TextureWrap v = TextureWrap::repeat;
  bool operator==(const TextureWraps&) const = default;
};

struct Contents {
  std::size_t node_count = 0;      // places in the scene that show a mesh; 0 where the format knows none
  std::size_t instance_count = 0;  // meshes as often as they are shown
  std::size_t hidden_count = 0;    // nodes that are not shown, by the file's own word
  std::size_t object_count = 0;    // of Mesh::objects, where they were asked for
  std::size_t uv_set_count = 0;    // most texture coordinates that a vertex has
  // Triangles of a material with holes by transparency, read (Mesh::holes) or not: then they block as if whole.
  std::size_t cut_out_count = 0;
  // Their names, where texture coordinates were asked for; those without have "".
  std::vector<std::string> materials = {};
  std::vector<TextureWraps> wraps = {};         // of their textures; of glTF alone
  std::vector<VertexBlock> vertex_blocks = {};  // of all vertices, in their order; of glTF alone
  // One line each, in words: what the file says, is not obeyed, and changes occlusion.
  std::vector<std::string> remarks;
};

}  // namespace lkao::scene
