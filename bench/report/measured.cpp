#include "bench/report/measured.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <span>

#include <fmt/format.h>

#include "image/one_line.h"
#include "lod/simplify.h"
#include "method/list.h"
#include "method/median.h"
#include "method/occluders.h"
#include "method/stopwatch.h"
#include "reference/embree_reference.h"

namespace lkao::bench {
namespace {

using Masks = std::vector<std::uint64_t>;

struct Frame {
  std::vector<float> occlusion;
  Masks masks;  // none where the contestant does not tell ray by ray
  std::uint64_t ray_count = 0;
  double seconds = 0;
};

// A frame that takes longer is measured once: it does not depend on what was a moment before.
constexpr double kLongSeconds = 2;
// An answer of what draws is several frames, of so many seconds together (method/frame.h).
constexpr double kDrawnSeconds = 1;
constexpr int kDrawnCount = 5;

// How many times as long a frame of twice the width takes at most: four times the pixels, each of which looks at twice
// as many.
constexpr double kMostGrowth = 8;

// Answers all pixels of a view once: the subject's, or the same in fewer pixels.
using Answer = std::function<void(const StudyScene&, Frame&)>;

// Masks of the pixels that see something, as a picture.
std::vector<float> picture_of(const Masks& masks, const SamplePattern& pattern, const scene::ReceiverImage& view) {
  const auto word_count = static_cast<std::size_t>(pattern.word_count());
  std::vector<float> picture(view.receivers.size(), std::numeric_limits<float>::quiet_NaN());
  auto word = masks.begin();
  for (std::size_t pixel = 0; pixel < picture.size(); ++pixel) {
    if (!view.sees(pixel)) continue;
    int blocked = 0;
    for (std::size_t i = 0; i < word_count; ++i) blocked += std::popcount(*word++);
    picture[pixel] = static_cast<float>(blocked) / static_cast<float>(pattern.ray_count());
  }
  return picture;
}

// Of each pixel; NaN where it sees nothing.
std::vector<float> mismatches(const Masks& masks, const Masks& expected, const scene::ReceiverImage& view,
                              const Contestant& contestant) {
  const auto word_count = static_cast<std::size_t>(word_count_of(contestant.ray_count));
  std::vector<float> counts(view.receivers.size(), std::numeric_limits<float>::quiet_NaN());
  std::size_t first = 0;  // word
  for (std::size_t pixel = 0; pixel < counts.size(); ++pixel) {
    const bool has_words = !contestant.is_embree_mode() || view.sees(pixel);
    if (!has_words) continue;
    int count = 0;
    for (std::size_t i = first; i < first + word_count; ++i) count += std::popcount(masks[i] ^ expected[i]);
    first += word_count;
    if (view.sees(pixel)) counts[pixel] = static_cast<float>(count);
  }
  return counts;
}

// Of a view whose frames may be so short that what else goes on is most of their time.
double shortest(const Answer& answer, const StudyScene& seen) {
  constexpr int kMaxCount = 3;
  constexpr double kEnoughSeconds = 0.1;
  Frame frame;
  const method::Stopwatch watch;
  answer(seen, frame);
  double least = frame.seconds;
  for (int i = 1; i < kMaxCount && watch.seconds() < kEnoughSeconds; ++i) {
    answer(seen, frame);
    least = std::min(least, frame.seconds);
  }
  return least;
}

}  // namespace

struct Measurer::State {
  PreparedScene& scene;
  const Subject& subject;
  int round_count;
  std::map<std::string, Masks> expected = {};  // by robust Embree, by question
  std::map<std::pair<float, float>, lod::Chain> chains = {};
  std::optional<EmbreeMode> fastest = {};
  std::unique_ptr<method::Method> yardstick = {};  // the query with 128 rays

  // One that was opened, and what it stands on.
  struct Opened {
    std::optional<method::Occluders> simplified;
    std::unique_ptr<method::Method> method;  // none: a mode of Embree
    Answer answer;
    Timed timed;  // what is known before a frame is
  };

