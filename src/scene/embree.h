// Embree 4 or 3, whichever is linked, seen as one: handles that give back their references, and the casting of rays,
// whose functions differ between the two. Rays that `find_blocked` finds blocked get tfar < 0. Of packets, only lanes
// are looked at whose `valid` is -1.
#pragma once

#include <memory>
#include <type_traits>

#if LKAO_EMBREE_VERSION_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

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

// What Embree may expect of rays that are cast one after the other.
enum class Order { incoherent, coherent };

// What rays are cast with. A filter is called for each hit of scenes that have kFilterFlag; the context that it is
// handed is the first member of this.
#if LKAO_EMBREE_VERSION_MAJOR >= 4

inline constexpr RTCSceneFlags kFilterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

struct RayQuery {
  explicit RayQuery(Order order = Order::incoherent, RTCFilterFunctionN hit_filter = nullptr) : filter(hit_filter) {
    rtcInitRayQueryContext(&context);
    if (order == Order::coherent) flags = RTC_RAY_QUERY_FLAG_COHERENT;
    if (filter != nullptr) flags = static_cast<RTCRayQueryFlags>(flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  }

  RTCRayQueryContext context;
  RTCRayQueryFlags flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  RTCFilterFunctionN filter;
};

// RTCOccludedArguments or RTCIntersectArguments; `init` is Embree's own for them.
template <typename Arguments>
Arguments arguments_of(RayQuery& query, void (*init)(Arguments*)) {
  Arguments arguments;
  init(&arguments);
  arguments.flags = query.flags;
  arguments.context = &query.context;
  arguments.filter = query.filter;
  return arguments;
}

inline void intersect(RTCScene scene, RayQuery& query, RTCRayHit& ray) {
  auto arguments = arguments_of(query, rtcInitIntersectArguments);
  rtcIntersect1(scene, &ray, &arguments);
}

inline void intersect(RTCScene scene, RayQuery& query, const int* valid, RTCRayHit16& rays) {
  auto arguments = arguments_of(query, rtcInitIntersectArguments);
  rtcIntersect16(valid, scene, &rays, &arguments);
}

inline void find_blocked(RTCScene scene, RayQuery& query, RTCRay& ray) {
  auto arguments = arguments_of(query, rtcInitOccludedArguments);
  rtcOccluded1(scene, &ray, &arguments);
}

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay4& rays) {
  auto arguments = arguments_of(query, rtcInitOccludedArguments);
  rtcOccluded4(valid, scene, &rays, &arguments);
}

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay8& rays) {
  auto arguments = arguments_of(query, rtcInitOccludedArguments);
  rtcOccluded8(valid, scene, &rays, &arguments);
}

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay16& rays) {
  auto arguments = arguments_of(query, rtcInitOccludedArguments);
  rtcOccluded16(valid, scene, &rays, &arguments);
}

#else

inline constexpr RTCSceneFlags kFilterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

struct RayQuery {
  explicit RayQuery(Order order = Order::incoherent, RTCFilterFunctionN hit_filter = nullptr) {
    rtcInitIntersectContext(&context);
    if (order == Order::coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.filter = hit_filter;
  }

  RTCIntersectContext context;
};

inline void intersect(RTCScene scene, RayQuery& query, RTCRayHit& ray) { rtcIntersect1(scene, &query.context, &ray); }

inline void intersect(RTCScene scene, RayQuery& query, const int* valid, RTCRayHit16& rays) {
  rtcIntersect16(valid, scene, &query.context, &rays);
}

inline void find_blocked(RTCScene scene, RayQuery& query, RTCRay& ray) { rtcOccluded1(scene, &query.context, &ray); }

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay4& rays) {
  rtcOccluded4(valid, scene, &query.context, &rays);
}

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay8& rays) {
  rtcOccluded8(valid, scene, &query.context, &rays);
}

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay16& rays) {
  rtcOccluded16(valid, scene, &query.context, &rays);
}

#endif

}  // namespace lkao::scene::embree
