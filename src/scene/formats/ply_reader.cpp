// PLY: a header, then the records of each element.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/formats/ply_header.h"
#include "scene/formats/ply_values.h"
#include "scene/formats/readers.h"
#include "scene/mesh.h"

namespace lkao::scene {

namespace ply {
namespace {

std::uint32_t to_index(double value, const Element& element, std::size_t record) {
  if (!(value >= 0 && value <= std::numeric_limits<std::uint32_t>::max() && value == std::floor(value))) {
    throw std::runtime_error(fmt::format("{} {} names vertex {}", element.name, record, value));
  }
  return static_cast<std::uint32_t>(value);
}

// Where a property's value goes: one of a few places for what is wanted, and one for all that is not.
enum Place : std::size_t { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kU, kV, kUnwanted, kPlaceCount };

// What programs call the texture coordinates of a vertex.
constexpr std::pair<const char*, const char*> kUvNames[] = {
    {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};

const std::pair<const char*, const char*>* uv_names_of(const Element& vertex) {
  const auto has_both = [&](const auto& names) { return vertex.has(names.first) && vertex.has(names.second); };
  const auto* const names = std::find_if(std::begin(kUvNames), std::end(kUvNames), has_both);
  return names == std::end(kUvNames) ? nullptr : names;
}

std::vector<Place> places_of(const Element& vertex) {
  std::vector<Place> places(vertex.properties.size(), kUnwanted);
  constexpr std::string_view kNames[] = {"x", "y", "z", "nx", "ny", "nz"};
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    if (vertex.has(kNames[i])) places[vertex.index_of(kNames[i])] = static_cast<Place>(i);
  }
  if (const auto* const names = uv_names_of(vertex)) {
    places[vertex.index_of(names->first)] = kU;
    places[vertex.index_of(names->second)] = kV;
  }
  return places;
}

bool has_texture_coordinates(const Element& element) {
  const auto is_one = [](const Property& property) {
    constexpr std::string_view kNames[] = {"s", "u", "texture_u", "texture_s", "texcoord"};
    return std::find(std::begin(kNames), std::end(kNames), property.name) != std::end(kNames);
  };
  return std::any_of(element.properties.begin(), element.properties.end(), is_one);
}

// Makes a mesh of the values.
template <class Values>
class ElementReader {
 public:
  ElementReader(Values values, const Header& header, std::optional<int> uv_set)
      : values_(values), wants_uvs_(uv_set == 0), material_count_(uv_set ? header.textures.size() : 0) {
    mesh_.origin = header.origin;
    if (uv_set) mesh_.contents.materials = header.textures;
  }

  void read(const Element& element) {
    if (element.properties.empty()) return;
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face" || element.name == "tristrips") return read_faces(element);
    for_each_record(element, [&](std::size_t) {
      for (const Property& property : element.properties) skip(property);
    });
  }

  FileMesh finish() && {
    if (!mesh_.normals.empty()) mesh_.normal_corners = mesh_.triangles;
    if (has_corner_uvs_) {
      mesh_.uvs = std::move(corner_uvs_);
      mesh_.uv_corners.resize(mesh_.triangles.size(), glm::uvec3(kNoUv));
    } else if (!mesh_.uvs.empty()) {
      mesh_.uv_corners = mesh_.triangles;
    }
    if (!mesh_.materials.empty()) mesh_.materials.resize(mesh_.triangles.size(), kNoMaterial);
    return std::move(mesh_);
  }

 private:
  template <class Read>
  void for_each_record(const Element& element, const Read& read) {
    for (std::size_t record = 0; record < element.count; ++record) {
      try {
        read(record);
      } catch (const EndOfData&) {
        throw std::runtime_error(
            fmt::format("truncated: the file ends in {} {} of {}", element.name, record, element.count));
      }
      values_.end_record();
    }
  }

  void read_vertices(const Element& element) {
    const std::vector<Place> places = places_of(element);
    const bool has_uvs = wants_uvs_ && uv_names_of(element) != nullptr;
    const bool has_normals = element.has("nx") && element.has("ny") && element.has("nz");
    note_texture_coordinates(element);
    // A damaged count must not reserve more than the data can hold; a vertex takes three bytes at least.
    mesh_.positions.reserve(std::min(element.count, values_.bytes_left() / 3));
    std::array<double, kPlaceCount> taken{};
    for_each_record(element, [&](std::size_t) {
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (element.properties[i].is_list) {
          skip(element.properties[i]);
        } else {
          taken[places[i]] = values_.read(element.properties[i].type);
        }
      }
      mesh_.positions.emplace_back(taken[kX], taken[kY], taken[kZ]);
      if (has_normals) mesh_.normals.emplace_back(taken[kNormalX], taken[kNormalY], taken[kNormalZ]);
      if (has_uvs) mesh_.uvs.push_back(from_lower_left(taken[kU], taken[kV]));
    });
  }

