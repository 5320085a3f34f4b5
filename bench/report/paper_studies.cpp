#include "bench/report/paper_studies.h"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "bench/report/measured.h"
#include "bench/report/papers.h"
#if LKAO_BENCH_GL
#include "bench/raster_frames.h"
#include "method/gl_device.h"
#endif
#include "method/stopwatch.h"

namespace lkao::bench {
namespace {

using nlohmann::ordered_json;

std::optional<EmbreeMode> mode_named(const std::string& name) {
  for (const EmbreeMode& mode : all_embree_modes()) {
    if (mode.name() == name) return mode;
  }
  return std::nullopt;
}

// With the mode of Embree that was best on the subject, so that none is looked for at each radius.
std::vector<Contestant> swept_contestants(const std::vector<Contestant>& contestants, const ordered_json& results) {
  std::vector<Contestant> swept;
  for (const ordered_json& result : results) {
    const auto found = std::find_if(contestants.begin(), contestants.end(), [&](const Contestant& contestant) {
      return contestant.name == result.at("contestant");
    });
    if (found == contestants.end() || !is_swept(*found)) continue;
    swept.push_back(*found);
    if (found->is_best_embree) swept.back().embree = mode_named(result.at("mode"));
  }
  return swept;
}

#if LKAO_BENCH_GL
ordered_json cull_rows(const StudyScene& scene, float radius, int round_count) {
  raster::Rasterizer rasterizer(method::prepare_device({}));
  const std::vector<FrameSetup> setups = cull_setups();
  const std::vector<FrameResult> results =
      RasterFrames(rasterizer, scene, radius, {.round_count = round_count}).draw(setups, true);
  const FrameResult& last = results.back();
  ordered_json rows = ordered_json::array();
  for (std::size_t i = 0; i < setups.size(); ++i) {
    const double survivors = static_cast<double>(results[i].counts.survivors);
    rows.push_back({{"tests", setups[i].name},
                    {"fragments", survivors / static_cast<double>(last.counts.survivors)},
                    {"speed", last.milliseconds / results[i].milliseconds}});
  }
  return {{"width", scene.view.width}, {"height", scene.view.height}, {"rows", rows}};
}
#endif

}  // namespace

ordered_json PaperStudies::sweep(const ordered_json& results) {
  const std::vector<Contestant> swept = swept_contestants(contestants, results);
  ordered_json steps = ordered_json::array();
  for (const float share : kSweptShares) {
    const Subject other(subject.scene, share * subject.radius);
    std::optional<Measurer> measurer;
    ordered_json step = {{"radius", other.radius}};
    for (const Contestant& contestant : swept) {
      const std::string name = fmt::format("{}, {}, time at {} of the radius", subject.key, contestant.name, share);
      if (const auto known = store.find(name)) {
        step[contestant.name] = known->at("seconds");
        continue;
      }
      ordered_json seconds;
      if (time.left() > 0) {
        if (!measurer) measurer.emplace(scene, other, round_count);
        // No more than a third of what is left, so that something is left for those to come.
        const auto timed = measurer->time(contestant, time.left() / 3);
        if (const auto* const measured = std::get_if<Timed>(&timed)) seconds = measured->seconds;
      }
      store.put(name, {{"seconds", seconds}});
      step[contestant.name] = seconds;
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

ordered_json PaperStudies::culls() {
#if LKAO_BENCH_GL
  const auto draws = [](const Contestant& contestant) { return contestant.family == Family::raster; };
  if (std::none_of(contestants.begin(), contestants.end(), draws)) return {};
  const std::string name = subject.key + ", culls";
  if (const auto values = store.find(name)) return values->at("culls");
  ordered_json culls;
  if (time.left() == kNoLimit) {
    culls = cull_rows(subject.scene, subject.radius, round_count);
  } else if (time.left() > 0) {
    // What a picture of an eighth of the width takes tells how large a one there is time for.
    const method::Stopwatch watch;
    culls = cull_rows(scene.shrunk(8), subject.radius, 1);
    const double seconds = watch.seconds();
    for (const int divisor : {1, 2, 4}) {
      if (64 * seconds / (divisor * divisor) > time.left()) continue;
      culls = cull_rows(divisor == 1 ? subject.scene : scene.shrunk(divisor), subject.radius, 1);
      break;
    }
  }
  store.put(name, {{"culls", culls}});
  return culls;
#else
  return {};
#endif
}

}  // namespace lkao::bench
