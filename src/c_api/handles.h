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
template <typename Handle>
struct Behind;
template <>
struct Behind<lkao_pattern> {
  using Object = SamplePattern;
  static constexpr Kind kKind = Kind::pattern;
};
template <>
struct Behind<lkao_table> {
  using Object = PlaneMaskTable;
  static constexpr Kind kKind = Kind::table;
};
template <>
struct Behind<lkao_bvh> {
  using Object = OccluderBvh;
  static constexpr Kind kKind = Kind::bvh;
};
template <>
struct Behind<lkao_scene> {
  using Object = OccluderScene;
  static constexpr Kind kKind = Kind::scene;
};
template <>
struct Behind<lkao_ao> {
  using Object = AmbientOcclusion;
  static constexpr Kind kKind = Kind::ao;
};
template <>
struct Behind<lkao_bundles> {
  using Object = RayBundles;
  static constexpr Kind kKind = Kind::bundles;
};
template <>
struct Behind<lkao_shadows> {
  using Object = SoftShadows;
  static constexpr Kind kKind = Kind::shadows;
};
template <>
struct Behind<lkao_sky> {
  using Object = SkyVisibility;
  static constexpr Kind kKind = Kind::sky;
};
template <>
struct Behind<lkao_neighbourhood> {
  using Object = PatternedNeighbourhood;
  static constexpr Kind kKind = Kind::neighbourhood;
};

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
