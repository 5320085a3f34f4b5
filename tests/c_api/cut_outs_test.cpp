// Triangles with holes through C are those of C++.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_api/owned.h"
#include "lkao/c.h"
#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

using namespace tests;  // NOLINT(google-build-using-namespace)

TEST(CCutOuts, AreThoseOfCpp) {
  const Mesh mesh = random_soup(300, 0.2f, 3);
  std::vector<float> opacities(300, 0.5f);
  const CutOutFilter blocks = [](std::uint32_t, std::uint32_t primitive, float u, float) {
    return primitive % 2 == 0 && u < 0.5f;
  };
  const lkao_mesh view = c_mesh(mesh);
  const std::vector<Receiver> receivers = random_receivers(40, 1, 11);
  for (const bool has_filter : {false, true}) {
    lkao_build_options options = LKAO_BUILD_OPTIONS_INIT;
    options.opacities = opacities.data(), options.opacity_count = opacities.size();
    if (has_filter) {
      options.cut_out_filter = [](void* user, std::uint32_t instance, std::uint32_t primitive, float u, float v) {
        return static_cast<int>((*static_cast<const CutOutFilter*>(user))(instance, primitive, u, v));
      };
      options.cut_out_user = const_cast<CutOutFilter*>(&blocks);
    }
    const OwnedScene scene = made<OwnedScene>(lkao_scene_create, &view, &options);
    const OwnedAo ao = c_ao(scene, c_pattern(64), c_rays(0.5f));
    const CutOuts cut_outs{opacities, has_filter ? blocks : CutOutFilter()};
    const AmbientOcclusion expected(OccluderBvh(mesh.view(), {.cut_outs = cut_outs}), SamplePattern::standard(64),
                                    {.radius = 0.5f});
    const AmbientOcclusion whole(OccluderBvh(mesh.view()), SamplePattern::standard(64), {.radius = 0.5f});
    int difference = 0;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const lkao_receiver receiver = c_receiver(receivers[i]);
      std::uint64_t mask = 0;
      ASSERT_EQ(lkao_ao_blocked(ao.get(), &receiver, i, &mask, 1), LKAO_OK);
      const OcclusionMask right = expected.blocked(receivers[i], i);
      ASSERT_EQ(mask, right.words[0]);
      difference += whole.blocked(receivers[i], i).count() - right.count();
    }
    EXPECT_GT(difference, 20);
  }
  lkao_build_options wrong = LKAO_BUILD_OPTIONS_INIT;
  wrong.opacity_count = 300;
  lkao_bvh* bvh = nullptr;
  EXPECT_EQ(lkao_bvh_create(&view, &wrong, &bvh), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(lkao_last_error(), "lkao_bvh_create: options->opacities must not be NULL");
}

// Two triangles with the same holes: clear below u = 0.5.
struct CutQuad {
  CutQuad() {
    add_quad(mesh, {-2, -2, 0.2f}, {4, 0, 0}, {0, 4, 0});
    view = c_mesh(mesh);
    options.cut_out_filter = [](void* user, std::uint32_t, std::uint32_t, float u, float) {
      ++static_cast<CutQuad*>(user)->filter_count;
      return static_cast<int>(u >= 0.5f);
    };
    options.cut_out_user = this;
  }

  static lkao_cut_out_part survey(void* user, std::uint32_t primitive, float u0, float, float size) {
    auto* const quad = static_cast<CutQuad*>(user);
    ++quad->survey_count;
    if (primitive == 1) quad->has_asked_second = true;
    if (u0 >= 0.5f) return LKAO_CUT_OUT_OPAQUE;
    return u0 + size < 0.5f ? LKAO_CUT_OUT_CLEAR : LKAO_CUT_OUT_MIXED;
  }

  // Of a receiver below it.
  std::vector<std::uint64_t> masks() const {
    const OwnedScene scene = made<OwnedScene>(lkao_scene_create, &view, &options);
    const OwnedAo ao = c_ao(scene, c_pattern(256), c_rays(5));
    std::vector<std::uint64_t> words(4);
    const lkao_receiver receiver = c_receiver({.normal = {0, 0, 1}});
    EXPECT_EQ(lkao_ao_blocked(ao.get(), &receiver, 0, words.data(), words.size()), LKAO_OK);
    return words;
  }

  Mesh mesh;
  lkao_mesh view{};
  lkao_build_options options = LKAO_BUILD_OPTIONS_INIT;
  std::atomic<int> filter_count = 0, survey_count = 0;
  std::atomic<bool> has_asked_second = false;
};

TEST(CCutOuts, AskASurveyBeforeTheFilter) {
  CutQuad quad;
  const std::vector<std::uint64_t> expected = quad.masks();
  const int all_asked = quad.filter_count;
  EXPECT_GT(all_asked, 100);
  quad.options.cut_out_survey = CutQuad::survey;
  quad.filter_count = 0;
  EXPECT_EQ(quad.masks(), expected);
  EXPECT_GT(quad.survey_count, 1);
  EXPECT_TRUE(quad.has_asked_second);
  EXPECT_LT(8 * quad.filter_count, all_asked);
  const int both_asked = quad.survey_count;
  const std::vector<std::uint32_t> looks{7, 7};
  quad.options.cut_out_looks = looks.data(), quad.options.cut_out_look_count = looks.size();
  quad.survey_count = 0, quad.has_asked_second = false;
  EXPECT_EQ(quad.masks(), expected);
  EXPECT_EQ(2 * quad.survey_count, both_asked);
  EXPECT_FALSE(quad.has_asked_second);
}

TEST(CCutOuts, OfOlderCallersHaveNoSurvey) {
  CutQuad quad;
  const std::vector<std::uint64_t> expected = quad.masks();
  const int all_asked = quad.filter_count;
  quad.options.cut_out_survey = CutQuad::survey;
  quad.options.size = offsetof(lkao_build_options, cut_out_survey);
  quad.filter_count = 0;
  EXPECT_EQ(quad.masks(), expected);
  EXPECT_EQ(quad.survey_count, 0);
  EXPECT_EQ(quad.filter_count, all_asked);
}

TEST(CCutOuts, RefuseSurveysThatCannotBe) {
  CutQuad quad;
  lkao_bvh* bvh = nullptr;
  const auto expect_refused = [&](const char* message) {
    EXPECT_EQ(lkao_bvh_create(&quad.view, &quad.options, &bvh), LKAO_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(lkao_last_error(), (std::string("lkao_bvh_create: ") + message).c_str());
    EXPECT_EQ(bvh, nullptr);
  };
  quad.options.cut_out_survey = [](void*, std::uint32_t, float, float, float) { return lkao_cut_out_part{3}; };
  expect_refused("what options->cut_out_survey returns must be 0 to 2, not 3");
  quad.options.cut_out_survey = CutQuad::survey;
  const std::uint32_t look = 0;
  quad.options.cut_out_look_count = 2;
  expect_refused("options->cut_out_looks must not be NULL");
  quad.options.cut_out_looks = &look, quad.options.cut_out_look_count = 1;
  expect_refused("cut_outs.looks must be none or one for each of 2 triangles, not 1");
  quad.options.cut_out_filter = nullptr;
  expect_refused("options->cut_out_survey must be NULL without options->cut_out_filter, which it speaks of");
}

}  // namespace
}  // namespace lkao
