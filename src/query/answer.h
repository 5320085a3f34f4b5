// From a mask to the answer for one receiver, and from answers to the outputs of a batch.
#pragma once

#include "lkao/ambient_occlusion.h"

namespace lkao::query {

// `blocked` within rays.cast. An invalid receiver (no ray cast) is answered with NaN.
ReceiverOcclusion make_answer(const Receiver& receiver, const ReceiverRays& rays, const OcclusionMask& blocked);

// Throws std::invalid_argument where a span of the outputs is neither empty nor as long as asked for.
void require_sizes(const QueryOutputs& outputs, std::size_t receiver_count, int word_count);

// Puts the answer for receiver k where the batch wants it.
void store(const QueryOutputs& outputs, std::size_t k, int word_count, const ReceiverOcclusion& answer);

// Adds one receiver to the counts of a batch.
void count(QueryReport& report, const ReceiverRays& rays, const ReceiverOcclusion& answer);

// Adds the counts of a part of a batch.
void add(QueryReport& report, const QueryReport& part);

}  // namespace lkao::query
