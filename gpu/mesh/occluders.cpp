#include "lkao/gl/occluders.h"

#include <stdexcept>
#include <vector>

#include "gpu/gl/error.h"
#include "gpu/gl/status_of.h"
#include "gpu/mesh/instances.h"
#include "gpu/mesh/mesh_buffers.h"

namespace lkao::gl {

Occluders::Occluders() : Occluders(PositionView(), IndexView()) {}

Occluders::Occluders(const PositionView& positions, const IndexView& triangles, std::span<const glm::vec2> ranges,
                     HostErrors host_errors)
    : host_errors_(host_errors) {
  require_clean_context(host_errors_);
  buffers_ = std::make_unique<MeshBuffers>(positions, triangles, ranges);
}

Occluders::Occluders(std::span<const MeshInstance> instances, HostErrors host_errors) : host_errors_(host_errors) {
  require_clean_context(host_errors_);
  instances_ = std::make_unique<Instances>(instances);
  const std::vector<glm::vec3> places(instances_->position_count());
  const std::vector<glm::uvec3> triangles = instances_->triangles(instances);
  buffers_ = std::make_unique<MeshBuffers>(places, triangles, std::span<const glm::vec2>());
  instances_->find_positions(buffers_->positions_buffer());
  check_errors("finding the positions of instances");
}

Occluders::~Occluders() = default;
Occluders::Occluders(Occluders&&) noexcept = default;
Occluders& Occluders::operator=(Occluders&&) noexcept = default;

void Occluders::update_positions(const PositionView& positions) {
  require_clean_context(host_errors_);
  if (instances_) throw std::runtime_error("these occluders are instances: update_transforms() moves them");
  buffers_->update_positions(positions);
}

void Occluders::update_transforms(std::span<const glm::mat4x3> to_world) {
  require_clean_context(host_errors_);
  if (!instances_) throw std::runtime_error("these occluders are no instances: update_positions() moves them");
  instances_->set_transforms(to_world);
  instances_->find_positions(buffers_->positions_buffer());
  buffers_->note_change();
  check_errors("moving instances");
}

void Occluders::set_opacities(std::span<const float> opacities) {
  require_clean_context(host_errors_);
  buffers_->set_opacities(opacities);
}

std::optional<Occluders> Occluders::try_make(const PositionView& positions, const IndexView& triangles,
                                             Status& status) noexcept {
  std::optional<Occluders> occluders;
  status = status_of([&] { occluders.emplace(positions, triangles); });
  return occluders;
}

std::optional<Occluders> Occluders::try_make(std::span<const MeshInstance> instances, Status& status) noexcept {
  std::optional<Occluders> occluders;
  status = status_of([&] { occluders.emplace(instances); });
  return occluders;
}

Status Occluders::try_update_positions(const PositionView& positions) noexcept {
  return status_of([&] { update_positions(positions); });
}

Status Occluders::try_update_transforms(std::span<const glm::mat4x3> to_world) noexcept {
  return status_of([&] { update_transforms(to_world); });
}

Status Occluders::try_set_opacities(std::span<const float> opacities) noexcept {
  return status_of([&] { set_opacities(opacities); });
}

ObjectName Occluders::positions_buffer() const { return buffers_->positions_buffer(); }

}  // namespace lkao::gl
