// The oracle and the rival: the same rays as the query's, cast one by one through Embree.
#pragma once

#include <cstdint>
#include <span>

#include "lkao/ambient_occlusion.h"
#include "scene/mesh.h"

namespace lkao::reference {

struct ReferenceOptions {
  // RTC_SCENE_FLAG_ROBUST: no leaks between triangles. The oracle is robust; the rival of a speed comparison is not.
  bool robust = true;
};

// An Embree scene (high build quality) over the same triangles. Triangles keep their numbers, so excluded primitives
// work. Usable from any number of threads.
class EmbreeReference {
 public:
  explicit EmbreeReference(const scene::Mesh& mesh, const ReferenceOptions& options = {});
  ~EmbreeReference();
  EmbreeReference(const EmbreeReference&) = delete;
  EmbreeReference& operator=(const EmbreeReference&) = delete;

  // As AmbientOcclusion::query, with rays from AmbientOcclusion::rays cast through rtcOccluded16 with the incoherent
  // flag (rtcOccluded1 where single rays are asked for). One-sidedness and excluded primitives by a filter function.
  ReceiverOcclusion query(const AmbientOcclusion& ao, const Receiver& receiver, std::uint64_t index) const;
  // The batch, in parallel with TBB.
  QueryReport query(const AmbientOcclusion& ao, std::span<const Receiver> receivers, const QueryOutputs& outputs,
                    std::uint64_t first_index = 0) const;

 private:
  struct Impl;
  Impl* impl_;
};

// Rays whose bits differ between two sets of masks of equal size.
std::uint64_t count_mismatched_rays(std::span<const std::uint64_t> mask_words_a, std::span<const std::uint64_t> mask_words_b);

}  // namespace lkao::reference