  void read_faces(const Element& element) {
    note_texture_coordinates(element);
    const bool are_strips = element.name == "tristrips";
    // Four numbers a triangle, of a byte each.
    mesh_.triangles.reserve(mesh_.triangles.size() + std::min(element.count, values_.bytes_left() / 4));
    for_each_record(element, [&](std::size_t record) {
      corners_.clear();
      numbers_.clear();
      material_ = material_count_ > 0 ? 0 : kNoMaterial;  // a texture alone needs no numbers
      for (const Property& property : element.properties) {
        if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index")) {
          if (are_strips) {
            read_strip(element, property, record);
          } else {
            read_corners(element, property, record);
          }
        } else if (property.is_list && property.name == "texcoord" && wants_uvs_) {
          read_corner_uvs(property);
        } else if (!property.is_list && property.name == "texnumber" && material_count_ > 0) {
          read_material(property);
        } else {
          skip(property);
        }
      }
      if (!are_strips) add_face();
    });
  }

  void read_corners(const Element& element, const Property& property, std::size_t record) {
    corners_.resize(read_count(property));
    for (std::uint32_t& corner : corners_) corner = to_index(values_.read(property.type), element, record);
  }

  void read_material(const Property& property) {
    const double number = values_.read(property.type);
    const bool is_known = number >= 0 && number < static_cast<double>(material_count_);
    material_ = is_known ? static_cast<std::uint32_t>(number) : kNoMaterial;
  }

  // Two numbers a corner, as MeshLab has them.
  void read_corner_uvs(const Property& property) {
    has_corner_uvs_ = true;
    numbers_.resize(read_count(property));
    for (double& number : numbers_) number = values_.read(property.type);
  }

  void add_face() {
    const std::size_t first_triangle = mesh_.triangles.size();
    polygon_uvs_.clear();
    if (has_corner_uvs_) {
      mesh_.uv_corners.resize(first_triangle, glm::uvec3(kNoUv));
      const bool has_all = numbers_.size() == 2 * corners_.size();
      for (std::size_t i = 0; i < corners_.size(); ++i) {
        polygon_uvs_.push_back(has_all ? static_cast<std::uint32_t>(corner_uvs_.size()) : kNoUv);
        if (has_all) corner_uvs_.push_back(from_lower_left(numbers_[2 * i], numbers_[2 * i + 1]));
      }
    }
    mesh_.add_polygon(corners_, {}, polygon_uvs_);
    if (material_count_ > 0) {
      mesh_.materials.resize(first_triangle, kNoMaterial);
      mesh_.materials.resize(mesh_.triangles.size(), material_);
    }
  }

  // A strip turns the order of corners around at every step; -1 begins a new strip.
  void read_strip(const Element& element, const Property& property, std::size_t record) {
    corners_.clear();
    for (std::size_t left = read_count(property); left > 0; --left) {
      const double value = values_.read(property.type);
      if (value == -1.0) {
        corners_.clear();
        continue;
      }
      corners_.push_back(to_index(value, element, record));
      const std::size_t n = corners_.size();
      if (n < 3) continue;
      const bool odd = n % 2 == 0;
      mesh_.triangles.emplace_back(corners_[odd ? n - 2 : n - 3], corners_[odd ? n - 3 : n - 2], corners_[n - 1]);
    }
  }

  std::size_t read_count(const Property& property) {
    const double count = values_.read(property.count_type);
    if (!(count >= 0 && count == std::floor(count)))
      throw std::runtime_error(fmt::format("a list of {} entries", count));
    if (count > static_cast<double>(values_.bytes_left())) throw EndOfData{};
    return static_cast<std::size_t>(count);
  }

  void skip(const Property& property) {
    for (std::size_t left = property.is_list ? read_count(property) : 1; left > 0; --left) values_.read(property.type);
  }

  void note_texture_coordinates(const Element& element) {
    if (has_texture_coordinates(element)) mesh_.contents.uv_set_count = 1;
  }

  Values values_;
  bool wants_uvs_;
  std::size_t material_count_;
  FileMesh mesh_;
  bool has_corner_uvs_ = false;
  std::vector<glm::vec2> corner_uvs_;  // of faces; they go before those of vertices
  // Of the face that is read:
  std::vector<std::uint32_t> corners_, polygon_uvs_;
  std::vector<double> numbers_;  // its texture coordinates
  std::uint32_t material_ = kNoMaterial;
};

template <class Values>
FileMesh read_elements(const Header& header, Values values, std::optional<int> uv_set) {
  ElementReader<Values> reader(values, header, uv_set);
  for (const Element& element : header.elements) reader.read(element);
  return std::move(reader).finish();
}

}  // namespace
}  // namespace ply

FileMesh read_ply(std::string_view bytes, std::optional<int> uv_set) {
  const ply::Header header = ply::parse_header(bytes);
  if (header.encoding == ply::Encoding::ascii) {
    std::size_t record_count = 0;
    for (const ply::Element& element : header.elements) {
      if (!element.properties.empty()) record_count += element.count;
    }
    return ply::read_elements(header, ply::TextValues(header.data, record_count), uv_set);
  }
  constexpr bool kNativeIsLittle = std::endian::native == std::endian::little;
  const bool is_native = (header.encoding == ply::Encoding::little_endian) == kNativeIsLittle;
  return is_native ? ply::read_elements(header, ply::BinaryValues<false>(header.data), uv_set)
                   : ply::read_elements(header, ply::BinaryValues<true>(header.data), uv_set);
}

}  // namespace lkao::scene
