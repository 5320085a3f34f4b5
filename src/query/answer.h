// From a mask to the answer for one receiver, and from answers to the outputs of a batch.
#pragma once

#include "lkao/ambient_occlusion.h"

namespace lkao::query {

// `blocked` within rays.cast. An invalid receiver (no ray cast) is answered with NaN.
float occlusion_of(const ReceiverRays& rays, const OcclusionMask& blocked);
ReceiverOcclusion make_answer(const SamplePattern& pattern, const Receiver& receiver, const ReceiverRays& rays,
                              const OcclusionMask& blocked);

// Throws std::invalid_argument where a span of the outputs is neither empty nor as long as asked for.
void require_sizes(const QueryOutputs& outputs, std::size_t receiver_count, int word_count);

// Puts what the batch wants to know of receiver k in its place.
void store(const QueryOutputs& outputs, std::size_t k, const SamplePattern& pattern, const Receiver& receiver,
           const ReceiverRays& rays, const OcclusionMask& blocked);

// Adds one receiver to the counts of a batch.
void count(QueryReport& report, const ReceiverRays& rays, const OcclusionMask& blocked);

}  // namespace lkao::query
