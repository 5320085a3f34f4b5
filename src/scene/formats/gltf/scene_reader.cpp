#include "scene/formats/gltf/scene_reader.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "scene/formats/gltf/instances.h"
#include "scene/formats/gltf/skin.h"
#include "scene/formats/gltf/transform.h"
#include "scene/formats/text.h"
#include "scene/mesh.h"

namespace lkao::scene::gltf {

SceneReader::SceneReader(const Value& root, Buffers& buffers, std::optional<int> uv_set, bool wants_objects,
                         HoleReader holes)
    : root_(root),
      uv_set_(uv_set),
      wants_objects_(wants_objects),
      accessors_(root, buffers),
      nodes_(root),
      hole_reader_(std::move(holes)),
      shapes_(root, accessors_, buffers, uv_set, hole_reader_) {}

FileMesh SceneReader::read() && {
  find_showings();
  read_shapes();
  reserve();
  for (const Showing& showing : showings_) show(showing);
  if (mesh_.normals.empty()) mesh_.normal_corners.clear();
  if (uv_set_) describe_materials();
  mesh_.contents.hidden_count = nodes_.hidden_count();
  describe_holes();
  return std::move(mesh_);
}

void SceneReader::find_showings() {
  for (const std::size_t number : nodes_.shown()) {
    const Value node = nodes_.node(number);
    const std::optional<Value> mesh = node.find("mesh");
    if (!mesh) continue;
    item_of_list(root_, "meshes", *mesh);
    showings_.push_back({number, mesh->count(), read_instances(node, accessors_)});
    Use& use = uses_[mesh->count()];
    ++use.count;
    use.is_skinned = use.is_skinned || node.find("skin").has_value();
    ++mesh_.contents.node_count;
    mesh_.contents.instance_count += showings_.back().instances.size();
  }
}

void SceneReader::read_shapes() {
  for (auto& [mesh, use] : uses_) use.shape = shapes_.read(root_.at("meshes").element(mesh), {}, use.is_skinned);
}

// All at once: counts beyond reason end here, before memory is filled.
void SceneReader::reserve() {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  double vertex_count = 0;
  double triangle_count = 0;
  for (const Showing& showing : showings_) {
    const Shape& shape = uses_.at(showing.mesh).shape;
    const auto instance_count = static_cast<double>(showing.instances.size());
    vertex_count += instance_count * static_cast<double>(shape.vertex_count());
    triangle_count += instance_count * static_cast<double>(shape.triangle_count());
  }
  if (vertex_count >= kMost || triangle_count >= kMost) {
    throw std::runtime_error(fmt::format("with all instances it has {:.0f} vertices and {:.0f} triangles, over 2^32",
                                         vertex_count, triangle_count));
  }
  mesh_.positions.reserve(static_cast<std::size_t>(vertex_count));
  mesh_.triangles.reserve(static_cast<std::size_t>(triangle_count));
  mesh_.normal_corners.reserve(static_cast<std::size_t>(triangle_count));
  if (!uv_set_) return;
  mesh_.uv_corners.reserve(static_cast<std::size_t>(triangle_count));
  mesh_.materials.reserve(static_cast<std::size_t>(triangle_count));
}

void SceneReader::show(const Showing& showing) {
  Use& use = uses_.at(showing.mesh);
  if (const std::optional<Value> weights = nodes_.node(showing.node).find("weights")) {
    add(showing, shapes_.read(root_.at("meshes").element(showing.mesh), weights, use.is_skinned));
  } else {
    add(showing, use.shape);
  }
  if (--use.count == 0) use.shape = {};
}

void SceneReader::add(const Showing& showing, const Shape& shape) {
  const std::optional<Value> index = nodes_.node(showing.node).find("skin");
  std::optional<Skin> skin;
  if (index) skin.emplace(root_, item_of_list(root_, "skins", *index), nodes_, accessors_);
  const std::vector<std::uint32_t> first_uvs = add_uvs(shape);
  for (std::size_t i = 0; i < showing.instances.size(); ++i) {
    const Transform transform(nodes_.to_world(showing.node) * showing.instances[i]);
    const VertexBlock source{.node = showing.node, .instance = i, .mesh = showing.mesh};
    add_instance(shape, first_uvs, source, [&](const Vertices& vertices, std::size_t k) {
      // The joints alone place a skinned mesh, wherever its own node is.
      return skin && !vertices.influences.empty() ? Transform(skin->matrix_of(vertices, k)) : transform;
    });
  }
}

// All instances have the same. Returns where each list of the shape begins.
std::vector<std::uint32_t> SceneReader::add_uvs(const Shape& shape) {
  std::vector<std::uint32_t> firsts;
  firsts.reserve(shape.uvs.size());
  for (const std::vector<glm::vec2>& uvs : shape.uvs) {
    firsts.push_back(static_cast<std::uint32_t>(mesh_.uvs.size()));
    mesh_.uvs.insert(mesh_.uvs.end(), uvs.begin(), uvs.end());
  }
  return firsts;
}

// transform_of(vertices, k): what moves a vertex into the world.
template <typename TransformOf>
void SceneReader::add_instance(const Shape& shape, std::span<const std::uint32_t> first_uvs, VertexBlock source,
                               const TransformOf& transform_of) {
  std::vector<Block> blocks;
  for (const Vertices& vertices : shape.vertices) blocks.push_back(add_vertices(vertices, source, transform_of));
  for (const Part& part : shape.parts) {
    add_triangles(part, blocks[part.vertices]);
    if (uv_set_) add_corner_uvs(shape, part, first_uvs, blocks[part.vertices]);
    if (!part.holes.empty()) add_holes(part, blocks[part.vertices]);
    count_cut_outs(part);
    mesh_.contents.uv_set_count = std::max(mesh_.contents.uv_set_count, part.uv_set_count);
  }
  if (!wants_objects_) return;
  mesh_.objects.resize(mesh_.triangles.size(), static_cast<std::uint32_t>(mesh_.contents.object_count));
  ++mesh_.contents.object_count;
}

template <typename TransformOf>
SceneReader::Block SceneReader::add_vertices(const Vertices& vertices, VertexBlock source,
                                             const TransformOf& transform_of) {
  source.first_vertex = mesh_.positions.size();
  source.vertex_count = vertices.positions.size();
  source.primitives = vertices.primitives;
  mesh_.contents.vertex_blocks.push_back(std::move(source));
  Block block{static_cast<std::uint32_t>(mesh_.positions.size()), kNoNormal, {}};
  if (!vertices.normals.empty()) block.first_normal = static_cast<std::uint32_t>(mesh_.normals.size());
  for (std::size_t i = 0; i < vertices.positions.size(); ++i) {
    const Transform transform = transform_of(vertices, i);
    mesh_.positions.push_back(transform.position(vertices.positions[i]));
    if (!vertices.normals.empty()) mesh_.normals.push_back(transform.normal(vertices.normals[i]));
    block.is_mirrored.push_back(transform.is_mirroring());
  }
  return block;
}

void SceneReader::add_triangles(const Part& part, const Block& block) {
  const bool has_normals = block.first_normal != kNoNormal;
  for (glm::uvec3 corners : part.triangles) {
    // Mirrored, a triangle shows its back; the other order of corners turns it round.
    if (block.is_mirrored[corners.x]) std::swap(corners.y, corners.z);
    mesh_.triangles.push_back(corners + block.first);
    mesh_.normal_corners.push_back(has_normals ? corners + block.first_normal : glm::uvec3(kNoNormal));
  }
}

void SceneReader::add_corner_uvs(const Shape& shape, const Part& part, std::span<const std::uint32_t> first_uvs,
                                 const Block& block) {
  const std::size_t material_count = size_of_list(root_, "materials");
  const bool is_known = part.material && *part.material < material_count;
  mesh_.materials.resize(mesh_.triangles.size(), is_known ? static_cast<std::uint32_t>(*part.material) : kNoMaterial);
  if (!part.uvs) {
    mesh_.uv_corners.resize(mesh_.triangles.size(), glm::uvec3(kNoUv));
    return;
  }
  for (glm::uvec3 corners : part.triangles) {
    if (block.is_mirrored[corners.x]) std::swap(corners.y, corners.z);
    if (!part.uvs->transform) {
      mesh_.uv_corners.push_back(corners + first_uvs[part.uvs->list]);
      continue;
    }
    // Each corner has its own: lists of vertices may be shared by any number of materials.
    const auto first = static_cast<std::uint32_t>(mesh_.uvs.size());
    for (int i = 0; i < 3; ++i) {
      mesh_.uvs.emplace_back((*part.uvs->transform)(shape.uvs[part.uvs->list][corners[i]]));
    }
    mesh_.uv_corners.emplace_back(first, first + 1, first + 2);
  }
}

// Of the triangles that were added last.
void SceneReader::add_holes(const Part& part, const Block& block) {
  holes_.numbers.resize(mesh_.triangles.size() - part.triangles.size(), kWhole);
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    HoleTriangle holes = part.holes[t];
    if (holes.material == kWhole) {
      holes_.numbers.push_back(kWhole);
      continue;
    }
    if (block.is_mirrored[part.triangles[t].x]) holes.turn_round();
    holes_.numbers.push_back(static_cast<std::uint32_t>(holes_.triangles.size()));
    holes_.triangles.push_back(holes);
  }
}

