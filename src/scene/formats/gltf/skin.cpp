#include "scene/formats/gltf/skin.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace lkao::scene::gltf {

Skin::Skin(const Value& root, const Value& skin, const Nodes& nodes, Accessors& accessors) : place_(skin.place()) {
  const Value joints = skin.at("joints");
  for (std::size_t i = 0; i < joints.size(); ++i) {
    item_of_list(root, "nodes", joints.element(i));
    matrices_.push_back(nodes.to_world(joints.element(i).count()));
  }
  const std::optional<Value> index = skin.find("inverseBindMatrices");
  if (!index) return;
  const std::vector<glm::dmat4> inverse_bind = accessors.open(*index, "MAT4").mat4s();
  if (inverse_bind.size() < matrices_.size()) {
    throw std::runtime_error(fmt::format("{} has {} joints, but only {} inverse bind matrices", place_,
                                         matrices_.size(), inverse_bind.size()));
  }
  for (std::size_t i = 0; i < matrices_.size(); ++i) matrices_[i] = matrices_[i] * inverse_bind[i];
}

glm::dmat4 Skin::matrix_of(const Vertices& vertices, std::size_t vertex) const {
  glm::dmat4 sum(0.0);
  double weight_sum = 0;
  for (const Influences& influences : vertices.influences) {
    for (int k = 0; k < 4; ++k) {
      const double weight = influences.weights[vertex][k];
      if (weight == 0) continue;  // its joint may be anything
      sum += weight * matrix_of_joint(influences.joints[vertex][k]);
      weight_sum += weight;
    }
  }
  return weight_sum == 0 ? matrix_of_joint(vertices.influences[0].joints[vertex][0]) : sum / weight_sum;
}

const glm::dmat4& Skin::matrix_of_joint(double number) const {
  if (!(number >= 0 && number < static_cast<double>(matrices_.size()))) {
    throw std::runtime_error(fmt::format("a vertex names joint {} of the {} of {}", number, matrices_.size(), place_));
  }
  return matrices_[static_cast<std::size_t>(number)];
}

}  // namespace lkao::scene::gltf
