// What is asked about every receiver, whatever method answers.
#pragma once

#include <cstdint>
#include <optional>

#include "lkao/area_light.h"
#include "lkao/plane_mask_table.h"
#include "lkao/receiver.h"
#include "lkao/sample_pattern.h"
#include "lkao/soft_shadows.h"
#include "method/words.h"

namespace lkao::method {

inline constexpr Word<Sidedness> kSidednessWords[] = {{"one", Sidedness::one_sided}, {"two", Sidedness::two_sided}};

inline constexpr Word<Weighting> kWeightingWords[] = {{"cosine", Weighting::cosine}, {"uniform", Weighting::uniform}};

struct Question {
  float radius = 0;  // AO radius, > 0; perhaps infinite
  int ray_count = 128;
  PatternKind pattern_kind = PatternKind::lloyd;
  Weighting weighting = Weighting::cosine;
  Falloff falloff = Falloff::constant();
  Sidedness sidedness = Sidedness::two_sided;
  std::uint64_t seed = 0;
  float min_distance = 0;                                     // where rays begin to count
  int table_resolution = PlaneMaskTableOptions{}.resolution;  // of methods that look planes up

  RayOptions ray_options() const {
    return {.radius = radius, .sidedness = sidedness, .seed = seed, .min_distance = min_distance};
  }
  // What share of this light is hidden, instead of ambient occlusion: then neither radius nor weighting, falloff and
  // min_distance are of account.
  std::optional<AreaLight> light = {};

  ShadowOptions shadow_options() const { return {.sidedness = sidedness, .seed = seed}; }
  SamplePattern pattern() const;
  PlaneMaskTable table(PlaneMasks masks) const;
  // Rays beyond everything, of several lengths: shares of infinity that no table holds.
  bool has_infinite_lengths() const;
};

}  // namespace lkao::method
