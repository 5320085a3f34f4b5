#include "lkao/c/pattern.h"

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "c_api/arrays.h"
#include "c_api/convert.h"
#include "c_api/handles.h"
#include "c_api/versioned.h"
#include "c_api/words.h"

using namespace lkao::c_api;

lkao_status lkao_pattern_create(const lkao_pattern_options* options, lkao_pattern** pattern) {
  return create(__func__, pattern, "pattern", [&] {
    const lkao_pattern_options from = read(options, LKAO_PATTERN_OPTIONS_INIT, "options");
    const lkao::Falloff falloff =
        from.falloff == nullptr ? lkao::Falloff::constant() : falloff_of(from.falloff, "options->falloff");
    return lkao::SamplePattern::make(word(kPatternKinds, from.kind, "options->kind"), from.ray_count, falloff,
                                     from.seed, word(kWeightings, from.weighting, "options->weighting"));
  });
}

lkao_status lkao_pattern_create_standard(int32_t ray_count, lkao_weighting weighting, lkao_pattern** pattern) {
  return create(__func__, pattern, "pattern",
                [&] { return lkao::SamplePattern::standard(ray_count, word(kWeightings, weighting, "weighting")); });
}

lkao_status lkao_pattern_create_from_disk(const float* points, size_t point_stride, const float* lengths,
                                          size_t length_stride, int32_t ray_count, lkao_pattern** pattern) {
  return create(__func__, pattern, "pattern", [&] {
    const Strided<const float, 2> from_points(needed(points, "points"), point_stride, "point_stride");
    const Strided<const float, 1> from_lengths(needed(lengths, "lengths"), length_stride, "length_stride");
    check_range(ray_count, LKAO_MIN_RAY_COUNT, LKAO_MAX_RAY_COUNT, "ray_count");
    const auto count = static_cast<std::size_t>(ray_count);
    std::vector<glm::vec2> own_points(count);
    std::vector<float> own_lengths(count);
    for (std::size_t i = 0; i < count; ++i) {
      from_points.get(i, &own_points[i]);
      from_lengths.get(i, &own_lengths[i]);
    }
    return lkao::SamplePattern::from_disk(own_points, own_lengths);
  });
}

lkao_status lkao_pattern_create_with_falloff(const lkao_pattern* pattern, const lkao_falloff* falloff,
                                             lkao_pattern** result) {
  return create(__func__, result, "result",
                [&] { return object(pattern, "pattern").with_falloff(falloff_of(falloff, "falloff")); });
}

lkao_status lkao_pattern_destroy(lkao_pattern* pattern) { return destroy(__func__, pattern, "pattern"); }

int32_t lkao_pattern_ray_count(const lkao_pattern* pattern) {
  return guard_value(__func__, int32_t{0}, [&] { return int32_t{object(pattern, "pattern").ray_count()}; });
}

int32_t lkao_pattern_word_count(const lkao_pattern* pattern) {
  return guard_value(__func__, int32_t{0}, [&] { return int32_t{object(pattern, "pattern").word_count()}; });
}

const float* lkao_pattern_disk(const lkao_pattern* pattern) {
  return guard_value(__func__, static_cast<const float*>(nullptr),
                     [&] { return &object(pattern, "pattern").disk().data()->x; });
}

const float* lkao_pattern_directions(const lkao_pattern* pattern) {
  return guard_value(__func__, static_cast<const float*>(nullptr),
                     [&] { return &object(pattern, "pattern").directions().data()->x; });
}

const float* lkao_pattern_lengths(const lkao_pattern* pattern) {
  return guard_value(__func__, static_cast<const float*>(nullptr),
                     [&] { return object(pattern, "pattern").lengths().data(); });
}

lkao_status lkao_pattern_lowest_elevation(const lkao_pattern* pattern, float* elevation) {
  return guard(__func__, [&] { *needed(elevation, "elevation") = object(pattern, "pattern").lowest_elevation(); });
}

const char* lkao_pattern_kind_name(lkao_pattern_kind kind) {
  if (kind < 0 || kind >= static_cast<int>(kPatternKinds.size())) return nullptr;
  return lkao::pattern_kind_name(kPatternKinds[static_cast<std::size_t>(kind)]);
}

lkao_status lkao_pattern_kind_named(const char* name, lkao_pattern_kind* kind) {
  return guard(__func__, [&] {
    needed(kind, "kind");
    *kind = number_of(kPatternKinds, lkao::pattern_kind_named(needed(name, "name")));
  });
}
