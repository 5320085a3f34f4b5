// Pictures in golden/, against what is drawn or defined now.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "image/image.h"

namespace lkao::gl::tests {

// A picture's file, and its size.
struct GoldenPicture {
  std::string name;  // of golden/NAME.png
  int width, height;

  std::string path() const { return std::string(LKAO_GOLDEN_DIR "/") + name + ".png"; }
  // Pictures begin at the top, and OpenGL's rows at the bottom.
  std::vector<float> upside_down(const std::vector<float>& pixels) const {
    std::vector<float> rows;
    for (std::ptrdiff_t y = height; y-- > 0;) {
      rows.insert(rows.end(), pixels.begin() + y * width, pixels.begin() + (y + 1) * width);
    }
    return rows;
  }
  // Where the environment has LKAO_REMAKE_GOLDEN.
  void remake_if_wanted(const std::vector<float>& occlusion) const {
    if (std::getenv("LKAO_REMAKE_GOLDEN") == nullptr) return;
    image::write_image(path(), {width, height, {"occlusion"}, upside_down(occlusion)});
  }
};

// Two tolerances, in steps of the 8 bits of a picture: no pixel may be farther off than `largest`, and only a share of
// them farther than `small`. Half a step is the picture's own rounding. What is found is recorded as a property.
inline void expect_golden(const GoldenPicture& golden, const std::vector<float>& occlusion, double small, double share,
                          double largest) {
  const image::Image image = image::read_image(golden.path());
  ASSERT_EQ(image.width, golden.width);
  ASSERT_EQ(image.height, golden.height);
  ASSERT_EQ(image.channel_count(), 1);
  ASSERT_EQ(image.pixels.size(), occlusion.size());
  const std::vector<float> seen = golden.upside_down(occlusion);
  std::size_t off_count = 0;
  double worst = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double off = 255 * std::fabs(double{seen[i]} - double{image.pixels[i]});
    off_count += !(off <= small);
    worst = std::max(worst, off);
  }
  const double off_share = static_cast<double>(off_count) / static_cast<double>(seen.size());
  EXPECT_LE(off_share, share) << golden.name;
  EXPECT_LE(worst, largest) << golden.name;
  ::testing::Test::RecordProperty(golden.name + (small < 1 ? "_exact" : "_near"),
                                  std::to_string(off_share) + " off, at most " + std::to_string(worst));
}

}  // namespace lkao::gl::tests
