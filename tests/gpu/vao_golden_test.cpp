// A furnished room as it was when its picture in golden/ was made: neither the definition in double nor the
// pass may drift from it, not even both together. After a change that is meant to change occlusion, make the picture
// anew, look at it, and commit it:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_vao --gtest_filter=VaoGolden.IsItsDefinition
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "gpu/golden_picture.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "gpu/vao_definition.h"

namespace lkao::gl::tests::vao_golden_test {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
const GoldenPicture kGolden{"vao", kWidth, kHeight};
constexpr float kRadius = 1.5f;

class VaoGolden : public OnSoftware {
 protected:
  static PixelView room() { return view_of_mesh(furnished_room(), room_camera(kWidth, kHeight), kWidth, kHeight); }
};

TEST_F(VaoGolden, IsItsDefinition) {
  const PixelView view = room();
  const VaoDefinition definition(view);
  std::vector<float> occlusion;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double value = definition.seen(x, y).is_there()
                               ? definition.occlusion(x, y, plain_set(kRadius, 32), VaoDefinition::set_of(x, y, 32))
                               : 0.0;
      occlusion.push_back(static_cast<float>(value));
    }
  }
  kGolden.remake_if_wanted(occlusion);
  expect_golden(kGolden, occlusion, 0.51, 0.001, 6);
}

TEST_F(VaoGolden, IsDrawn) {
  const PixelView view = room();
  VaoPass pass;
  // Places on the edges of pixels may be in either.
  expect_golden(kGolden, draw_vao(view, pass, plain_set(kRadius, 32)), 0.51, 0.005, 12);
  // As it is by default: half of the samples.
  expect_golden(kGolden, draw_vao(view, pass, {.radius = kRadius}), 12.5, 0.2, 150);
}

}  // namespace
}  // namespace lkao::gl::tests::vao_golden_test
