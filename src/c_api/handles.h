// Handles of the C interface, by type.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "c_api/errors.h"
#include "c_api/handle_table.h"
#include "lkao/c.h"
#include "lkao/lkao.h"

namespace lkao::c_api {

// A neighbourhood, and the pattern whose words its masks have.
struct PatternedNeighbourhood {
  SamplePattern pattern;
  Neighbourhood neighbourhood;
};

// What is behind a handle.
template <typename Behinds, Kind kind>
struct BehindIs {
  using Object = Behinds;
  static constexpr Kind kKind = kind;
};
template <typename Handle>
struct Behind;
template <>
struct Behind<lkao_pattern> : BehindIs<SamplePattern, Kind::pattern> {};
template <>
struct Behind<lkao_table> : BehindIs<PlaneMaskTable, Kind::table> {};
template <>
struct Behind<lkao_bvh> : BehindIs<OccluderBvh, Kind::bvh> {};
template <>
struct Behind<lkao_scene> : BehindIs<OccluderScene, Kind::scene> {};
template <>
struct Behind<lkao_ao> : BehindIs<AmbientOcclusion, Kind::ao> {};
template <>
struct Behind<lkao_bundles> : BehindIs<RayBundles, Kind::bundles> {};
template <>
struct Behind<lkao_shadows> : BehindIs<SoftShadows, Kind::shadows> {};
template <>
struct Behind<lkao_sky> : BehindIs<SkyVisibility, Kind::sky> {};
template <>
struct Behind<lkao_neighbourhood> : BehindIs<PatternedNeighbourhood, Kind::neighbourhood> {};

// The object of a handle, which must be one.
template <typename Handle>
const typename Behind<Handle>::Object& object(const Handle* handle, const char* argument) {
  void* const found = find(Behind<Handle>::kKind, reinterpret_cast<std::uintptr_t>(handle), argument);
  return *static_cast<const typename Behind<Handle>::Object*>(found);
}
template <typename Handle>
typename Behind<Handle>::Object& object(Handle* handle, const char* argument) {
  void* const found = find(Behind<Handle>::kKind, reinterpret_cast<std::uintptr_t>(handle), argument);
  return *static_cast<typename Behind<Handle>::Object*>(found);
}

// Puts a handle of what `make` returns into `*result`, or NULL.
template <typename Handle, typename Make>
lkao_status create(const char* function, Handle** result, const char* argument, const Make& make) noexcept {
  return guard(function, [&] {
    *needed(result, argument) = nullptr;
    using Object = typename Behind<Handle>::Object;
    auto made = std::make_unique<Object>(make());
    const std::uintptr_t handle = enter(Behind<Handle>::kKind, made.get());
    static_cast<void>(made.release());
    *result = reinterpret_cast<Handle*>(handle);  // NOLINT(performance-no-int-to-ptr): nobody follows it
  });
}

template <typename Handle>
lkao_status destroy(const char* function, Handle* handle, const char* argument) noexcept {
  return guard(function, [&] {
    if (handle == nullptr) return;
    void* const taken = take(Behind<Handle>::kKind, reinterpret_cast<std::uintptr_t>(handle), argument);
    delete static_cast<typename Behind<Handle>::Object*>(taken);
  });
}

}  // namespace lkao::c_api
