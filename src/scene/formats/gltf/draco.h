// KHR_draco_mesh_compression: primitives as Draco packs them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace draco {
class Mesh;
}

namespace lkao::scene::gltf {

// A primitive, unpacked. Throws std::runtime_error naming `place` where the bytes are damaged.
class DracoMesh {
 public:
  DracoMesh(std::string_view bytes, std::string place);
  ~DracoMesh();
  DracoMesh(DracoMesh&&) noexcept;
  DracoMesh& operator=(DracoMesh&&) noexcept;

  std::size_t vertex_count() const;
  // As a list of triangles, three each.
  std::vector<std::uint32_t> indices() const;
  // The attribute of that number, `width` numbers a vertex, one vertex behind the other.
  void read(std::size_t attribute, std::size_t width, bool is_normalized, double* out) const;

 private:
  std::string place_;
  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace lkao::scene::gltf
