// Occlusion of many receivers, by any method, checked against another one where asked.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/progress.h"
#include "method/deviation.h"
#include "method/method.h"

namespace lkao::method {

struct BatchOptions {
  Method* check = nullptr;  // run this method too, and compare
  bool bent_normals = false;
  Progress progress = {};  // counts receivers
};

// How the answers differ from the check's.
struct BatchCheck {
  Deviation deviation;
  double seconds = 0;  // of the check
};

struct Batch {
  std::vector<float> occlusion;         // one a receiver
  std::vector<glm::vec3> bent_normals;  // one a receiver, or none
  std::uint64_t ray_count = 0;          // cast
  std::size_t invalid_receiver_count = 0;
  double seconds = 0;  // of the answers alone
  std::optional<BatchCheck> check;

  // Mean over the valid receivers; NaN where there is none.
  double occlusion_mean() const;
  // Of the valid receivers, those of occlusion 1; NaN where there is none.
  double fully_blocked_share() const;
};

// Asks for every receiver; receiver k has index k, and casts `ray_count` rays. The methods must be prepared. A method
// and its check take turns on small parts of the receivers, so that the masks of few receivers are in memory at a time;
// all at once where one of them draws. Throws Cancelled where `progress` stops it.
Batch run_batch(Method& method, int ray_count, std::span<const Receiver> receivers, const BatchOptions& options = {});

}  // namespace lkao::method
