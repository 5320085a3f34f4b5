// glTF and GLB through assimp. No post-processing step of assimp's is used: its triangulation, merging and
// flattening of nodes may drop triangles. Polygons are fanned, nodes walked and vertices joined here.
#include <algorithm>
#include <stdexcept>

#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/Importer.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "scene/formats/file_check.h"
#include "scene/formats/readers.h"
#include "scene/formats/vertex_joiner.h"

namespace lkao::scene {

namespace {

glm::dmat4 to_glm(const aiMatrix4x4& m) {
  // assimp stores rows, glm columns.
  return {{m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

class SceneFlattener {
 public:
  explicit SceneFlattener(const aiScene& scene) : scene_(scene), joiner_(mesh_.positions) {}

  FileMesh flatten() && {
    if (scene_.mRootNode != nullptr) add_node(*scene_.mRootNode, glm::dmat4(1.0));
    return std::move(mesh_);
  }

 private:
  void add_node(const aiNode& node, const glm::dmat4& parent_to_world) {
    const glm::dmat4 to_world = parent_to_world * to_glm(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add_mesh(*scene_.mMeshes[node.mMeshes[i]], to_world);
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], to_world);
  }

  void add_mesh(const aiMesh& part, const glm::dmat4& to_world) {
    // Untouched where there is nothing to do: 0 x infinity would turn an infinite coordinate into others' NaN.
    const bool is_identity = to_world == glm::dmat4(1.0);
    std::vector<std::uint32_t> indices(part.mNumVertices);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& v = part.mVertices[i];
      const glm::dvec3 position(v.x, v.y, v.z);
      indices[i] = joiner_.index_of(is_identity ? position : glm::dvec3(to_world * glm::dvec4(position, 1.0)));
    }
    // A mirroring transform turns fronts into backs; the other order of corners turns them back.
    const bool is_mirrored = glm::determinant(glm::dmat3(to_world)) < 0;
    for (unsigned i = 0; i < part.mNumFaces; ++i) add_face(part.mFaces[i], indices, is_mirrored);
  }

  void add_face(const aiFace& face, const std::vector<std::uint32_t>& indices, bool is_mirrored) {
    polygon_.clear();
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
      if (face.mIndices[i] >= indices.size()) {
        throw std::runtime_error(fmt::format("a face names vertex {} of {}", face.mIndices[i], indices.size()));
      }
      polygon_.push_back(indices[face.mIndices[i]]);
    }
    if (is_mirrored) std::reverse(polygon_.begin() + (polygon_.empty() ? 0 : 1), polygon_.end());
    mesh_.add_polygon(polygon_);
  }

  const aiScene& scene_;
  FileMesh mesh_;
  VertexJoiner joiner_;
  std::vector<std::uint32_t> polygon_;
};

std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (text.ends_with(' ')) text.pop_back();
  return text.empty() ? "assimp cannot read it" : text;
}

// Faces with three corners or more, over all meshes of the file, each counted once.
std::size_t count_faces(const aiScene& scene) {
  std::size_t count = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    count += static_cast<std::size_t>(
        std::count_if(part.mFaces, part.mFaces + part.mNumFaces, [](const aiFace& f) { return f.mNumIndices >= 3; }));
  }
  return count;
}

}  // namespace

FileMesh read_through_assimp(const std::string& path, std::string_view bytes, const std::string& extension) {
  const std::optional<std::size_t> promised_count = check_file(path, bytes, extension);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr) throw std::runtime_error(one_line(importer.GetErrorString()));
  if (promised_count && count_faces(*scene) != *promised_count) {
    throw std::runtime_error(
        fmt::format("only {} of its {} triangles name vertices that exist", count_faces(*scene), *promised_count));
  }
  return SceneFlattener(*scene).flatten();
}

}  // namespace lkao::scene
