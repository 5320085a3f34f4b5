// The scene of a glTF as one mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>

#include "scene/formats/cut_outs.h"
#include "scene/formats/file_mesh.h"
#include "scene/formats/gltf/accessors.h"
#include "scene/formats/gltf/holes.h"
#include "scene/formats/gltf/nodes.h"
#include "scene/formats/gltf/shape.h"

namespace lkao::scene::gltf {

class SceneReader {
 public:
  // uv_set: the number of the texture coordinates to read, with materials; neither where it is nothing. `holes` is
  // asked about the same document.
  SceneReader(const Value& root, Buffers& buffers, std::optional<int> uv_set, bool wants_objects, HoleReader holes);

  // Throws std::runtime_error with the fault, std::bad_alloc where the memory is not enough.
  FileMesh read() &&;

 private:
  // A mesh at a node.
  struct Showing {
    std::size_t node;
    std::size_t mesh;
    std::vector<glm::dmat4> instances;
  };

  // How often a mesh is still to be shown, and what it is with its own morph weights.
  struct Use {
    Shape shape;
    std::size_t count = 0;
    bool is_skinned = false;
  };

  // Vertices of a shape where they now are.
  struct Block {
    std::uint32_t first;
    std::uint32_t first_normal;     // kNoNormal where they have none
    std::vector<bool> is_mirrored;  // one a vertex
  };

  void find_showings();
  void read_shapes();
  void reserve();
  void show(const Showing& showing);
  void add(const Showing& showing, const Shape& shape);
  std::vector<std::uint32_t> add_uvs(const Shape& shape);
  template <typename TransformOf>
  void add_instance(const Shape& shape, std::span<const std::uint32_t> first_uvs, VertexBlock source,
                    const TransformOf& transform_of);
  template <typename TransformOf>
  Block add_vertices(const Vertices& vertices, VertexBlock source, const TransformOf& transform_of);
  void add_triangles(const Part& part, const Block& block);
  void add_corner_uvs(const Shape& shape, const Part& part, std::span<const std::uint32_t> first_uvs,
                      const Block& block);
  void add_holes(const Part& part, const Block& block);
  void describe_materials();
  void describe_holes();
  void count_cut_outs(const Part& part);

  Value root_;
  std::optional<int> uv_set_;
  bool wants_objects_;
  Accessors accessors_;
  Nodes nodes_;
  HoleReader hole_reader_;
  ShapeReader shapes_;
  std::vector<Showing> showings_;
  std::map<std::size_t, Use> uses_;         // by mesh
  std::map<std::size_t, CutOut> cut_outs_;  // by material
  Holes holes_;
  FileMesh mesh_;
};

}  // namespace lkao::scene::gltf
