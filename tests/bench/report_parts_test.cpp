// What lkao-bench report is made of: who is on the front, and rays of the falloffs that methods have.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bench/report/front.h"
#include "bench/report/own_falloff.h"

namespace lkao::test {
namespace {

using bench::add_front, bench::occlusion_of, bench::OwnFalloff, bench::pattern_of;
using nlohmann::ordered_json;

ordered_json result(const std::string& name, double seconds, double rmse) {
  return {{"contestant", name}, {"seconds", seconds}, {"errors", {{"rmse", rmse}}}};
}

TEST(ReportFront, HasThoseThatNoneBeats) {
  ordered_json results = {result("fast", 1, 0.5),     result("near", 4, 0.1),    result("between", 2, 0.2),
                          result("slower", 2.5, 0.2), result("as fast", 2, 0.3), result("worst", 5, 0.6),
                          result("twin", 4, 0.1)};
  add_front(results);
  for (const std::size_t on_it : {0u, 1u, 2u, 6u})
    EXPECT_TRUE(results[on_it].at("beaten_by").is_null()) << results[on_it];
  EXPECT_EQ(results[3].at("beaten_by"), "between");
  EXPECT_EQ(results[4].at("beaten_by"), "between");
  EXPECT_EQ(results[5].at("beaten_by"), "fast");
}

// Ends of rays, of which the receiver is at 0 and its normal z.
std::vector<glm::vec3> ends_of(const SamplePattern& pattern) {
  std::vector<glm::vec3> ends;
  ends.reserve(static_cast<std::size_t>(pattern.ray_count()));
  for (std::size_t i = 0; i < pattern.directions().size(); ++i) {
    ends.push_back(pattern.lengths()[i] * pattern.directions()[i]);
  }
  return ends;
}

TEST(OwnFalloff, EndsAreEvenInTheBallOfVao) {
  const glm::vec3 centre(0, 0, 0.5f);
  const std::vector<glm::vec3> ends = ends_of(pattern_of(OwnFalloff::ball, 0));
  ASSERT_EQ(ends.size(), 1024u);
  glm::vec3 sum(0);
  int in_half = 0, below_quarter = 0;
  for (const glm::vec3& end : ends) {
    EXPECT_LE(glm::length(end - centre), 0.5001f);
    sum += end;
    in_half += glm::length(end - centre) < 0.25f ? 1 : 0;
    below_quarter += end.z < 0.25f ? 1 : 0;
  }
  EXPECT_LT(glm::length(sum / 1024.0f - centre), 0.01f);
  EXPECT_NEAR(in_half / 1024.0, 1.0 / 8, 0.02);
  EXPECT_NEAR(below_quarter / 1024.0, 5.0 / 32, 0.02);  // a cap of half of the ball's radius
}

// A ceiling at the height h blocks what ends above it. With the intensity i, by Eq. 8 and without its epsilon, that is
// i E[cos / h] over directions of the cosine that reach it: 2/3 i (1 - h^3) / h; i is 2.
TEST(OwnFalloff, AlchemysIsItsIntegral) {
  constexpr int kTurnCount = 12;
  std::vector<glm::vec3> ends;
  for (int turn = 0; turn < kTurnCount; ++turn) {
    const std::vector<glm::vec3> more = ends_of(pattern_of(OwnFalloff::alchemy, turn));
    ends.insert(ends.end(), more.begin(), more.end());
  }
  for (const float height : {0.8f, 0.87f, 0.95f}) {
    int blocked = 0;
    for (const glm::vec3& end : ends) blocked += end.z >= height ? 1 : 0;
    const float share = static_cast<float>(blocked) / static_cast<float>(ends.size());
    const double h = height;
    EXPECT_NEAR(occlusion_of(OwnFalloff::alchemy, {share})[0], 4.0 / 3 * (1 - h * h * h) / h, 0.02) << height;
  }
  EXPECT_EQ(occlusion_of(OwnFalloff::alchemy, {0.5f})[0], 1);
  EXPECT_TRUE(std::isnan(occlusion_of(OwnFalloff::alchemy, {std::nanf("")})[0]));
}

TEST(OwnFalloff, OthersAreTheSharesOfRays) {
  for (const OwnFalloff falloff : {OwnFalloff::constant, OwnFalloff::linear, OwnFalloff::ball}) {
    EXPECT_EQ(occlusion_of(falloff, {0.25f, 1})[0], 0.25f);
  }
  for (const float length : pattern_of(OwnFalloff::constant, 0).lengths()) EXPECT_EQ(length, 1);
}

}  // namespace
}  // namespace lkao::test
