// Bases of volumes that are found once and kept while the mesh stays (McGuire 2010, Sec. 5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/gl/objects.h"
#include "gpu/mesh/mesh_buffers.h"
#include "gpu/mesh/shape_lists.h"

namespace lkao::gl {

class KeptVolumes {
 public:
  // What bases depend on.
  struct Key {
    std::uint64_t mesh_version = 0;
    float radius = 0;
    bool clamps_extensions = false;
    bool operator==(const Key&) const = default;
  };

  bool have(const Key& key) const { return key_ == key; }
  void forget() { key_.reset(); }
  // Runs the program "volumes/extend.comp" over all triangles, after `lists` has classified them. Afterwards shaders
  // may read the bases.
  void find(const Key& key, const MeshBuffers& mesh, const ShapeLists& lists, GLuint program);
  // Of one part of the mesh, to LKAO_UNIT_BASES.
  void bind(std::size_t part) const;

 private:
  struct Part {
    explicit Part(std::size_t triangle_count);
    std::size_t capacity;
    Buffer bases;
    Texture texture;
  };

  std::optional<Key> key_;
  std::vector<Part> parts_;
};

}  // namespace lkao::gl
