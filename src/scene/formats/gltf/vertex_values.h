// Values of vertices, as attributes of a glTF's primitives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/contents.h"
#include "scene/formats/gltf/document.h"

namespace lkao::scene::gltf {

// What a node shows of its mesh, a value a vertex.
struct ShownValues {
  // Vertices that primitives of the mesh share.
  struct Group {
    std::vector<std::uint32_t> primitives;
    std::vector<float> values;
    bool operator==(const Group&) const = default;
  };
  std::size_t node;
  std::size_t mesh;
  std::size_t instance_count = 1;
  std::vector<Group> groups;
};

// Of the values of all vertices: means over the instances of a node; 0 where there is none (NaN).
std::vector<ShownValues> values_of_nodes(std::span<const VertexBlock> blocks, std::span<const float> values);

// How an attribute is stored.
struct AttributeCoding {
  const char* name;   // "_OCCLUSION"
  const char* shape;  // "SCALAR"
  std::size_t size;   // bytes of an element, all floats
  // Adds the bytes of an element.
  void (*encode)(float value, std::string& bytes);
};

// Adds the attribute, to the mesh where all nodes that show it have the same values, and to copies of it otherwise.
void add_attribute(Document& document, const std::vector<ShownValues>& shown, const AttributeCoding& coding);

}  // namespace lkao::scene::gltf
