#include "gpu/mesh/instances.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/mesh/dispatch.h"
#include "gpu/mesh/units.h"
#include "lut/mesh_views.h"

namespace lkao::gl {
namespace {

const StateUse kTransformUse{.storage_count = LKAO_TRANSFORM_STORAGE_COUNT};

void require_finite(const glm::mat4x3& transform, std::size_t number) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (std::isfinite(transform[column][row])) continue;
      throw std::invalid_argument(
          fmt::format("to_world of instance {} has {} in column {}", number, transform[column][row], column));
    }
  }
}

bool mirrors(const glm::mat4x3& transform) {
  return glm::determinant(glm::dmat3(transform[0], transform[1], transform[2])) < 0;
}

}  // namespace

Instances::Instances(std::span<const MeshInstance> instances)
    : instances_(instances.size()), transform_(make_program({"mesh/transform.comp"})) {
  std::vector<glm::mat4x3> to_world;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    lut::check_indices(instances[i].triangles, instances[i].positions.size());
    instances_[i].first_world = static_cast<GLuint>(position_count_);
    position_count_ += instances[i].positions.size();
    if (position_count_ > 0x7fffffffu) throw std::invalid_argument("instances have more than 2^31 - 1 positions");
    is_mirrored_.push_back(mirrors(instances[i].to_world));
    to_world.push_back(instances[i].to_world);
  }
  add_local_positions(instances);
  instances_buffer_ =
      make_buffer(static_cast<GLsizeiptr>(instances_.size() * sizeof(Instance)), nullptr, GL_DYNAMIC_STORAGE_BIT);
  set_transforms(to_world);
}

void Instances::add_local_positions(std::span<const MeshInstance> instances) {
  std::map<const void*, std::pair<PositionView, GLuint>> meshes;  // by their data, the view and its first position
  std::vector<glm::vec3> local;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const PositionView& positions = instances[i].positions;
    const auto first = static_cast<GLuint>(local.size());
    const auto [place, is_new] = meshes.try_emplace(positions.data(), positions, first);
    const bool is_kept = !is_new && place->second.first == positions;
    instances_[i].first_local = is_kept ? place->second.second : first;
    if (is_kept) continue;
    for (std::size_t k = 0; k < positions.size(); ++k) local.push_back(positions[k]);
  }
  local_positions_ = make_buffer(static_cast<GLsizeiptr>(local.size() * sizeof(glm::vec3)), local.data(), 0);
}

std::vector<glm::uvec3> Instances::triangles(std::span<const MeshInstance> instances) const {
  std::vector<glm::uvec3> all;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    for (std::size_t k = 0; k < instances[i].triangles.size(); ++k) {
      glm::uvec3 triangle = instances[i].triangles[k] + instances_[i].first_world;
      if (is_mirrored_[i]) std::swap(triangle.y, triangle.z);
      all.push_back(triangle);
    }
  }
  return all;
}

void Instances::set_transforms(std::span<const glm::mat4x3> to_world) {
  if (to_world.size() != instances_.size()) {
    throw std::invalid_argument(
        fmt::format("there are {} instances to move, not {}", instances_.size(), to_world.size()));
  }
  for (std::size_t i = 0; i < to_world.size(); ++i) {
    require_finite(to_world[i], i);
    if (mirrors(to_world[i]) == is_mirrored_[i]) continue;
    throw std::invalid_argument(
        fmt::format("to_world of instance {} {}: its fronts would become backs; make new Occluders", i,
                    is_mirrored_[i] ? "mirrors no more" : "mirrors, which it did not at first"));
  }
  for (std::size_t i = 0; i < to_world.size(); ++i) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) instances_[i].rows[row][column] = to_world[i][column][row];
    }
  }
  if (instances_.empty()) return;
  glNamedBufferSubData(instances_buffer_.name(), 0, static_cast<GLsizeiptr>(instances_.size() * sizeof(Instance)),
                       instances_.data());
}

void Instances::find_positions(ObjectName world_positions) const {
  if (position_count_ == 0) return;
  const StateKeeper keeper(kTransformUse);
  // The last frame may still be reading them.
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_WORLD, world_positions);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_LOCAL, local_positions_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_INSTANCES, instances_buffer_.name());
  glUseProgram(transform_.name());
  dispatch_for_each(position_count_);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace lkao::gl
