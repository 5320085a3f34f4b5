// The query against Embree with the same rays, and Embree's two ways against each other, on random soups.
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshes.h"
#include "reference/embree_reference.h"

namespace lkao::reference {
namespace {

constexpr double kMaxMismatchRate = 1e-5;

struct Case {
  const char* name;
  std::size_t triangle_count;
  float triangle_size;
  float radius;
  Sidedness sidedness;
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }

const Case kCases[] = {
    {"Medium", 2000, 0.10f, 0.50f, Sidedness::two_sided},
    {"Fine", 5000, 0.04f, 0.30f, Sidedness::two_sided},
    {"Coarse", 100, 1.00f, 2.00f, Sidedness::two_sided},
    {"OneSided", 3000, 0.10f, 0.50f, Sidedness::one_sided},
};

class Soup : public testing::TestWithParam<Case> {
 protected:
  static constexpr int kRayCount = 256;
  static constexpr std::size_t kReceiverCount = 2000;

  Soup()
      : mesh_(random_soup(GetParam().triangle_count, GetParam().triangle_size, 11)),
        receivers_(random_receivers(kReceiverCount, 12)),
        ao_(OccluderBvh(mesh_.view()), SamplePattern::standard(kRayCount), options()) {
    for (std::size_t k = 0; k < kReceiverCount; k += 5) {
      receivers_[k].excluded_primitive = static_cast<std::uint32_t>(k % GetParam().triangle_count);
    }
  }

  static RayOptions options() {
    RayOptions options;
    options.radius = GetParam().radius;
    options.sidedness = GetParam().sidedness;
    return options;
  }

  template <typename Method>
  std::vector<std::uint64_t> masks(const Method& query) {
    std::vector<std::uint64_t> words(kReceiverCount * kRayCount / 64);
    QueryOutputs outputs;
    outputs.mask_words = words;
    report_ = query(outputs);
    return words;
  }
  std::vector<std::uint64_t> embree_masks(const ReferenceOptions& reference_options) {
    const EmbreeReference reference(mesh_, reference_options);
    return masks([&](const QueryOutputs& outputs) { return reference.query(ao_, receivers_, outputs); });
  }

  void expect_agreement(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
    const auto ray_count = static_cast<double>(report_.ray_count);
    const auto blocked_count = static_cast<double>(report_.blocked_ray_count);
    const std::uint64_t mismatch_count = count_mismatched_rays(a, b);
    EXPECT_LE(static_cast<double>(mismatch_count), kMaxMismatchRate * ray_count) << "of " << ray_count << " rays";
    // There is something to disagree about.
    EXPECT_GT(blocked_count, 0.02 * ray_count);
    EXPECT_LT(blocked_count, 0.98 * ray_count);
    RecordProperty("mismatched_rays", std::to_string(mismatch_count));
  }

  scene::Mesh mesh_;
  std::vector<Receiver> receivers_;
  AmbientOcclusion ao_;
  QueryReport report_;
};

TEST_P(Soup, PacketsAgreeWithSingleRays) {
  expect_agreement(embree_masks({.casting = Casting::packets}), embree_masks({.casting = Casting::single_rays}));
}

TEST_P(Soup, QueryAgreesWithEmbree) {
  const auto query_masks = masks([&](const QueryOutputs& outputs) { return ao_.query(receivers_, outputs); });
  expect_agreement(query_masks, embree_masks({}));
}

// The rival of the speed comparisons may leak between triangles, but not much.
TEST_P(Soup, FastEmbreeAgreesWithRobust) {
  expect_agreement(embree_masks({.robust = false}), embree_masks({.robust = true}));
}

INSTANTIATE_TEST_SUITE_P(Reference, Soup, testing::ValuesIn(kCases),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace lkao::reference
