// The header of a PLY file: elements (vertex, face, ...) with their properties.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::scene::ply {

enum class Type { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

struct Property {
  std::string name;
  Type type = Type::float32;
  bool is_list = false;
  Type count_type = Type::uint8;  // of a list's count
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  // Of the property of this name that is no list; properties.size() where there is none.
  std::size_t index_of(std::string_view property) const;
  bool has(std::string_view property) const { return index_of(property) < properties.size(); }
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  glm::dvec3 origin{0};               // to be added to all positions: "comment origin X Y Z", as write_ply makes it
  std::vector<std::string> textures;  // names of files: "comment TextureFile NAME", as MeshLab makes it
  std::string_view data;              // behind the header
};

// Throws std::runtime_error with the fault.
Header parse_header(std::string_view bytes);

}  // namespace lkao::scene::ply
