#include "lkao/gl/occluders.h"

#include "gpu/gl/error.h"
#include "gpu/mesh/mesh_buffers.h"

namespace lkao::gl {

Occluders::Occluders() : Occluders({}, {}) {}

Occluders::Occluders(const PositionView& positions, const IndexView& triangles, std::span<const glm::vec2> ranges) {
  require_clean_context();
  buffers_ = std::make_unique<MeshBuffers>(positions, triangles, ranges);
}

Occluders::~Occluders() = default;
Occluders::Occluders(Occluders&&) noexcept = default;
Occluders& Occluders::operator=(Occluders&&) noexcept = default;

void Occluders::update_positions(const PositionView& positions) {
  require_clean_context();
  buffers_->update_positions(positions);
}

ObjectName Occluders::positions_buffer() const { return buffers_->positions_buffer(); }

}  // namespace lkao::gl
