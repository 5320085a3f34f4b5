// In place of raster_method.cpp where the program is built without OpenGL.
#include <stdexcept>

#include "cli/raster_method.h"

namespace lkao::cli {

struct RasterMethod::State {};

RasterMethod::RasterMethod(const RasterOptions&, const Size&) { require_raster_method(); }
RasterMethod::~RasterMethod() = default;

RasterFrame RasterMethod::draw(const scene::Mesh&, std::span<const glm::vec2>, const scene::Camera&,
                               const scene::ReceiverImage&, const OcclusionOptions&, const FrameOptions&) {
  require_raster_method();
  return {};
}

void require_raster_method() {
  throw std::runtime_error("--method raster: this program was built without OpenGL (LKAO_BUILD_GL)");
}

}  // namespace lkao::cli
