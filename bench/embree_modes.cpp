#include "bench/embree_modes.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "reference/cast_rays.h"

namespace lkao::bench {
namespace {

using scene::embree::Order;
using scene::embree::RayQuery;

void set_bit(std::uint64_t* words, int bit) { words[bit / 64] |= std::uint64_t{1} << (bit % 64); }

template <int kWidth>
using Rays = std::conditional_t<kWidth == 4, RTCRay4, std::conditional_t<kWidth == 8, RTCRay8, RTCRay16>>;

template <int kWidth>
class Packet {
 public:
  Packet() {
    for (int lane = 0; lane < kWidth; ++lane) {
      rays_.tnear[lane] = 0;
      rays_.time[lane] = 0;
      rays_.mask[lane] = ~0u;
      rays_.id[lane] = 0;
      rays_.flags[lane] = 0;
      place(lane, glm::vec3(0));
      aim(lane, glm::vec3(0));
    }
    clear();
  }

  // Origin of the lane's rays from now on.
  void place(int lane, const glm::vec3& origin) {
    rays_.org_x[lane] = origin.x;
    rays_.org_y[lane] = origin.y;
    rays_.org_z[lane] = origin.z;
  }

  // Puts a ray into the lane.
  void aim(int lane, const glm::vec3& segment) {
    valid_[lane] = -1;
    rays_.dir_x[lane] = segment.x;
    rays_.dir_y[lane] = segment.y;
    rays_.dir_z[lane] = segment.z;
    rays_.tfar[lane] = 1;
  }

  void cast(RTCScene scene, RayQuery& query) { find_blocked(scene, query, valid_, rays_); }
  bool blocked(int lane) const { return valid_[lane] != 0 && rays_.tfar[lane] < 0; }

  // Takes all rays out; origins stay.
  void clear() { std::fill(std::begin(valid_), std::end(valid_), 0); }

 private:
  Rays<kWidth> rays_;
  alignas(64) int valid_[kWidth];
};

// Casts the rays of one receiver; `words` is its mask.
void cast_singly(const ReceiverRays& rays, RTCScene scene, RayQuery& query, std::uint64_t* words) {
  const glm::vec3& origin = rays.origin;
  reference::for_each_cast_ray(rays, [&](int number) {
    const glm::vec3 segment = rays.ray(number);
    RTCRay ray{origin.x, origin.y, origin.z, 0, segment.x, segment.y, segment.z, 0, 1, ~0u, 0, 0};
    find_blocked(scene, query, ray);
    if (ray.tfar < 0) set_bit(words, number);
  });
}

// The same, `kWidth` rays a call.
template <int kWidth>
void cast_packets(const ReceiverRays& rays, RTCScene scene, RayQuery& query, std::uint64_t* words) {
  Packet<kWidth> packet;
  for (int lane = 0; lane < kWidth; ++lane) packet.place(lane, rays.origin);
  int numbers[kWidth];
  int size = 0;
  const auto cast_packet = [&] {
    packet.cast(scene, query);
    for (int lane = 0; lane < size; ++lane) {
      if (packet.blocked(lane)) set_bit(words, numbers[lane]);
    }
    packet.clear();
    size = 0;
  };
  reference::for_each_cast_ray(rays, [&](int ray) {
    packet.aim(size, rays.ray(ray));
    numbers[size++] = ray;
    if (size == kWidth) cast_packet();
  });
  if (size > 0) cast_packet();
}

void cast_receiver(int width, const ReceiverRays& rays, RTCScene scene, RayQuery& query, std::uint64_t* words) {
  switch (width) {
    case 1:
      return cast_singly(rays, scene, query, words);
    case 4:
      return cast_packets<4>(rays, scene, query, words);
    case 8:
      return cast_packets<8>(rays, scene, query, words);
    default:
      return cast_packets<16>(rays, scene, query, words);
  }
}

constexpr int kGroupSize = 16;

// What a thread takes at a time.
constexpr std::size_t kPartSize = 2 * kGroupSize;

// Ray by ray, for up to kGroupSize receivers at once. Their masks follow each other in `words`.
void cast_group(std::span<const ReceiverRays> group, int ray_count, RTCScene scene, RayQuery& query,
                std::uint64_t* words) {
  const int lane_count = static_cast<int>(group.size());
  const int word_count = word_count_of(ray_count);
  Packet<kGroupSize> packet;
  for (int lane = 0; lane < lane_count; ++lane) packet.place(lane, group[static_cast<std::size_t>(lane)].origin);
  for (int ray = 0; ray < ray_count; ++ray) {
    packet.clear();
    for (int lane = 0; lane < lane_count; ++lane) {
      const ReceiverRays& rays = group[static_cast<std::size_t>(lane)];
      if (rays.cast.test(ray) && rays.ray(ray) != glm::vec3(0)) packet.aim(lane, rays.ray(ray));
    }
    packet.cast(scene, query);
    for (int lane = 0; lane < lane_count; ++lane) {
      if (packet.blocked(lane)) set_bit(words + lane * word_count, ray);
    }
  }
}

// Receivers [first, last) of all. Their masks are in `words`, which is of all.
struct Part {
  const RaySource& source;
  std::size_t first, last;
  std::uint64_t* words;

