// The same frame in an engine that is compiled without exceptions and run-time type information.
#include <epoxy/gl.h>
#include <lkao/gl.h>

#include <array>
#include <cstdio>

#include "frame.h"

namespace {

// False after a line that says what is wrong.
bool works(const lkao::gl::Status& status) {
  if (!status) std::printf("Skipped: %s\n", status.message.c_str());
  return status.ok();
}

}  // namespace

int main() {
  lkao::gl::Status status;
  const auto context = lkao::gl::HeadlessContext::try_make(lkao::gl::Device::software, status);
  if (!works(status) || !works(context->try_make_current())) return 0;
  const Frame frame = make_frame();
  const auto occluders = lkao::gl::Occluders::try_make(frame.positions, frame.triangles, status);
  if (!works(status)) return 1;
  // All pixels show one point, so it is not at theirs.
  auto pass = lkao::gl::MaskPass::try_make({.check_g_buffer = false}, status);
  if (!works(status)) return 1;
  const lkao::PlaneMaskTable table(lkao::SamplePattern::standard(256), {.resolution = 64});
  if (!works(pass->try_set_table(table))) return 1;
  if (!works(pass->try_draw(*occluders, frame.g_buffer, frame.camera, {.radius = 2.0f}))) return 1;
  if (!works(pass->try_resolve({.occlusion = {frame.target}}))) return 1;
  std::printf("occlusion at the foot of the wall: %.2f\n", mean_of(frame));

  // What goes wrong is a value too.
  status = pass->try_draw(*occluders, frame.g_buffer, frame.camera, {.radius = -1.0f});
  std::printf("and with a radius of -1: %s\n", status.message.c_str());
  return status ? 1 : 0;
}
