#include "bench/report/measured.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <span>

#include <fmt/format.h>

#include "lod/simplify.h"
#include "method/answers.h"
#include "method/list.h"
#include "method/median.h"
#include "method/occluders.h"
#include "method/stopwatch.h"
#include "reference/embree_reference.h"
#include "reference/embree_scene.h"

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

// Answers all pixels once.
using Answer = std::function<void(Frame&)>;

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

}  // namespace

struct Measurer::State {
  const Subject& subject;
  int round_count;
  method::Occluders occluders;
  std::optional<reference::EmbreeReference> oracle;
  std::optional<reference::EmbreeScene> rival;
  Masks expected;  // by robust Embree, of the last question
  std::string expected_name;
  std::map<std::pair<float, float>, lod::Chain> chains;
  std::optional<EmbreeMode> fastest;
  std::unique_ptr<method::Method> yardstick;  // the query with 128 rays

  std::span<const Receiver> pixels() const { return subject.scene.view.receivers; }
  // Embree's modes know nothing of pixels that see nothing.
  std::span<const Receiver> receivers_of(const Contestant& contestant) const {
    return contestant.is_embree_mode() ? std::span<const Receiver>(subject.scene.receivers) : pixels();
  }
  method::Question question_of(const Contestant& contestant) const;
  std::unique_ptr<method::Method> open(const Contestant& contestant, method::Occluders& from) const;
  const lod::Chain& chain_of(const ReportLevels& levels);
  const Masks& expected_of(const Contestant& contestant);
  Answer answer_by_embree(const Contestant& contestant);
  Answer answer_by(method::Method& method, int word_count) const;
  const EmbreeMode& best_embree();
  Timed run(const Contestant& contestant, Frame& frame);
  double seconds_of_yardstick();
};

method::Question Measurer::State::question_of(const Contestant& contestant) const {
  method::Question question{.radius = subject.radius,
                            .ray_count = contestant.ray_count,
                            .pattern_kind = contestant.pattern,
                            .falloff = contestant.has_linear_falloff ? Falloff::linear() : Falloff::constant()};
  if (contestant.table_resolution != 0) question.table_resolution = contestant.table_resolution;
  return question;
}

std::unique_ptr<method::Method> Measurer::State::open(const Contestant& contestant, method::Occluders& from) const {
  auto opened = method::method_named(contestant.method).open(settings_of(contestant.method, contestant.settings, {}));
  opened->prepare({from, question_of(contestant), method::View{subject.scene.camera, subject.scene.view}});
  return opened;
}

const lod::Chain& Measurer::State::chain_of(const ReportLevels& levels) {
  const auto found = chains.find({levels.k, levels.epsilon_share});
  if (found != chains.end()) return found->second;
  lod::LevelRule rule;
  rule.k = levels.k;
  rule.epsilon = levels.epsilon_share * lod::automatic_epsilon(subject.radius, rule);
  lod::Chain chain = lod::simplify(subject.scene.mesh, {.levels = rule}).chain;
  return chains.emplace(std::pair(levels.k, levels.epsilon_share), std::move(chain)).first->second;
}

const Masks& Measurer::State::expected_of(const Contestant& contestant) {
  const method::Question question = question_of(contestant);
  const std::string name = fmt::format("{} {} {} {}", question.ray_count, pattern_kind_name(question.pattern_kind),
                                       question.falloff.name(), contestant.is_embree_mode());
  if (name == expected_name) return expected;
  const AmbientOcclusion query(occluders.hierarchies(), question.pattern(), question.ray_options());
  const std::span<const Receiver> receivers = receivers_of(contestant);
  expected.resize(receivers.size() * static_cast<std::size_t>(query.pattern().word_count()));
  if (!oracle) oracle.emplace(subject.scene.mesh);
  oracle->query(query, receivers, {.mask_words = expected});
  expected_name = name;
  return expected;
}

