// Holes by transparency of an OBJ: half-transparent, by "d" and by the image of "map_d".
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/formats/alpha_images.h"
#include "scene/formats/cut_outs.h"
#include "scene/formats/file_mesh.h"
#include "scene/formats/obj_materials.h"
#include "scene/formats/readers.h"

namespace lkao::scene {

class ObjHoles {
 public:
  // `decode` empty: nothing is read, and everything is whole. Both must outlive it.
  ObjHoles(const ReadBeside& read_beside, const DecodeAlpha& decode) : read_beside_(read_beside), images_(decode) {}

  // A material that so many triangles have whose FileMesh::materials is `number`. Its image is read now.
  void add(const ObjMaterial& material, std::uint32_t number, std::size_t triangle_count);

  // Whether triangles have holes that are read.
  bool has_any() const { return !materials_.empty(); }

  // Of the triangles of a mesh whose polygons are cut, with materials and texture coordinates.
  std::shared_ptr<const Holes> of(const FileMesh& mesh) const;

  // Says what there is, and what could not be read.
  void describe(Contents& contents);

 private:
  struct Look {
    HoleMaterial material = {};
    glm::dvec2 scale{1}, offset{0};  // as of ObjOpacityMap

    glm::vec2 shown_at(const glm::vec2& uv) const;
  };

  void note_ignored(const ObjMaterial& material);
  std::shared_ptr<const AlphaImage> image_of(const ObjMaterial& material);

  const ReadBeside& read_beside_;
  AlphaImages images_;
  std::map<std::uint32_t, Look> materials_;                                // by number
  std::map<std::string, std::shared_ptr<const AlphaImage>> known_images_;  // by name; null: cannot be read
  std::vector<CutOut> cut_outs_;
  std::string ignored_;  // options of the first material whose map has some that are not obeyed
  std::size_t ignored_count_ = 0;
};

}  // namespace lkao::scene
