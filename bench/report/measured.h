// One contestant on one subject: its picture, its time, its errors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/report/contestants.h"
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

nlohmann::ordered_json to_json(const PictureErrors& errors);

// Measures contestants of one subject, of which it keeps what they share.
class Measurer {
 public:
  Measurer(const Subject& subject, int round_count);
  ~Measurer();

  // Against rays of constant and of linear falloff. Throws std::runtime_error or std::invalid_argument with one line
  // where the contestant cannot answer.
  Measured measure(const Contestant& contestant, const Converged& constant, const Converged& linear);
  // The time alone.
  Timed time(const Contestant& contestant);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lkao::bench
