// Embree 3 or 4, whichever is installed: they differ in what a question carries beside its ray.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace echoloop {

#if RTC_VERSION_MAJOR >= 4
inline constexpr const char* embree_package = "libembree4-4";
inline void first_hit(RTCScene scene, RTCRayHit& query) { rtcIntersect1(scene, &query); }
inline void any_hit(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }
#else
inline constexpr const char* embree_package = "libembree3-3";
inline void first_hit(RTCScene scene, RTCRayHit& query) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
}
inline void any_hit(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
#endif

}  // namespace echoloop
