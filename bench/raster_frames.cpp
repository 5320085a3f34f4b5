#include "bench/raster_frames.h"

#include "method/median.h"
#include "method/speed.h"

namespace lkao::bench {
namespace {

bool share_a_pass(const FrameSetup& a, const FrameSetup& b) {
  return a.masks == b.masks && a.pass.geometry == b.pass.geometry && a.pass.accumulator == b.pass.accumulator &&
         a.pass.precision == b.pass.precision;
}

FrameResult result_of(const method::Answers& answers, const method::Answers& exact) {
  FrameResult result;
  result.milliseconds = 1000 * answers.seconds;
  result.mrays_per_second = method::mrays_per_second(answers.ray_count, answers.seconds);
  result.off = deviation(answers, exact);
  return result;
}

}  // namespace

std::vector<FrameSetup> cull_setups() {
  gl::RasterOptions raster{.culls = {false, false, false, false, false, false}};
  std::vector<FrameSetup> setups = {{.name = "depth test only", .sidedness = Sidedness::one_sided, .raster = raster}};
  const std::pair<const char*, bool gl::Culls::*> added[] = {{"+ 1. far depth", &gl::Culls::far_depth},
                                                             {"+ 2. bounding sphere", &gl::Culls::bounding_sphere},
                                                             {"+ 3. facing", &gl::Culls::facing},
                                                             {"+ 4. plane distance", &gl::Culls::plane_distance},
                                                             {"+ 5. horizon", &gl::Culls::horizon}};
  for (const auto& [name, cull] : added) {
    raster.culls.*cull = true;
    setups.push_back({.name = name, .sidedness = Sidedness::one_sided, .raster = raster});
  }
  return setups;
}

RasterFrames::RasterFrames(raster::Rasterizer& rasterizer, const StudyScene& scene, float radius,
                           const FrameOptions& options)
    : rasterizer_(rasterizer),
      scene_(scene),
      radius_(radius),
      options_(options),
      pattern_(SamplePattern::standard(options.ray_count)) {
  rasterizer_.set_view(scene.camera, scene.view);
}

const method::Answers& RasterFrames::exact(Sidedness sidedness) {
  const auto [place, is_new] = exact_.try_emplace(sidedness);
  if (is_new) {
    const AmbientOcclusion ao(OccluderBvh(scene_.mesh.view()), pattern_, {.radius = radius_, .sidedness = sidedness});
    place->second = method::ask(ao, scene_.view.receivers, 1);
  }
  return place->second;
}

FrameResult RasterFrames::query() {
  const method::Answers& answers = exact(Sidedness::two_sided);
  return result_of(answers, answers);
}

std::vector<FrameResult> RasterFrames::draw(const std::vector<FrameSetup>& setups, bool count) {
  std::vector<FrameResult> results;
  for (std::size_t first = 0; first < setups.size();) {
    std::size_t last = first + 1;
    while (last < setups.size() && share_a_pass(setups[first], setups[last])) ++last;

    const PlaneMaskTable table = make_table(setups[first].masks);
    start_pass(setups[first], table, false);
    std::vector<std::vector<double>> seconds(last - first);
    for (int round = 0; round < options_.round_count; ++round) {
      for (std::size_t i = first; i < last; ++i) {
        seconds[i - first].push_back(rasterizer_.draw(options_of(setups[i]), setups[i].raster));
        if (round + 1 == options_.round_count) results.push_back(compare(setups[i], seconds[i - first]));
      }
    }
    if (count) {
      start_pass(setups[first], table, true);
      for (std::size_t i = first; i < last; ++i) {
        rasterizer_.draw(options_of(setups[i]), setups[i].raster);
        results[i].counts = rasterizer_.pass().read_fragment_counts();
      }
    }
    first = last;
  }
  return results;
}

RayOptions RasterFrames::options_of(const FrameSetup& setup) const {
  return {.radius = radius_, .sidedness = setup.sidedness};
}

PlaneMaskTable RasterFrames::make_table(PlaneMasks masks) const {
  const bool is_exact = masks == PlaneMasks::must_may;
  return PlaneMaskTable(
      pattern_, {.resolution = is_exact ? options_.exact_resolution : options_.nearest_resolution, .masks = masks});
}

void RasterFrames::start_pass(const FrameSetup& setup, const PlaneMaskTable& table, bool count) {
  gl::MaskPassSetup pass = setup.pass;
  pass.count_fragments = count;
  rasterizer_.start_pass(pass, scene_.mesh, table);
  rasterizer_.warm_up(options_of(setup), setup.raster);
}

FrameResult RasterFrames::compare(const FrameSetup& setup, const std::vector<double>& seconds) {
  method::Answers frame{.occlusion = rasterizer_.read_occlusion(),
                        .masks = rasterizer_.pass().read_masks(),
                        .ray_count = exact(setup.sidedness).ray_count,
                        .seconds = method::median(seconds)};
  return result_of(frame, exact(setup.sidedness));
}

}  // namespace lkao::bench
