#include "raster_frames.h"

#include <cmath>

#include "cli/stopwatch.h"
#include "median.h"
#include "reference/embree_reference.h"

namespace lkao::bench {
namespace {

bool share_a_pass(const FrameSetup& a, const FrameSetup& b) {
  return a.masks == b.masks && a.levels == b.levels && a.pass.geometry == b.pass.geometry &&
         a.pass.accumulator == b.pass.accumulator && a.pass.precision == b.pass.precision;
}

}  // namespace

double mean_change(std::span<const float> values, std::span<const float> from) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) || std::isnan(from[i])) continue;
    sum += static_cast<double>(values[i]) - static_cast<double>(from[i]);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
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

const RasterFrames::Answers& RasterFrames::answers(Sidedness sidedness) {
  const auto [place, is_new] = answers_.try_emplace(sidedness);
  Answers& answers = place->second;
  if (!is_new) return answers;
  const AmbientOcclusion ao(OccluderBvh(scene_.mesh.view()), pattern_, {.radius = radius_, .sidedness = sidedness});
  const std::vector<Receiver>& receivers = scene_.view.receivers;
  answers.occlusion.resize(receivers.size());
  answers.masks.resize(receivers.size() * static_cast<std::size_t>(pattern_.word_count()));
  const cli::Stopwatch time;
  answers.ray_count = ao.query(receivers, {.occlusion = answers.occlusion, .mask_words = answers.masks}).ray_count;
  answers.seconds = time.seconds();
  return answers;
}

FrameResult RasterFrames::query() {
  const Answers& exact = answers(Sidedness::two_sided);
  FrameResult result;
  result.milliseconds = 1000 * exact.seconds;
  result.mrays_per_second = 1e-6 * static_cast<double>(exact.ray_count) / exact.seconds;
  result.error = image::compare(exact.occlusion, exact.occlusion);
  return result;
}

std::vector<FrameResult> RasterFrames::draw(const std::vector<FrameSetup>& setups, bool count) {
  std::vector<FrameResult> results;
  for (std::size_t first = 0; first < setups.size();) {
    std::size_t last = first + 1;
    while (last < setups.size() && share_a_pass(setups[first], setups[last])) ++last;

    start_pass(setups[first], false);
    std::vector<std::vector<double>> seconds(last - first);
    for (int round = 0; round < options_.round_count; ++round) {
      for (std::size_t i = first; i < last; ++i) {
        seconds[i - first].push_back(rasterizer_.draw(options_of(setups[i])));
        if (round + 1 == options_.round_count) results.push_back(compare(setups[i], seconds[i - first]));
      }
    }
    if (count) {
      start_pass(setups[first], true);
      for (std::size_t i = first; i < last; ++i) {
        rasterizer_.draw(options_of(setups[i]));
        results[i].counts = rasterizer_.pass().read_fragment_counts();
      }
    }
    first = last;
  }
  return results;
}

gl::DrawOptions RasterFrames::options_of(const FrameSetup& setup) const {
  gl::DrawOptions options = setup.draw;
  options.radius = radius_;
  return options;
}

void RasterFrames::start_pass(const FrameSetup& setup, bool count) {
  const bool is_exact = setup.masks == PlaneMasks::must_may;
  const PlaneMaskTable table(
      pattern_,
      {.resolution = is_exact ? options_.exact_resolution : options_.nearest_resolution, .masks = setup.masks});
  gl::PassSetup pass = setup.pass;
  pass.count_fragments = count;
  if (setup.levels != nullptr) {
    rasterizer_.start_pass(pass, setup.levels->mesh, table, setup.levels->ranges);
  } else {
    rasterizer_.start_pass(pass, scene_.mesh, table);
  }
  // A driver leaves some of its work to the first frame: one that has next to nothing to draw.
  gl::DrawOptions options = setup.draw;
  options.radius = 1e-4f * radius_;
  rasterizer_.draw(options);
}

FrameResult RasterFrames::compare(const FrameSetup& setup, const std::vector<double>& seconds) {
  const Answers& exact = answers(setup.draw.two_sided ? Sidedness::two_sided : Sidedness::one_sided);
  const auto ray_count = static_cast<double>(exact.ray_count);
  FrameResult result;
  result.milliseconds = 1000 * median(seconds);
  result.mrays_per_second = 1e-3 * ray_count / result.milliseconds;
  const std::uint64_t wrong_count = reference::count_mismatched_rays(rasterizer_.pass().read_masks(), exact.masks);
  result.mismatch_rate = static_cast<double>(wrong_count) / ray_count;
  const std::vector<float> occlusion = rasterizer_.read_occlusion();
  result.error = image::compare(occlusion, exact.occlusion);
  result.mean_change = mean_change(occlusion, exact.occlusion);
  return result;
}

}  // namespace lkao::bench
