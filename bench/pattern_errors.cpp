#include "bench/pattern_errors.h"

#include <cmath>
#include <cstdint>
#include <span>

#include <tbb/parallel_for.h>
#include <glm/mat3x3.hpp>

#include "bench/pattern_hits.h"
#include "lut/pattern_points.h"
#include "query/receiver_rays.h"

namespace lkao::bench {
namespace {

// One case with one seed: its directions, and its lengths for every falloff.
struct Instance {
  const PatternCase* what;
  std::uint64_t seed;
  std::vector<SamplePattern> patterns;  // one a falloff

  Instance(const PatternCase& pattern_case, std::uint64_t pattern_seed, const std::vector<Falloff>& falloffs)
      : what(&pattern_case), seed(pattern_seed) {
    const SamplePattern pattern = SamplePattern::make(what->kind, what->ray_count, Falloff::constant(), pattern_seed);
    for (const Falloff& falloff : falloffs) patterns.push_back(pattern.with_falloff(falloff));
  }
};

std::vector<Instance> make_instances(const std::vector<PatternCase>& cases, const std::vector<Falloff>& falloffs,
                                     int seed_count) {
  std::vector<Instance> instances;
  for (const PatternCase& pattern_case : cases) {
    for (int seed = 0; seed < seed_count; ++seed) {
      instances.emplace_back(pattern_case, static_cast<std::uint64_t>(seed), falloffs);
    }
  }
  return instances;
}

std::vector<glm::vec3> reference_directions(int count) {
  std::vector<glm::vec3> directions;
  for (const glm::dvec2& p : lut::spiral_points(count, 1)) {
    directions.emplace_back(p.x, p.y, std::sqrt(1.0 - p.x * p.x - p.y * p.y));
  }
  return directions;
}

// Eq. 2: the mean of rho(distance).
double integral(const Falloff& falloff, std::span<const float> distances) {
  double sum = 0;
  for (float distance : distances) sum += distance <= 1 ? falloff(static_cast<double>(distance)) : 0.0;
  return sum / static_cast<double>(distances.size());
}

// Eq. 3: the share of rays that reach the first hit.
double share_blocked(const SamplePattern& pattern, std::span<const float> distances) {
  int blocked_count = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) blocked_count += pattern.lengths()[i] >= distances[i];
  return static_cast<double>(blocked_count) / pattern.ray_count();
}

// [receiver]: what is due, and what an instance answers, for one falloff.
struct Answers {
  std::vector<double> due;
  std::vector<std::vector<double>> given;  // [instance][receiver]
};

PatternError summarise(const PatternCase& what, const std::string& falloff, const std::vector<double>& due,
                       std::span<const std::vector<double>> given_by_seed) {
  double sum = 0, squares = 0, products = 0, variance = 0;
  for (const std::vector<double>& given : given_by_seed) {
    for (std::size_t k = 0; k < due.size(); ++k) {
      const double error = given[k] - due[k];
      sum += error;
      squares += error * error;
      variance += due[k] * (1 - due[k]) / what.ray_count;
      if (k % 2 == 1) products += 2 * error * (given[k - 1] - due[k - 1]);
    }
  }
  const double count = static_cast<double>(due.size() * given_by_seed.size());
  return {what,
          falloff,
          std::sqrt(squares / count),
          sum / count,
          squares > 0 ? products / squares : 0,
          std::sqrt(variance / count)};
}

}  // namespace

std::vector<Falloff> study_falloffs() {
  return {Falloff::constant(), Falloff::linear(), Falloff::smooth(), Falloff::exponential(),
          Falloff::custom("steps", [](double x) { return 1.0 - 0.25 * std::floor(4.0 * x); })};
}

std::vector<PatternError> measure_pattern_errors(const scene::Mesh& mesh, float radius,
                                                 const std::vector<Receiver>& receivers,
                                                 const std::vector<PatternCase>& cases,
                                                 const PatternStudyOptions& options) {
  const std::vector<Falloff> falloffs = study_falloffs();
  const std::vector<Instance> instances = make_instances(cases, falloffs, options.seed_count);
  const std::vector<glm::vec3> reference = reference_directions(options.reference_ray_count);
  const FirstHits hits(mesh, radius);

  std::vector<Answers> answers(falloffs.size());
  for (Answers& a : answers) {
    a.due.resize(receivers.size());
    a.given.assign(instances.size(), std::vector<double>(receivers.size()));
  }
  tbb::parallel_for(std::size_t{0}, receivers.size(), [&](std::size_t k) {
    const Receiver& receiver = receivers[k];
    std::vector<float> distances(reference.size());
    // The reference is turned too, so that its own small error is no bias.
    const glm::mat3 reference_frame = query::jittered_frame(receiver, {.rotation = 1, .tilt = 0}, 0.0f, 12345, k);
    hits.find(receiver, reference_frame, reference, distances);
    for (std::size_t f = 0; f < falloffs.size(); ++f) answers[f].due[k] = integral(falloffs[f], distances);
    for (std::size_t i = 0; i < instances.size(); ++i) {
      const SamplePattern& pattern = instances[i].patterns.front();
      distances.resize(pattern.directions().size());
      const glm::mat3 frame =
          query::jittered_frame(receiver, instances[i].what->jitter, pattern.lowest_elevation(), instances[i].seed, k);
      hits.find(receiver, frame, pattern.directions(), distances);
      for (std::size_t f = 0; f < falloffs.size(); ++f) {
        answers[f].given[i][k] = share_blocked(instances[i].patterns[f], distances);
      }
    }
  });

  std::vector<PatternError> errors;
  const std::size_t seed_count = static_cast<std::size_t>(options.seed_count);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    for (std::size_t f = 0; f < falloffs.size(); ++f) {
      const std::span<const std::vector<double>> given(answers[f].given);
      errors.push_back(
          summarise(cases[c], falloffs[f].name(), answers[f].due, given.subspan(c * seed_count, seed_count)));
    }
  }
  return errors;
}

}  // namespace lkao::bench