  std::uint64_t* words_of(std::size_t k) const {
    return words + k * static_cast<std::size_t>(word_count_of(source.ray_count));
  }
};

void cast_groups(RTCScene scene, RayQuery& query, const Part& part) {
  thread_local std::vector<ReceiverRays> group(kGroupSize);  // 200 KiB, too much to clear for every part
  for (std::size_t first = part.first; first < part.last; first += kGroupSize) {
    const std::size_t size = std::min<std::size_t>(kGroupSize, part.last - first);
    for (std::size_t i = 0; i < size; ++i) part.source.make(first + i, group[i]);
    cast_group(std::span(group).first(size), part.source.ray_count, scene, query, part.words_of(first));
  }
}

void cast_part(const EmbreeMode& mode, RTCScene scene, const Part& part) {
  RayQuery query(mode.order);
  if (mode.packing == Packing::receivers) return cast_groups(scene, query, part);
  ReceiverRays rays;
  for (std::size_t k = part.first; k < part.last; ++k) {
    part.source.make(k, rays);
    cast_receiver(mode.width, rays, scene, query, part.words_of(k));
  }
}

}  // namespace

std::string EmbreeMode::name() const {
  return fmt::format("embree{}{}_{}", width, packing == Packing::receivers ? "_parallel" : "",
                     order == Order::coherent ? "coherent" : "incoherent");
}

std::vector<EmbreeMode> all_embree_modes() {
  std::vector<EmbreeMode> modes;
  for (const auto order : {Order::coherent, Order::incoherent}) {
    for (const int width : {1, 4, 8, 16}) modes.push_back({width, order});
    modes.push_back({kGroupSize, order, Packing::receivers});
  }
  return modes;
}

void cast(const EmbreeMode& mode, RTCScene scene, const RaySource& source, std::span<std::uint64_t> mask_words) {
  std::fill(mask_words.begin(), mask_words.end(), 0);
  const std::size_t part_count = (source.receiver_count + kPartSize - 1) / kPartSize;
  tbb::parallel_for(std::size_t{0}, part_count, [&](std::size_t i) {
    const std::size_t first = i * kPartSize, last = std::min(first + kPartSize, source.receiver_count);
    cast_part(mode, scene, {source, first, last, mask_words.data()});
  });
}

void cast(const EmbreeMode& mode, RTCScene scene, const AmbientOcclusion& ao, std::span<const Receiver> receivers,
          std::span<std::uint64_t> mask_words) {
  const auto make = [&](std::size_t k, ReceiverRays& rays) { ao.rays(receivers[k], k, rays); };
  cast(mode, scene, {receivers.size(), ao.pattern().ray_count(), make}, mask_words);
}

}  // namespace lkao::bench