  method::Question question_of(const Contestant& contestant) const;
  std::unique_ptr<method::Method> open_method(const Contestant& contestant, method::Occluders& from) const;
  std::optional<Estimate> open(const Contestant& contestant, double allowed, Opened& opened);
  std::variant<const lod::Chain*, Estimate> chain_of(const ReportLevels& levels, double allowed);
  const Masks& expected_of(const Contestant& contestant);
  Answer answer_by_embree(const Contestant& contestant);
  Answer answer_by(method::Method& method, method::Occluders& from, const Contestant& contestant) const;
  const EmbreeMode& best_embree();
  std::optional<Estimate> longer_than(double allowed, const Opened& opened, double setup_seconds);
  std::variant<Timed, Estimate> run(const Contestant& contestant, double allowed, Frame& frame);
  std::variant<Timed, Estimate> ask(const Contestant& contestant, double allowed, Frame& frame);
  double seconds_of_yardstick();
};

method::Question Measurer::State::question_of(const Contestant& contestant) const {
  method::Question question{
      .radius = subject.radius,
      .ray_count = contestant.ray_count,
      .pattern_kind = contestant.pattern,
      .falloff = contestant.falloff == OwnFalloff::linear ? Falloff::linear() : Falloff::constant()};
  if (contestant.table_resolution != 0) question.table_resolution = contestant.table_resolution;
  return question;
}

// That takes any receivers is prepared at once; the others are for each view.
std::unique_ptr<method::Method> Measurer::State::open_method(const Contestant& contestant,
                                                             method::Occluders& from) const {
  auto opened = method::method_named(contestant.method).open(settings_of(contestant.method, contestant.settings, {}));
  if (opened->abilities().any_receivers) opened->prepare({from, question_of(contestant)});
  return opened;
}

// Stopped where it takes longer.
std::variant<const lod::Chain*, Estimate> Measurer::State::chain_of(const ReportLevels& levels, double allowed) {
  const auto found = chains.find({levels.k, levels.epsilon_share});
  if (found != chains.end()) return &found->second;
  lod::LevelRule rule;
  rule.k = levels.k;
  rule.epsilon = levels.epsilon_share * lod::automatic_epsilon(subject.radius, rule);
  Estimate estimate;
  const method::Stopwatch watch;
  const Progress keeps_to_time = [&](std::size_t done, std::size_t total) {
    const double seconds = watch.seconds();
    if (seconds <= allowed) return true;
    estimate.seconds = seconds * static_cast<double>(total) / static_cast<double>(std::max<std::size_t>(done, 1));
    return false;
  };
  try {
    lod::Chain chain = lod::simplify(subject.scene.mesh, {.levels = rule}, keeps_to_time).chain;
    return &chains.emplace(std::pair(levels.k, levels.epsilon_share), std::move(chain)).first->second;
  } catch (const Cancelled&) {
    return estimate;
  }
}

const Masks& Measurer::State::expected_of(const Contestant& contestant) {
  const method::Question question = question_of(contestant);
  // Embree's modes know nothing of pixels that see nothing, and so number the others otherwise.
  const std::vector<Receiver>& pixels = subject.scene.view.receivers;
  const bool are_seen = contestant.is_embree_mode() && subject.scene.receivers.size() != pixels.size();
  const std::string name = fmt::format("{} {} {} {}", question.ray_count, pattern_kind_name(question.pattern_kind),
                                       question.falloff.name(), are_seen);
  const auto [known, is_new] = expected.try_emplace(name);
  if (!is_new) return known->second;
  const AmbientOcclusion query(scene.occluders.hierarchies(), question.pattern(), question.ray_options());
  const std::vector<Receiver>& receivers = are_seen ? subject.scene.receivers : pixels;
  known->second.resize(receivers.size() * static_cast<std::size_t>(query.pattern().word_count()));
  scene.oracle().query(query, receivers, {.mask_words = known->second});
  return known->second;
}

// With 128 rays, of which the caches have what they need the second time.
const EmbreeMode& Measurer::State::best_embree() {
  if (fastest) return *fastest;
  double least = std::numeric_limits<double>::infinity();
  for (const EmbreeMode& mode : all_embree_modes()) {
    const Answer answer = answer_by_embree({.name = "", .method = "embree", .embree = mode});
    Frame frame;
    answer(subject.scene, frame);
    answer(subject.scene, frame);
    if (frame.seconds >= least) continue;
    least = frame.seconds;
    fastest = mode;
  }
  return *fastest;
}

Answer Measurer::State::answer_by_embree(const Contestant& contestant) {
  const method::Question question = question_of(contestant);
  const auto query =
      std::make_shared<AmbientOcclusion>(scene.occluders.hierarchies(), question.pattern(), question.ray_options());
  const RTCScene embree = scene.rival().plain();
  return [embree, query, mode = contestant.embree ? *contestant.embree : best_embree()](const StudyScene& seen,
                                                                                        Frame& frame) {
    frame.masks.resize(seen.receivers.size() * static_cast<std::size_t>(query->pattern().word_count()));
    const method::Stopwatch watch;
    cast(mode, embree, *query, seen.receivers, frame.masks);
    frame.seconds = watch.seconds();
    frame.occlusion = picture_of(frame.masks, query->pattern(), seen.view);
  };
}

Answer Measurer::State::answer_by(method::Method& method, method::Occluders& from, const Contestant& contestant) const {
  const auto word_count =
      method.abilities().masks ? static_cast<std::size_t>(word_count_of(contestant.ray_count)) : std::size_t{0};
  return [&method, &from, word_count, question = question_of(contestant),
          prepared = static_cast<const StudyScene*>(nullptr)](const StudyScene& seen, Frame& frame) mutable {
    if (!method.abilities().any_receivers && prepared != &seen) {
      method.prepare({from, question, method::View{seen.camera, seen.view}});
    }
    prepared = &seen;
    const std::vector<Receiver>& pixels = seen.view.receivers;
    frame.occlusion.resize(pixels.size());
    frame.masks.resize(pixels.size() * word_count);
    frame.seconds = method.answer(pixels, {.occlusion = frame.occlusion, .mask_words = frame.masks}, 0).seconds;
  };
}

double Measurer::State::seconds_of_yardstick() {
  const std::vector<Receiver>& pixels = subject.scene.view.receivers;
  std::vector<float> occlusion(pixels.size());
  return yardstick->answer(pixels, {.occlusion = occlusion}, 0).seconds;
}

Measurer::Measurer(PreparedScene& scene, const Subject& subject, int round_count)
    : state_(new State{.scene = scene, .subject = subject, .round_count = round_count}) {
  state_->yardstick = state_->open_method({.name = "", .method = "bvh"}, scene.occluders);
}

Measurer::~Measurer() = default;

// Opened, or made of what Embree has; not where its levels take too long already.
std::optional<Estimate> Measurer::State::open(const Contestant& contestant, double allowed, Opened& opened) {
  if (contestant.is_embree_mode()) {
    opened.answer = answer_by_embree(contestant);
    opened.timed.mode = (contestant.embree ? *contestant.embree : best_embree()).name();
    return std::nullopt;
  }
  if (contestant.levels) {
    const auto chain = chain_of(*contestant.levels, allowed);
    if (const auto* const estimate = std::get_if<Estimate>(&chain)) return *estimate;
    opened.simplified.emplace(scene.scene.mesh, *std::get<const lod::Chain*>(chain), subject.radius);
  }
  method::Occluders& from = opened.simplified ? *opened.simplified : scene.occluders;
  opened.method = open_method(contestant, from);
  opened.answer = answer_by(*opened.method, from, contestant);
  opened.timed.device = opened.method->device();
  return std::nullopt;
}

// None where it takes no longer. Some frames take a time for each triangle and one for each pixel, others, which look
// at all pixels around each, one that grows with a power of the pixels. The larger of both counts.
std::optional<Estimate> Measurer::State::longer_than(double allowed, const Opened& opened, double setup_seconds) {
  const bool draws = !opened.timed.device.empty();
  // Of all that is measured, where a frame takes so long.
  const auto cost = [&](double frame) {
    // Some draw one more, to count.
    if (frame > kLongSeconds) return setup_seconds + (draws ? 2 : 1.2) * frame;
    const double answer = draws ? std::min(kDrawnCount * frame, kDrawnSeconds + frame) : frame;
    return setup_seconds + (1 + round_count) * answer;
  };
  double seconds[2];
  for (int i = 0; i < 2; ++i) {
    const StudyScene& small = scene.shrunk(i == 0 ? 8 : 4);
    const method::Stopwatch watch;
    seconds[i] = shortest(opened.answer, small);
    if (i == 0) setup_seconds += std::max(0.0, watch.seconds() - seconds[i]);
    // Not even where the time follows the pixels' number times the width; or so long that no more is tried.
    if (i == 0 && cost(kMostGrowth * kMostGrowth * kMostGrowth * seconds[0]) <= allowed) return std::nullopt;
    if (i == 0 && cost(2 * seconds[0]) > allowed) return Estimate{cost(64 * seconds[0])};
  }
  // A quarter of the width has 4, all of it 64 times the pixels of an eighth.
  const double for_pixels = std::max(0.0, seconds[1] - seconds[0]) / 3;  // of an eighth
  const double linear = seconds[1] + 60 * for_pixels;
  const double power = seconds[1] * std::pow(std::clamp(seconds[1] / seconds[0], 1.0, kMostGrowth), 2);
  const Estimate estimate{cost(std::max(linear, power))};
  return estimate.seconds > allowed ? std::optional(estimate) : std::nullopt;
}

std::variant<Timed, Estimate> Measurer::State::run(const Contestant& contestant, double allowed, Frame& frame) {
  try {
    return ask(contestant, allowed, frame);
  } catch (const std::exception& error) {
    throw CannotAnswer(image::one_line(error.what()));
  }
}

// In rounds.
std::variant<Timed, Estimate> Measurer::State::ask(const Contestant& contestant, double allowed, Frame& frame) {
  const method::Stopwatch watch;
  Opened opened;
  if (const auto estimate = open(contestant, allowed, opened)) return *estimate;
  if (std::isfinite(allowed)) {
    if (const auto estimate = longer_than(allowed, opened, watch.seconds())) return *estimate;
  }
  std::vector<double> seconds, ratios;
  opened.answer(subject.scene, frame);  // once for the caches
  const bool is_long = frame.seconds > kLongSeconds;
  for (int round = 0; round < (is_long ? 1 : round_count); ++round) {
    const double of_yardstick = seconds_of_yardstick();
    if (!is_long) opened.answer(subject.scene, frame);
    seconds.push_back(frame.seconds);
    ratios.push_back(frame.seconds / of_yardstick);
  }
  opened.timed.seconds = method::median(seconds);
  opened.timed.query_ratio = method::median(ratios);
  if (opened.method) opened.timed.keys = opened.method->remarks().keys;
  return opened.timed;
}

std::variant<Timed, Estimate> Measurer::time(const Contestant& contestant, double allowed) {
  Frame frame;
  return state_->run(contestant, allowed, frame);
}

std::variant<Measured, Estimate> Measurer::measure(const Contestant& contestant, References& references,
                                                   double allowed) {
  Frame frame;
  std::variant<Timed, Estimate> timed = state_->run(contestant, allowed, frame);
  if (const auto* const estimate = std::get_if<Estimate>(&timed)) return *estimate;
  Measured measured;
  static_cast<Timed&>(measured) = std::get<Timed>(std::move(timed));
  const scene::ReceiverImage& view = state_->subject.scene.view;
  const auto errors_from = [&](OwnFalloff falloff) {
    return errors_of(frame.occlusion, references.of(falloff).mean, view.width, view.height);
  };
  measured.errors = errors_from(OwnFalloff::constant);
  if (contestant.falloff != OwnFalloff::constant) measured.own_falloff = errors_from(contestant.falloff);
  if (!frame.masks.empty()) {
    const Masks& expected = state_->expected_of(contestant);
    const std::uint64_t count = reference::count_mismatched_rays(frame.masks, expected);
    const double rays = static_cast<double>(view.receiver_count) * contestant.ray_count;
    measured.mismatch_rate = static_cast<double>(count) / rays;
    if (count > 0) measured.mismatches = mismatches(frame.masks, expected, view, contestant);
  }
  measured.picture = std::move(frame.occlusion);
  return measured;
}

nlohmann::ordered_json to_json(const PictureErrors& errors) {
  return {{"bias", errors.bias},
          {"mae", errors.mae},
          {"rmse", errors.rmse},
          {"median", errors.median},
          {"percentile_95", errors.percentile_95},
          {"percentile_99", errors.percentile_99},
          {"largest", errors.largest},
          {"psnr", errors.psnr},
          {"equal_8bit_share", errors.equal_8bit_share},
          {"log_error", errors.log_error}};
}

}  // namespace lkao::bench
