#include "lkao/c/sky.h"

#include <cstring>
#include <limits>

#include "c_api/batches.h"
#include "c_api/handles.h"
#include "c_api/words.h"

using namespace lkao::c_api;

lkao_status lkao_sky_create(const lkao_scene* scene, const lkao_sky_options* options, lkao_sky** sky) {
  return create(__func__, sky, "sky", [&] {
    const lkao_sky_options from = read_or_defaults(options, LKAO_SKY_OPTIONS_INIT, "options");
    return lkao::SkyVisibility(object(scene, "scene"), from.ray_count,
                               {.radius = from.radius == 0 ? std::numeric_limits<float>::infinity() : from.radius,
                                .sidedness = word(kSidednesses, from.sidedness, "options->sidedness"),
                                .seed = from.seed,
                                .surface_offset = from.surface_offset},
                               word(kKernels, from.kernel, "options->kernel"));
  });
}

lkao_status lkao_sky_destroy(lkao_sky* sky) { return destroy(__func__, sky, "sky"); }

lkao_status lkao_sky_query(const lkao_sky* sky, const lkao_receiver* receiver, uint64_t index,
                           lkao_sky_shares* shares) {
  return guard(__func__, [&] {
    needed(shares, "shares");
    const lkao::SkyShares found = object(sky, "sky").query(receiver_of(receiver), index);
    *shares = {found.visibility, found.above, found.below};
  });
}

lkao_status lkao_sky_query_batch(const lkao_sky* sky, const lkao_receivers* receivers, lkao_sky_shares* shares,
                                 size_t stride, const lkao_batch_options* options, lkao_query_report* report) {
  return guard(__func__, [&] {
    const lkao::SkyVisibility& found = object(sky, "sky");
    static_assert(sizeof(lkao_sky_shares) == sizeof(lkao::SkyShares));
    Output<lkao::SkyShares> to(needed(shares, "shares"), stride, 1, "stride");
    constexpr std::size_t kSides = 2;  // Each receiver counts twice.
    answer_batch(
        receivers, options, report,
        [&](std::size_t first, std::span<const lkao::Receiver> part, std::uint64_t index,
            const lkao::Progress& progress) {
          const lkao::QueryReport part_report = found.query(part, to.begin(first, part.size()), index, progress);
          to.finish(first, part.size());
          return part_report;
        },
        kSides);
  });
}
