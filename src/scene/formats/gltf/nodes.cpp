#include "scene/formats/gltf/nodes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace lkao::scene::gltf {

namespace {

constexpr auto kNoParent = static_cast<std::size_t>(-1);

template <typename Vector>
Vector vector_or(const Value& node, const char* key, Vector vector) {
  const std::optional<Value> numbers = node.find(key);
  if (numbers) numbers->numbers({glm::value_ptr(vector), static_cast<std::size_t>(Vector::length())});
  return vector;
}

glm::dmat4 to_parent(const Value& node) {
  if (const std::optional<Value> matrix = node.find("matrix")) {
    glm::dmat4 result;
    matrix->numbers({glm::value_ptr(result), 16});  // by columns, as glm
    return result;
  }
  const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), vector_or(node, "translation", glm::dvec3(0.0)));
  const glm::dmat4 turned = moved * rotation_of(vector_or(node, "rotation", glm::dvec4(0, 0, 0, 1)));
  return glm::scale(turned, vector_or(node, "scale", glm::dvec3(1.0)));
}

bool hides_itself(const Value& node) {
  const std::optional<Value> visibility = node.extension("KHR_node_visibility");
  const std::optional<Value> is_visible = visibility ? visibility->find("visible") : std::nullopt;
  return is_visible && !is_visible->boolean();
}

}  // namespace

glm::dmat4 rotation_of(const glm::dvec4& quaternion) {
  const double length = std::sqrt(glm::dot(quaternion, quaternion));
  if (!(length > 0)) return glm::dmat4(1.0);
  const glm::dvec4 unit = quaternion / length;
  return glm::mat4_cast(glm::dquat(unit.w, unit.x, unit.y, unit.z));
}

Nodes::Nodes(const Value& root)
    : root_(root),
      children_(size_of_list(root, "nodes")),
      parents_(children_.size(), kNoParent),
      to_world_(children_.size()),
      is_hidden_(children_.size()) {
  read_children();
  place(find_roots());
  show(scene_roots());
}

void Nodes::read_children() {
  for (std::size_t i = 0; i < children_.size(); ++i) {
    const std::optional<Value> list = node(i).find("children");
    for (std::size_t k = 0; list && k < list->size(); ++k) {
      item_of_list(root_, "nodes", list->element(k));
      const std::size_t child = list->element(k).count();
      if (parents_[child] != kNoParent) {
        throw std::runtime_error(
            fmt::format("nodes[{}] is a child of nodes[{}] and of nodes[{}]", child, parents_[child], i));
      }
      parents_[child] = i;
      children_[i].push_back(child);
    }
  }
}

std::vector<std::size_t> Nodes::find_roots() const {
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < parents_.size(); ++i) {
    if (parents_[i] == kNoParent) roots.push_back(i);
  }
  return roots;
}

// Parents before children. What cannot be reached from a root is in a circle.
void Nodes::place(const std::vector<std::size_t>& roots) {
  std::vector<bool> is_placed(children_.size());
  std::vector<std::size_t> waiting = roots;
  while (!waiting.empty()) {
    const std::size_t i = waiting.back();
    waiting.pop_back();
    const Value json = node(i);
    const std::size_t parent = parents_[i];
    to_world_[i] = parent == kNoParent ? to_parent(json) : to_world_[parent] * to_parent(json);
    is_hidden_[i] = hides_itself(json) || (parent != kNoParent && is_hidden_[parent]);
    is_placed[i] = true;
    waiting.insert(waiting.end(), children_[i].begin(), children_[i].end());
  }
  const auto lost = std::find(is_placed.begin(), is_placed.end(), false);
  if (lost != is_placed.end()) {
    throw std::runtime_error(fmt::format("nodes[{}] is in a circle of nodes", lost - is_placed.begin()));
  }
}

std::vector<std::size_t> Nodes::scene_roots() const {
  const std::optional<Value> index = root_.find("scene");
  if (!index && size_of_list(root_, "scenes") == 0) return find_roots();
  const Value scene = index ? item_of_list(root_, "scenes", *index) : root_.at("scenes").element(0);
  std::vector<std::size_t> roots;
  const std::optional<Value> list = scene.find("nodes");
  for (std::size_t k = 0; list && k < list->size(); ++k) {
    item_of_list(root_, "nodes", list->element(k));
    roots.push_back(list->element(k).count());
  }
  return roots;
}

void Nodes::show(const std::vector<std::size_t>& roots) {
  std::vector<bool> is_seen(children_.size());
  std::vector<std::size_t> waiting(roots.rbegin(), roots.rend());
  while (!waiting.empty()) {
    const std::size_t i = waiting.back();
    waiting.pop_back();
    // A scene may name a node twice, or a child of another: it is shown once.
    if (is_seen[i]) continue;
    is_seen[i] = true;
    if (is_hidden_[i]) {
      ++hidden_count_;
    } else {
      shown_.push_back(i);
    }
    waiting.insert(waiting.end(), children_[i].rbegin(), children_[i].rend());
  }
}

}  // namespace lkao::scene::gltf
