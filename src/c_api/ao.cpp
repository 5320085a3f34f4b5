#include "lkao/c/ao.h"

#include <string>
#include <vector>

#include "c_api/arrays.h"
#include "c_api/convert.h"
#include "c_api/handles.h"
#include "c_api/versioned.h"
#include "c_api/words.h"

using namespace lkao::c_api;

namespace {

std::vector<lkao::OccluderLevel> levels_of(const lkao_level* levels, std::size_t level_count) {
  std::vector<lkao::OccluderLevel> result;
  result.reserve(level_count);
  for_each(levels, level_count, LKAO_LEVEL_INIT, "levels", [&](const lkao_level& from, const std::string& name) {
    result.push_back({object(from.scene, (name + "->scene").c_str()), from.r_min, from.r_max});
  });
  return result;
}

}  // namespace

lkao_status lkao_ao_create(const lkao_scene* scene, const lkao_pattern* pattern, const lkao_ray_options* options,
                           lkao_kernel kernel, lkao_ao** ao) {
  return create(__func__, ao, "ao", [&] {
    return lkao::AmbientOcclusion(object(scene, "scene"), object(pattern, "pattern"), ray_options_of(options),
                                  word(kKernels, kernel, "kernel"));
  });
}

lkao_status lkao_ao_create_levels(const lkao_level* levels, size_t level_count, const lkao_pattern* pattern,
                                  const lkao_ray_options* options, lkao_kernel kernel, lkao_ao** ao) {
  return create(__func__, ao, "ao", [&] {
    return lkao::AmbientOcclusion(levels_of(levels, level_count), object(pattern, "pattern"), ray_options_of(options),
                                  word(kKernels, kernel, "kernel"));
  });
}

lkao_status lkao_ao_create_by_table(const lkao_scene* scene, const lkao_table* table, const lkao_ray_options* options,
                                    lkao_node_masks node_masks, lkao_ao** ao) {
  return create(__func__, ao, "ao", [&] {
    return lkao::AmbientOcclusion(object(scene, "scene"), object(table, "table"), ray_options_of(options),
                                  word(kNodeMasks, node_masks, "node_masks"));
  });
}

lkao_status lkao_ao_destroy(lkao_ao* ao) { return destroy(__func__, ao, "ao"); }

lkao_status lkao_ao_query(const lkao_ao* ao, const lkao_receiver* receiver, uint64_t index, lkao_answer* answer) {
  return guard(__func__, [&] {
    check_size(answer, "answer");
    write(c_answer_of(object(ao, "ao").query(receiver_of(receiver), index)), answer);
  });
}

lkao_status lkao_ao_blocked(const lkao_ao* ao, const lkao_receiver* receiver, uint64_t index, uint64_t* mask,
                            size_t word_count) {
  return guard(__func__, [&] {
    const lkao::AmbientOcclusion& found = object(ao, "ao");
    check_mask(found.pattern(), mask, word_count);
    write_mask(found.blocked(receiver_of(receiver), index), found.pattern(), mask, word_count);
  });
}

lkao_status lkao_ao_get_rays(const lkao_ao* ao, const lkao_receiver* receiver, uint64_t index, lkao_rays* rays,
                             float* segments, size_t segment_stride) {
  return guard(__func__, [&] {
    if (rays != nullptr) check_size(rays, "rays");
    const Strided<float, 3> to(segments, segment_stride, "segment_stride");
    lkao::ReceiverRays found;
    object(ao, "ao").rays(receiver_of(receiver), index, found);
    write_rays(found, rays, to);
  });
}

lkao_status lkao_ao_get_options(const lkao_ao* ao, lkao_ray_options* options) {
  return guard(__func__, [&] {
    check_size(options, "options");
    write(c_options_of(object(ao, "ao").options()), options);
  });
}

lkao_status lkao_pattern_create_of_ao(const lkao_ao* ao, lkao_pattern** pattern) {
  return create(__func__, pattern, "pattern", [&] { return object(ao, "ao").pattern(); });
}

lkao_status lkao_scene_create_of_ao(const lkao_ao* ao, lkao_scene** scene) {
  return create(__func__, scene, "scene", [&] { return object(ao, "ao").occluders(); });
}

lkao_status lkao_table_create_of_ao(const lkao_ao* ao, lkao_table** table) {
  return create(__func__, table, "table", [&] {
    const lkao::PlaneMaskTable* const found = object(ao, "ao").table();
    if (found == nullptr) refuse("ao has no table: it was not made by lkao_ao_create_by_table");
    return *found;
  });
}
