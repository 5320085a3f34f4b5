// Tests that look at the furnished room.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/g_buffer_pass.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"

namespace lkao::gl::tests {

// The room, its camera and its G-buffer, at the size that most tests of a file use.
template <int kWidth, int kHeight>
class InFurnishedRoom : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    mesh_ = furnished_room();
    camera_ = room_camera(kWidth, kHeight);
    g_buffer_ = std::make_unique<GBufferPass>(mesh_, camera_, kWidth, kHeight);
  }
  // Before the context goes.
  void TearDown() override { g_buffer_.reset(); }

  // The masks of a frame.
  std::vector<std::uint64_t> draw(PassOnMesh& pass, const RayOptions& options, const RasterOptions& raster = {}) const {
    pass.draw(g_buffer_->by_positions(), camera_, options, raster);
    return pass.read_masks();
  }

  Mesh mesh_;
  Camera camera_;
  std::unique_ptr<GBufferPass> g_buffer_;
};

}  // namespace lkao::gl::tests
