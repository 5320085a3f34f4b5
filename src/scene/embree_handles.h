// Embree's objects count their references: handles that give theirs back.
#pragma once

#include <memory>
#include <type_traits>

#include <embree3/rtcore.h>

namespace lkao::scene::embree {

template <typename Handle, void (*release)(Handle)>
struct Release {
  void operator()(Handle handle) const { release(handle); }
};
template <typename Handle, void (*release)(Handle)>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release<Handle, release>>;

using Device = Owned<RTCDevice, rtcReleaseDevice>;
using Geometry = Owned<RTCGeometry, rtcReleaseGeometry>;
using Scene = Owned<RTCScene, rtcReleaseScene>;

}  // namespace lkao::scene::embree
