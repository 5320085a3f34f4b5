// From a mask to the answer for one receiver of a light, and from answers to the outputs of a batch.
#pragma once

#include "lkao/receiver_rays.h"
#include "lkao/soft_shadows.h"

namespace lkao::query {

// `blocked` within rays.cast, the rays above the horizon. An invalid receiver is answered with NaN.
LightVisibility make_shadow_answer(bool is_valid, const ReceiverRays& rays, const OcclusionMask& blocked);

// Throws std::invalid_argument where a span of the outputs is neither empty nor as long as asked for.
void require_sizes(const ShadowOutputs& outputs, std::size_t receiver_count, int word_count);

// Puts what the batch wants to know of receiver k in its place.
void store(const ShadowOutputs& outputs, std::size_t k, int word_count, const LightVisibility& answer);

// Adds one receiver to the counts of a batch.
void count(QueryReport& report, const ReceiverRays& rays, const LightVisibility& answer);

}  // namespace lkao::query
