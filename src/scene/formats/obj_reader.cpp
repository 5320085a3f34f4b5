// OBJ: a line for every vertex, normal and face; numbers of vertices count from 1, or back from the last with a minus.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/formats/obj_holes.h"
#include "scene/formats/obj_materials.h"
#include "scene/formats/obj_words.h"
#include "scene/formats/readers.h"
#include "scene/formats/text.h"
#include "scene/mesh.h"

namespace lkao::scene {

namespace {

// As they stand in the file: "7", "7/1", "7//2", "7/1/2".
struct Corner {
  std::int64_t position = 0;
  std::int64_t uv = 0;  // 0: none
  std::int64_t normal = 0;
};

// Takes a whole number off a word; 0 where there is none. One too large stays too large.
std::int64_t take_index(const char*& at, const char* end) {
  if (end - at > 1 && at[0] == '+' && at[1] != '-') ++at;
  std::int64_t index = 0;
  const auto [behind, error] = std::from_chars(at, end, index);
  if (error == std::errc::result_out_of_range) {
    index = *at == '-' ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
  }
  at = behind;
  return index;
}

Corner parse_corner(std::string_view word) {
  const char* at = word.data();
  const char* const end = at + word.size();
  const auto take_slash = [&] { return at != end && *at == '/' && (++at, true); };
  Corner corner;
  corner.position = take_index(at, end);
  const bool has_position = at != word.data();
  if (take_slash()) {
    corner.uv = take_index(at, end);
    if (take_slash()) corner.normal = take_index(at, end);
  }
  if (!has_position || at != end) {
    throw std::runtime_error(fmt::format("\"{}\" is not a corner of a face", word.substr(0, 40)));
  }
  return corner;
}

class ObjReader {
 public:
  // Numbers of vertices above `vertex_limit` are refused at once.
  ObjReader(std::string_view text, std::size_t vertex_limit, std::optional<int> uv_set, bool wants_objects)
      : words_(text),
        vertex_limit_(vertex_limit),
        wants_uvs_(uv_set == 0),
        wants_materials_(uv_set.has_value()),
        wants_objects_(wants_objects) {}

  void read() {
    try {
      for (; !words_.is_at_end(); words_.skip_line()) read_line(words_.take_word());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("line {}: {}", words_.line_number(), error.what()));
    }
    if (!has_normals_) mesh_.normals.clear();
    if (mesh_.contents.materials.empty()) mesh_.materials.clear();
    take_objects();
    if (surface_count_ > 0) {
      mesh_.contents.remarks.push_back(fmt::format("{} free-form surfaces are left out", surface_count_));
    }
  }

  // Largest number of a vertex that a face has, counted from 1: faces may stand in front of their vertices.
  std::size_t largest_number() const { return largest_number_; }

  void find_holes(const ReadBeside& read_beside, ObjHoles& holes);

  FileMesh& mesh() { return mesh_; }

 private:
  struct Material {
    std::uint32_t number = 0;  // by first use
    std::size_t triangle_count = 0;
  };

  // Triangles by the name that they stand under; by none at first.
  struct Names {
    std::unordered_map<std::string_view, std::uint32_t> numbers = {{"", 0}};
    std::uint32_t now = 0;
    std::vector<std::uint32_t> of_triangles = {};

    void use(std::string_view name) {
      now = numbers.try_emplace(name, static_cast<std::uint32_t>(numbers.size())).first->second;
    }
    bool has_any() const { return numbers.size() > 1; }
  };

  void take_objects() {
    Names& names = objects_.has_any() ? objects_ : groups_;
    if (!names.has_any()) return;
    mesh_.objects = std::move(names.of_triangles);
    mesh_.contents.object_count = names.numbers.size();
  }

  void read_line(std::string_view keyword) {
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f" || keyword == "fo") {
      read_face();
    } else if (keyword == "vn") {
      read_normal();
    } else if (keyword == "vt") {
      mesh_.contents.uv_set_count = 1;
      if (wants_uvs_) read_uv();
    } else if (keyword == "usemtl") {
      use_material(words_.take_rest());
    } else if (keyword == "o" && wants_objects_) {
      objects_.use(words_.take_rest());
    } else if (keyword == "g" && wants_objects_) {
      groups_.use(words_.take_rest());
    } else if (keyword == "mtllib") {
      libraries_.push_back(words_.take_rest());
    } else if (keyword == "surf" || keyword == "bzp" || keyword == "bsp" || keyword == "cdp") {
      ++surface_count_;
    }
  }

  // What stands behind the coordinates (a weight, a colour) says nothing of the polygons.
  void read_vertex() {
    glm::dvec3 position;
    for (int axis = 0; axis < 3; ++axis) {
      if (!words_.has_word()) throw std::runtime_error(fmt::format("a vertex has {} of 3 coordinates", axis));
      position[axis] = words_.take_number();
    }
    mesh_.positions.push_back(position);
  }

  // One that cannot be read is none, but keeps its number. The second coordinate may be missing.
  void read_uv() {
    try {
      const double u = words_.take_number();
      mesh_.uvs.push_back(from_lower_left(u, words_.has_word() ? words_.take_number() : 0));
    } catch (const std::runtime_error&) {
      mesh_.uvs.emplace_back(std::numeric_limits<float>::quiet_NaN());
    }
  }

  void use_material(std::string_view name) {
    const auto [entry, is_new] = materials_.try_emplace(name);
    if (is_new) {
      entry->second.number = static_cast<std::uint32_t>(materials_.size() - 1);
      if (wants_materials_) mesh_.contents.materials.push_back(printable(name));
    }
    material_ = &entry->second;
  }

