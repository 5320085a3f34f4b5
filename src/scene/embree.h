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

// `arguments` of RTCOccludedArguments or RTCIntersectArguments, just made.
template <typename Arguments>
void fill_arguments(Arguments& arguments, RayQuery& query) {
  arguments.flags = query.flags;
  arguments.context = &query.context;
  arguments.filter = query.filter;
}

inline RTCOccludedArguments occluded_arguments(RayQuery& query) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  fill_arguments(arguments, query);
  return arguments;
}

inline RTCIntersectArguments intersect_arguments(RayQuery& query) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  fill_arguments(arguments, query);
  return arguments;
}

inline void intersect(RTCScene scene, RayQuery& query, RTCRayHit& ray) {
  RTCIntersectArguments arguments = intersect_arguments(query);
  rtcIntersect1(scene, &ray, &arguments);
}

inline void intersect(RTCScene scene, RayQuery& query, const int* valid, RTCRayHit16& rays) {
  RTCIntersectArguments arguments = intersect_arguments(query);
  rtcIntersect16(valid, scene, &rays, &arguments);
}

inline void find_blocked(RTCScene scene, RayQuery& query, RTCRay& ray) {
  RTCOccludedArguments arguments = occluded_arguments(query);
  rtcOccluded1(scene, &ray, &arguments);
}

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay4& rays) {
  RTCOccludedArguments arguments = occluded_arguments(query);
  rtcOccluded4(valid, scene, &rays, &arguments);
}

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay8& rays) {
  RTCOccludedArguments arguments = occluded_arguments(query);
  rtcOccluded8(valid, scene, &rays, &arguments);
}

inline void find_blocked(RTCScene scene, RayQuery& query, const int* valid, RTCRay16& rays) {
  RTCOccludedArguments arguments = occluded_arguments(query);
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
