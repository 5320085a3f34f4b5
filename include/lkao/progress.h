// Watching long calls, and stopping them.
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>

#include "lkao/export.h"
#include "lkao/requirements.h"

namespace lkao {

// Told now and then how much of a call's work is done, of how much. Returns false to stop the call: then, as soon as
// its threads have noticed, it throws Cancelled and leaves nothing half-made behind. Called from any of the call's
// threads, one call at a time; what it throws stops the call as well and comes out of it.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

class LKAO_API Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace lkao