  // One that cannot be read is none, but keeps its number.
  void read_normal() {
    glm::dvec3 normal(0.0);
    try {
      for (int axis = 0; axis < 3; ++axis) normal[axis] = words_.take_number();
    } catch (const std::runtime_error&) {
      normal = glm::dvec3(0.0);
    }
    mesh_.normals.emplace_back(normal);
  }

  void read_face() {
    polygon_.clear();
    polygon_normals_.clear();
    polygon_uvs_.clear();
    bool has_normal = false;
    while (words_.has_word()) {
      const Corner corner = parse_corner(words_.take_word());
      polygon_.push_back(position_of(corner.position));
      polygon_normals_.push_back(number_of(corner.normal, mesh_.normals.size(), kNoNormal));
      if (wants_uvs_) polygon_uvs_.push_back(number_of(corner.uv, mesh_.uvs.size(), kNoUv));
      has_normal = has_normal || corner.normal != 0;
    }
    if (has_normal && !has_normals_) {
      has_normals_ = true;
      mesh_.normal_corners.resize(mesh_.triangles.size(), glm::uvec3(kNoNormal));
    }
    const std::size_t count_before = mesh_.triangles.size();
    const std::span<const std::uint32_t> normals(polygon_normals_);
    mesh_.add_polygon(polygon_, has_normals_ ? normals : normals.first(0), polygon_uvs_);
    if (material_ != nullptr) material_->triangle_count += mesh_.triangles.size() - count_before;
    if (wants_objects_) {
      objects_.of_triangles.resize(mesh_.triangles.size(), objects_.now);
      groups_.of_triangles.resize(mesh_.triangles.size(), groups_.now);
    }
    if (wants_materials_) {
      mesh_.materials.resize(mesh_.triangles.size(), material_ != nullptr ? material_->number : kNoMaterial);
    }
  }

  std::uint32_t position_of(std::int64_t number) {
    const auto count = static_cast<std::int64_t>(mesh_.positions.size());
    if (number == 0) throw std::runtime_error("vertex 0 is out of range: they count from 1");
    if (number < -count) {
      throw std::runtime_error(fmt::format("vertex {} is out of range: there are {} so far", number, count));
    }
    if (number > static_cast<std::int64_t>(vertex_limit_)) {
      throw std::runtime_error(fmt::format("vertex {} is out of range: there are {}", number, vertex_limit_));
    }
    const std::int64_t index = number > 0 ? number - 1 : count + number;
    largest_number_ = std::max(largest_number_, static_cast<std::size_t>(index + 1));
    return static_cast<std::uint32_t>(index);
  }

  // One that names nothing is none; those too large may still come and are looked at by the caller.
  static std::uint32_t number_of(std::int64_t number, std::size_t count, std::uint32_t none) {
    const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(count) + number;
    return number != 0 && index >= 0 && index < none ? static_cast<std::uint32_t>(index) : none;
  }

  ObjWords words_;
  std::size_t vertex_limit_;
  bool wants_uvs_;
  bool wants_materials_;
  bool wants_objects_;
  std::size_t largest_number_ = 0;
  FileMesh mesh_;
  bool has_normals_ = false;
  std::size_t surface_count_ = 0;
  std::vector<std::uint32_t> polygon_, polygon_normals_, polygon_uvs_;
  std::vector<std::string_view> libraries_;
  std::unordered_map<std::string_view, Material> materials_;
  Material* material_ = nullptr;  // that faces get now
  Names objects_, groups_;
};

// A library may be several files, or one with blanks in its name. A missing one is no fault: AO needs no materials.
void ObjReader::find_holes(const ReadBeside& read_beside, ObjHoles& holes) {
  std::unordered_set<std::string> done;
  const auto read_library = [&](std::string_view name) {
    if (!done.emplace(name).second) return true;
    const std::optional<std::string> text = read_beside(std::string(name));
    if (!text) return false;
    for (const ObjMaterial& material : see_through_materials(*text)) {
      const auto used = materials_.find(material.name);
      if (used == materials_.end()) continue;
      holes.add(material, used->second.number, used->second.triangle_count);
      used->second.triangle_count = 0;
    }
    return true;
  };
  for (const std::string_view library : libraries_) {
    if (read_library(library)) continue;
    for (ObjWords names(library); names.has_word();) read_library(names.take_word());
  }
}

}  // namespace

FileMesh read_obj(std::string_view bytes, const ReadBeside& read_beside, const MeshWishes& wishes) {
  const std::string_view text = without_byte_order_mark(bytes);
  if (text.find('\0') != text.npos) throw std::runtime_error("malformed OBJ: it is not text");
  // The file has more bytes than vertices, and numbers of vertices must fit 32 bits.
  ObjReader reader(text, std::min<std::size_t>(text.size(), std::numeric_limits<std::uint32_t>::max()), wishes.uv_set,
                   wishes.objects);
  reader.read();
  // Only a second look finds the line of a number that no vertex further down has.
  const std::size_t vertex_count = reader.mesh().positions.size();
  if (reader.largest_number() > vertex_count) ObjReader(text, vertex_count, wishes.uv_set, wishes.objects).read();
  ObjHoles holes(read_beside, wishes.decode_alpha);
  reader.find_holes(read_beside, holes);
  FileMesh mesh = std::move(reader.mesh());
  holes.describe(mesh.contents);
  if (!holes.has_any()) return mesh;
  // Few files have holes: of these, a second look takes what they need.
  ObjReader looks(text, vertex_count, 0, false);
  looks.read();
  cut_polygons(looks.mesh());
  mesh.holes = holes.of(looks.mesh());
  return mesh;
}

}  // namespace lkao::scene
