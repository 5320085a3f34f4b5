// The ways in which a program can hand a receiver's rays to Embree, for comparison of speed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lkao/ambient_occlusion.h"
#include "scene/embree.h"

namespace lkao::bench {

enum class Packing {
  pattern,    // a packet holds rays of one receiver, in the order of the pattern
  receivers,  // a packet holds the same ray of neighbouring receivers: nearly parallel
};

struct EmbreeMode {
  int width;  // 1, 4, 8 or 16 rays a call; 16 with Packing::receivers
  scene::embree::Order order;
  Packing packing = Packing::pattern;

  // Such as "embree16_coherent", "embree16_parallel_incoherent".
  std::string name() const;
};

// All widths and packings, coherent and incoherent.
std::vector<EmbreeMode> all_embree_modes();

// Rays of many receivers: `make(k, rays)` makes those of receiver k.
struct RaySource {
  std::size_t receiver_count;
  int ray_count;
  std::function<void(std::size_t, ReceiverRays&)> make;
};

// As below, for any rays.
void cast(const EmbreeMode& mode, RTCScene scene, const RaySource& source, std::span<std::uint64_t> mask_words);

// Makes the rays of receiver k (index k) and casts them, in parallel in the caller's TBB arena. Rays without length are
// left out, since segments are open at the receiver. Excluded primitives and sidedness are not looked at. `mask_words`
// as in QueryOutputs; overwritten.
void cast(const EmbreeMode& mode, RTCScene scene, const AmbientOcclusion& ao, std::span<const Receiver> receivers,
          std::span<std::uint64_t> mask_words);

}  // namespace lkao::bench
