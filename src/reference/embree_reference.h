// The oracle and the rival: the same rays as the query's, cast one by one through Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "lkao/ambient_occlusion.h"
#include "lkao/soft_shadows.h"
#include "scene/mesh.h"

namespace lkao::reference {

class EmbreeScene;

// How rays are handed to Embree. The answers agree but for rays within rounding of an edge or of their own end.
enum class Casting {
  packets,      // rtcOccluded16, in the order of the pattern
  single_rays,  // rtcOccluded1
};

struct ReferenceOptions {
  // RTC_SCENE_FLAG_ROBUST: no leaks between triangles. The oracle is robust; the rival of a speed comparison is not.
  bool robust = true;
  Casting casting = Casting::packets;
};

// An Embree scene (high build quality) over the same triangles: those with zero area or a non-finite corner block
// nothing, and those with holes (Mesh::holes) where these are not. Triangles keep their numbers, so excluded primitives
// work. Embree decides in single precision, and leaves out triangles with coordinates beyond 1.8e18. Usable from any
// number of threads.
class EmbreeReference {
 public:
  // Builds in parallel; the mesh may go afterwards. Throws std::invalid_argument where an index is outside the
  // positions, naming triangle and index, and std::runtime_error where Embree fails (out of memory).
  explicit EmbreeReference(const scene::Mesh& mesh, const ReferenceOptions& options = {});
  ~EmbreeReference();
  EmbreeReference(const EmbreeReference&) = delete;
  EmbreeReference& operator=(const EmbreeReference&) = delete;

  // As AmbientOcclusion::query, with rays from AmbientOcclusion::rays and the triangles of this scene, not of
  // ao.occluders(). One-sidedness and excluded primitives go through a filter function in a second scene, built when
  // first needed: the plain case runs at Embree's full speed.
  ReceiverOcclusion query(const AmbientOcclusion& ao, const Receiver& receiver, std::uint64_t index) const;
  // The batch, in parallel with TBB. Throws std::invalid_argument where a span of the outputs has the wrong size.
  QueryReport query(const AmbientOcclusion& ao, std::span<const Receiver> receivers, const QueryOutputs& outputs,
                    std::uint64_t first_index = 0) const;

  // Of any rays of a common origin, those of rays.cast that are blocked.
  OcclusionMask blocked(const ReceiverRays& rays, std::uint32_t excluded_primitive, Sidedness sidedness) const;

  // As SoftShadows::query, with rays from SoftShadows::rays and the triangles of this scene.
  QueryReport query(const SoftShadows& shadows, std::span<const Receiver> receivers, const ShadowOutputs& outputs,
                    std::uint64_t first_index = 0) const;

 private:
  std::unique_ptr<const EmbreeScene> scene_;
  Casting casting_;
};

// Rays whose bits differ between two sets of masks. Throws std::invalid_argument where their sizes differ.
std::uint64_t count_mismatched_rays(std::span<const std::uint64_t> mask_words_a,
                                    std::span<const std::uint64_t> mask_words_b);

}  // namespace lkao::reference
