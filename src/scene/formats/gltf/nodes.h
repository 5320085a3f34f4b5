// The nodes of a glTF: where they stand, and which of them are shown.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/mat4x4.hpp>

#include "scene/formats/gltf/value.h"

namespace lkao::scene::gltf {

class Nodes {
 public:
  // Shown is the document's scene, or its first, or where it has no scenes everything. Throws std::runtime_error where
  // the nodes are no trees.
  explicit Nodes(const Value& root);

  Value node(std::size_t index) const { return root_.at("nodes").element(index); }
  const glm::dmat4& to_world(std::size_t node) const { return to_world_[node]; }

  // The nodes of the scene, each behind its parent, without those that are hidden.
  const std::vector<std::size_t>& shown() const { return shown_; }
  // Nodes of the scene that are hidden, by themselves or with a parent.
  std::size_t hidden_count() const { return hidden_count_; }

 private:
  void read_children();
  std::vector<std::size_t> find_roots() const;
  void place(const std::vector<std::size_t>& roots);
  void show(const std::vector<std::size_t>& roots);
  std::vector<std::size_t> scene_roots() const;

  Value root_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::size_t> parents_;
  std::vector<glm::dmat4> to_world_;
  std::vector<bool> is_hidden_;
  std::vector<std::size_t> shown_;
  std::size_t hidden_count_ = 0;
};

// The rotation of a quaternion x, y, z, w of any length but zero, which stands for none.
glm::dmat4 rotation_of(const glm::dvec4& quaternion);

}  // namespace lkao::scene::gltf
