// How dark is the floor at the foot of a wall, in a frame of an engine?
#include <epoxy/gl.h>
#include <lkao/gl.h>

#include <cstdio>
#include <stdexcept>

#include "frame.h"

namespace {

float draw() {
  const Frame frame = make_frame();
  const lkao::gl::Occluders occluders(frame.positions, frame.triangles);
  // All pixels show one point, so it is not at theirs.
  lkao::gl::MaskPass pass({.check_g_buffer = false});
  pass.set_table(lkao::PlaneMaskTable(lkao::SamplePattern::standard(256), {.resolution = 64}));
  pass.draw(occluders, frame.g_buffer, frame.camera, {.radius = 2.0f});
  pass.resolve({.occlusion = {frame.target}});
  return mean_of(frame);
}

}  // namespace

int main() {
  try {
    lkao::gl::HeadlessContext context(lkao::gl::Device::software);
    context.make_current();
    std::printf("occlusion at the foot of the wall: %.2f\n", draw());
  } catch (const std::runtime_error& error) {
    std::printf("Skipped: %s\n", error.what());
  }
}