// With 128 rays, of which the caches have what they need the second time.
const EmbreeMode& Measurer::State::best_embree() {
  if (fastest) return *fastest;
  double least = std::numeric_limits<double>::infinity();
  for (const EmbreeMode& mode : all_embree_modes()) {
    const Answer answer = answer_by_embree({.name = "", .method = "embree", .embree = mode});
    Frame frame;
    answer(frame);
    answer(frame);
    if (frame.seconds >= least) continue;
    least = frame.seconds;
    fastest = mode;
  }
  return *fastest;
}

Answer Measurer::State::answer_by_embree(const Contestant& contestant) {
  if (!rival) rival.emplace(subject.scene.mesh.view(), false);
  const method::Question question = question_of(contestant);
  const auto query =
      std::make_shared<AmbientOcclusion>(occluders.hierarchies(), question.pattern(), question.ray_options());
  return [this, query, mode = contestant.embree ? *contestant.embree : best_embree()](Frame& frame) {
    const std::vector<Receiver>& receivers = subject.scene.receivers;
    frame.masks.resize(receivers.size() * static_cast<std::size_t>(query->pattern().word_count()));
    const method::Stopwatch watch;
    cast(mode, rival->plain(), *query, receivers, frame.masks);
    frame.seconds = watch.seconds();
    frame.occlusion = picture_of(frame.masks, query->pattern(), subject.scene.view);
  };
}

Answer Measurer::State::answer_by(method::Method& method, int word_count) const {
  const std::size_t mask_size = method.abilities().masks ? pixels().size() * static_cast<std::size_t>(word_count) : 0;
  return [this, &method, mask_size](Frame& frame) {
    frame.occlusion.resize(pixels().size());
    frame.masks.resize(mask_size);
    frame.seconds = method.answer(pixels(), {.occlusion = frame.occlusion, .mask_words = frame.masks}, 0).seconds;
  };
}

double Measurer::State::seconds_of_yardstick() {
  std::vector<float> occlusion(pixels().size());
  return yardstick->answer(pixels(), {.occlusion = occlusion}, 0).seconds;
}

Measurer::Measurer(const Subject& subject, int round_count)
    : state_(new State{subject, round_count, method::Occluders(subject.scene.mesh), {}, {}, {}, {}, {}, {}, nullptr}) {
  state_->yardstick = state_->open({.name = "", .method = "bvh"}, state_->occluders);
}

Measurer::~Measurer() = default;

// Opened, or made of what Embree has, and asked in rounds.
Timed Measurer::State::run(const Contestant& contestant, Frame& frame) {
  Timed timed;
  std::unique_ptr<method::Method> opened;
  std::optional<method::Occluders> simplified;
  Answer answer;
  if (contestant.is_embree_mode()) {
    answer = answer_by_embree(contestant);
    timed.mode = (contestant.embree ? *contestant.embree : best_embree()).name();
  } else {
    if (contestant.levels) simplified.emplace(subject.scene.mesh, chain_of(*contestant.levels), subject.radius);
    opened = open(contestant, simplified ? *simplified : occluders);
    answer = answer_by(*opened, word_count_of(contestant.ray_count));
    timed.device = opened->device();
  }
  std::vector<double> seconds, ratios;
  answer(frame);  // once for the caches
  const int rounds = frame.seconds > kLongSeconds ? 1 : round_count;
  for (int round = 0; round < rounds; ++round) {
    const double of_yardstick = seconds_of_yardstick();
    answer(frame);
    seconds.push_back(frame.seconds);
    ratios.push_back(frame.seconds / of_yardstick);
  }
  timed.seconds = method::median(seconds);
  timed.query_ratio = method::median(ratios);
  if (opened) timed.keys = opened->remarks().keys;
  return timed;
}

Timed Measurer::time(const Contestant& contestant) {
  Frame frame;
  return state_->run(contestant, frame);
}

Measured Measurer::measure(const Contestant& contestant, const Converged& constant, const Converged& linear) {
  Frame frame;
  Measured measured;
  static_cast<Timed&>(measured) = state_->run(contestant, frame);
  const scene::ReceiverImage& view = state_->subject.scene.view;
  measured.errors = errors_of(frame.occlusion, constant.mean, view.width, view.height);
  if (contestant.has_linear_falloff) {
    measured.own_falloff = errors_of(frame.occlusion, linear.mean, view.width, view.height);
  }
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
