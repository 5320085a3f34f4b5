// One contestant on one subject: its picture, its time, its errors.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/report/contestants.h"
#include "bench/report/prepared_scene.h"
#include "bench/report/subject.h"

namespace lkao::bench {

struct Timed {
  double seconds = 0;      // a frame; the median of the rounds
  double query_ratio = 0;  // its time over that of the query with 128 rays, which took turns with it; median of rounds
  std::string device;      // none: the CPU
  std::string mode;        // of Embree
  nlohmann::ordered_json keys;  // what the method says of itself
};

struct Measured : Timed {
  std::vector<float> picture;
  std::vector<float> mismatches;             // rays of each pixel unlike Embree's; none where all are alike
  PictureErrors errors;                      // from rays of constant falloff
  std::optional<PictureErrors> own_falloff;  // from rays of its own
  std::optional<double> mismatch_rate;       // of its rays, from Embree's with the same directions
};

// What measuring takes, as frames of smaller views tell.
struct Estimate {
  double seconds = 0;
};

nlohmann::ordered_json to_json(const PictureErrors& errors);

// A contestant has no answer here; with one line that says why.
class CannotAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Measures contestants of one subject, of which it keeps what they share. Where one would take longer than `allowed`
// seconds, it is told so in place of an answer, after a try on views of an eighth and a quarter of the width; where
// `allowed` is infinite nothing is tried. Throws CannotAnswer.
class Measurer {
 public:
  Measurer(PreparedScene& scene, const Subject& subject, int round_count);
  ~Measurer();

  std::variant<Measured, Estimate> measure(const Contestant& contestant, References& references, double allowed);
  // The time alone.
  std::variant<Timed, Estimate> time(const Contestant& contestant, double allowed);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::bench
