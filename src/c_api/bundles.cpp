#include "lkao/c/bundles.h"

#include <string>
#include <vector>

#include "c_api/batches.h"
#include "c_api/handles.h"
#include "c_api/words.h"

using namespace lkao::c_api;

namespace {

// The caller's bundles as those of C++, which keeps copies of rays that are not packed.
class Bundles {
 public:
  // Throws where one has more rays than `word_count` words have bits.
  Bundles(const lkao_bundle* first, std::size_t count, std::size_t word_count) {
    bundles_.reserve(count);
    copies_.reserve(count);
    for_each(first, count, LKAO_BUNDLE_INIT, "bundles", [&](const lkao_bundle& from, const std::string& name) {
      bundles_.push_back(make(from, name, word_count));
    });
  }
  Bundles(const lkao_bundle* bundle, std::size_t word_count) {
    bundles_.push_back(make(read(bundle, LKAO_BUNDLE_INIT, "bundle"), "bundle", word_count));
  }

  std::span<const lkao::RayBundle> get() const { return bundles_; }

 private:
  lkao::RayBundle make(const lkao_bundle& from, const std::string& name, std::size_t word_count) {
    needed(from.rays, (name + "->rays").c_str());
    const std::size_t ray_count = from.ray_count;
    if (ray_count < LKAO_MIN_RAY_COUNT || ray_count > LKAO_MAX_RAY_COUNT) {
      refuse(name + "->ray_count must be 1 to 1024, not " + std::to_string(ray_count));
    }
    if (LKAO_WORD_COUNT(ray_count) > word_count) {
      refuse("word_count must be at least " + std::to_string(LKAO_WORD_COUNT(ray_count)) + " for " + name + ", not " +
             std::to_string(word_count));
    }
    const Strided<const float, 3> rays(from.rays, from.ray_stride, (name + "->ray_stride").c_str());
    const glm::vec3* first = reinterpret_cast<const glm::vec3*>(from.rays);
    if (!rays.is_packed()) {
      std::vector<glm::vec3>& copy = copies_.emplace_back(ray_count);
      for (std::size_t i = 0; i < ray_count; ++i) rays.get(i, &copy[i]);
      first = copy.data();
    }
    return {.origin = {from.origin[0], from.origin[1], from.origin[2]},
            .rays = {first, ray_count},
            .excluded_primitive = from.excluded_primitive,
            .excluded_instance = from.excluded_instance,
            .occluder_groups = from.occluder_groups};
  }

  std::vector<lkao::RayBundle> bundles_;
  std::vector<std::vector<glm::vec3>> copies_;
};

}  // namespace

lkao_status lkao_bundles_create(const lkao_scene* scene, lkao_sidedness sidedness, lkao_kernel kernel,
                                lkao_bundles** bundles) {
  return create(__func__, bundles, "bundles", [&] {
    return lkao::RayBundles(object(scene, "scene"), word(kSidednesses, sidedness, "sidedness"),
                            word(kKernels, kernel, "kernel"));
  });
}

lkao_status lkao_bundles_destroy(lkao_bundles* bundles) { return destroy(__func__, bundles, "bundles"); }

lkao_status lkao_bundles_blocked(const lkao_bundles* bundles, const lkao_bundle* bundle, uint64_t* mask,
                                 size_t word_count) {
  return guard(__func__, [&] {
    const lkao::RayBundles& found = object(bundles, "bundles");
    needed(mask, "mask");
    const Bundles own(bundle, word_count);
    lkao::OcclusionMask blocked;
    found.blocked(own.get(), {&blocked, 1});
    write_words(blocked, mask, word_count);
  });
}

lkao_status lkao_bundles_blocked_batch(const lkao_bundles* bundles, const lkao_bundle* batch, size_t count,
                                       uint64_t* masks, size_t mask_stride, size_t word_count,
                                       const lkao_batch_options* options) {
  return guard(__func__, [&] {
    const lkao::RayBundles& found = object(bundles, "bundles");
    const lkao_batch_options how = read_or_defaults(options, LKAO_BATCH_OPTIONS_INIT, "options");
    if (count > 0) needed(masks, "masks");
    const std::size_t stride = checked_stride(mask_stride, word_count * sizeof(std::uint64_t), "mask_stride");
    const Bundles own(batch, count, word_count);
    std::vector<lkao::OcclusionMask> blocked(count);
    run_on_threads(how.thread_count, "options->thread_count",
                   [&] { found.blocked(own.get(), blocked, progress_of(how.progress, how.progress_user)); });
    for (std::size_t k = 0; k < count; ++k) {
      auto* const to = reinterpret_cast<unsigned char*>(masks) + k * stride;
      write_words(blocked[k], reinterpret_cast<std::uint64_t*>(to), word_count);
    }
  });
}

lkao_status lkao_scene_create_of_bundles(const lkao_bundles* bundles, lkao_scene** scene) {
  return create(__func__, scene, "scene", [&] { return object(bundles, "bundles").occluders(); });
}
