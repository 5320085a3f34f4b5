#include "lkao/c/shadows.h"

#include <cstring>
#include <variant>

#include <glm/gtc/type_ptr.hpp>

#include "c_api/batches.h"
#include "c_api/handles.h"
#include "c_api/words.h"

using namespace lkao::c_api;

namespace {

lkao::AreaLight light_of(const lkao_light* light) {
  const lkao_light from = read(light, LKAO_LIGHT_INIT, "light");
  check_range(from.kind, LKAO_LIGHT_DISC, LKAO_LIGHT_SPHERE, "light->kind");
  const glm::vec3 position = glm::make_vec3(from.position);
  if (from.kind == LKAO_LIGHT_SPHERE) return lkao::SphereLight{.position = position, .radius = from.radius};
  return lkao::DiscLight{.position = position, .normal = glm::make_vec3(from.normal), .radius = from.radius};
}

lkao_light c_light_of(const lkao::AreaLight& light) {
  lkao_light result = LKAO_LIGHT_INIT;
  const auto set_place = [&](const auto& from) {
    std::memcpy(result.position, &from.position, sizeof(result.position));
    result.radius = from.radius;
  };
  std::visit(set_place, light);
  if (const auto* const disc = std::get_if<lkao::DiscLight>(&light)) {
    std::memcpy(result.normal, &disc->normal, sizeof(result.normal));
  } else {
    result.kind = LKAO_LIGHT_SPHERE;
  }
  return result;
}

class ShadowOutputs {
 public:
  ShadowOutputs(const lkao_shadow_outputs& to, std::size_t word_count)
      : visibility_(to.visibility, to.visibility_stride, 1, "outputs->visibility_stride"),
        above_horizon_(to.above_horizon, to.above_horizon_stride, 1, "outputs->above_horizon_stride"),
        masks_(to.masks, to.mask_stride, word_count, "outputs->mask_stride") {}

  lkao::ShadowOutputs begin(std::size_t first, std::size_t count) {
    return {visibility_.begin(first, count), above_horizon_.begin(first, count), masks_.begin(first, count)};
  }
  void finish(std::size_t first, std::size_t count) const {
    visibility_.finish(first, count);
    above_horizon_.finish(first, count);
    masks_.finish(first, count);
  }

 private:
  Output<float> visibility_, above_horizon_;
  Output<std::uint64_t> masks_;
};

}  // namespace

lkao_status lkao_shadows_create(const lkao_scene* scene, const lkao_light* light, const lkao_pattern* pattern,
                                const lkao_shadow_options* options, lkao_shadows** shadows) {
  return create(__func__, shadows, "shadows", [&] {
    const lkao_shadow_options from = read_or_defaults(options, LKAO_SHADOW_OPTIONS_INIT, "options");
    return lkao::SoftShadows(object(scene, "scene"), light_of(light), object(pattern, "pattern"),
                             {.sidedness = word(kSidednesses, from.sidedness, "options->sidedness"),
                              .rotation = from.rotation,
                              .seed = from.seed,
                              .surface_offset = from.surface_offset},
                             word(kKernels, from.kernel, "options->kernel"));
  });
}

lkao_status lkao_shadows_destroy(lkao_shadows* shadows) { return destroy(__func__, shadows, "shadows"); }

lkao_status lkao_shadows_query(const lkao_shadows* shadows, const lkao_receiver* receiver, uint64_t index,
                               lkao_visibility* visibility) {
  return guard(__func__, [&] {
    check_size(visibility, "visibility");
    const lkao::LightVisibility found = object(shadows, "shadows").query(receiver_of(receiver), index);
    lkao_visibility result = LKAO_VISIBILITY_INIT;
    std::memcpy(result.mask, found.blocked.words, sizeof(result.mask));
    result.visibility = found.visibility;
    result.above_horizon = found.above_horizon;
    write(result, visibility);
  });
}

lkao_status lkao_shadows_query_batch(const lkao_shadows* shadows, const lkao_receivers* receivers,
                                     const lkao_shadow_outputs* outputs, const lkao_batch_options* options,
                                     lkao_query_report* report) {
  return guard(__func__, [&] {
    const lkao::SoftShadows& found = object(shadows, "shadows");
    ShadowOutputs to(read(outputs, LKAO_SHADOW_OUTPUTS_INIT, "outputs"),
                     static_cast<std::size_t>(found.pattern().word_count()));
    answer_batch(receivers, options, report,
                 [&](std::size_t first, std::span<const lkao::Receiver> part, std::uint64_t index,
                     const lkao::Progress& progress) {
                   const lkao::QueryReport part_report =
                       found.query(part, to.begin(first, part.size()), index, progress);
                   to.finish(first, part.size());
                   return part_report;
                 });
  });
}

lkao_status lkao_shadows_get_rays(const lkao_shadows* shadows, const lkao_receiver* receiver, uint64_t index,
                                  lkao_rays* rays, float* segments, size_t segment_stride) {
  return guard(__func__, [&] {
    if (rays != nullptr) check_size(rays, "rays");
    const Strided<float, 3> to(segments, segment_stride, "segment_stride");
    lkao::ReceiverRays found;
    object(shadows, "shadows").rays(receiver_of(receiver), index, found);
    write_rays(found, rays, to);
  });
}

lkao_status lkao_scene_create_of_shadows(const lkao_shadows* shadows, lkao_scene** scene) {
  return create(__func__, scene, "scene", [&] { return object(shadows, "shadows").occluders(); });
}

lkao_status lkao_pattern_create_of_shadows(const lkao_shadows* shadows, lkao_pattern** pattern) {
  return create(__func__, pattern, "pattern", [&] { return object(shadows, "shadows").pattern(); });
}

lkao_status lkao_shadows_get_light(const lkao_shadows* shadows, lkao_light* light) {
  return guard(__func__, [&] {
    check_size(light, "light");
    write(c_light_of(object(shadows, "shadows").light()), light);
  });
}

lkao_status lkao_shadows_get_options(const lkao_shadows* shadows, lkao_shadow_options* options) {
  return guard(__func__, [&] {
    check_size(options, "options");
    const lkao::ShadowOptions& from = object(shadows, "shadows").options();
    lkao_shadow_options result = read(options, LKAO_SHADOW_OPTIONS_INIT, "options");
    result.sidedness = number_of(kSidednesses, from.sidedness);
    result.rotation = from.rotation;
    result.seed = from.seed;
    result.surface_offset = from.surface_offset;
    write(result, options);
  });
}
