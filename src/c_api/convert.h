// Structs of the C interface as those of the C++ one, and back. Each throws where a member is out of range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "c_api/arrays.h"
#include "lkao/c.h"
#include "lkao/lkao.h"

namespace lkao::c_api {

Falloff falloff_of(const lkao_falloff* falloff, const char* name);
RayOptions ray_options_of(const lkao_ray_options* options);
lkao_ray_options c_options_of(const RayOptions& options);
Receiver receiver_of(const lkao_receiver* receiver);
lkao_answer c_answer_of(const ReceiverOcclusion& answer);
Progress progress_of(lkao_progress progress, void* user);

// Copies a mask into `words`; throws where they are fewer than the pattern's.
void write_mask(const OcclusionMask& mask, const SamplePattern& pattern, std::uint64_t* words, std::size_t word_count);
void check_mask(const SamplePattern& pattern, const std::uint64_t* words, std::size_t word_count);

// The rest of a mask's `words` become 0.
void write_words(const OcclusionMask& mask, std::uint64_t* words, std::size_t word_count);

// Into those of the two that are wanted.
void write_rays(const ReceiverRays& from, lkao_rays* rays, const Strided<float, 3>& segments);

// Runs `body` in an arena of so many threads; 0: in the caller's.
void run_on_threads(std::int32_t thread_count, const char* name, const std::function<void()>& body);

}  // namespace lkao::c_api