void SceneReader::describe_materials() {
  const std::size_t count = size_of_list(root_, "materials");
  mesh_.contents.materials.reserve(count);
  mesh_.contents.wraps.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Value material = root_.at("materials").element(i);
    const std::optional<Value> name = material.find("name");
    mesh_.contents.materials.push_back(name ? printable(name->text()) : "");
    mesh_.contents.wraps.push_back(wraps_of(root_, material, static_cast<std::size_t>(*uv_set_)));
  }
}

void SceneReader::describe_holes() {
  if (!holes_.triangles.empty()) {
    holes_.numbers.resize(mesh_.triangles.size(), kWhole);
    holes_.materials = hole_reader_.take_materials();
    mesh_.holes = std::make_shared<const Holes>(std::move(holes_));
  }
  std::vector<CutOut> cut_outs;
  cut_outs.reserve(cut_outs_.size());
  for (const auto& [material, cut_out] : cut_outs_) cut_outs.push_back(cut_out);
  add_cut_outs(std::move(cut_outs), mesh_.contents);
  for (std::string& remark : hole_reader_.remarks()) mesh_.contents.remarks.push_back(std::move(remark));
}

void SceneReader::count_cut_outs(const Part& part) {
  if (!part.material || *part.material >= size_of_list(root_, "materials")) return;
  const Value material = root_.at("materials").element(*part.material);
  const AlphaMode mode = alpha_mode_of(material);
  if (mode == AlphaMode::opaque || (hole_reader_.is_reading() && part.holes.empty())) return;
  CutOut& cut_out = cut_outs_[*part.material];
  cut_out.material = name_of(material);
  const auto has_holes = [](const HoleTriangle& holes) { return holes.material != kWhole; };
  cut_out.triangle_count += part.holes.empty() ? part.triangles.size()
                                               : static_cast<std::size_t>(std::ranges::count_if(part.holes, has_holes));
  if (part.holes.empty()) return;
  cut_out.kind = mode == AlphaMode::mask ? CutOut::Kind::mask : CutOut::Kind::blend;
}

}  // namespace lkao::scene::gltf
