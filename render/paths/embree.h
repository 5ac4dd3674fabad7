// Embree 3 or 4, whichever is installed: they differ in what a question carries beside its ray. Its objects
// as owners.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "render/memory_check.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace echoloop {

#if RTC_VERSION_MAJOR >= 4
inline void first_hit(RTCScene scene, RTCRayHit& query) { rtcIntersect1(scene, &query); }
inline void any_hit(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }
/// Of neighbouring rays; `asked`: -1 for each that counts, else 0.
inline void first_hits(const int* asked, RTCScene scene, RTCRayHit16& query) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(asked, scene, &query, &arguments);
}
#else
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
/// Of neighbouring rays; `asked`: -1 for each that counts, else 0.
inline void first_hits(const int* asked, RTCScene scene, RTCRayHit16& query) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(asked, scene, &context, &query);
}
#endif

namespace embree {

template <typename T, void (*release)(T)>
struct Releaser {
    using pointer = T;
    void operator()(T handle) const { release(handle); }
};
template <typename T, void (*release)(T)>
using Handle = std::unique_ptr<T, Releaser<T, release>>;

using Device = Handle<RTCDevice, rtcReleaseDevice>;
using Geometry = Handle<RTCGeometry, rtcReleaseGeometry>;
using Tree = Handle<RTCScene, rtcReleaseScene>;

[[noreturn]] inline void fail(RTCError error, const char* what) {
    if (error == RTC_ERROR_OUT_OF_MEMORY)
        throw OutOfMemory(
            "not enough memory for the trees of rays; end other programs, or raise this process' limit "
            "(ulimit -v)");
    throw std::runtime_error(std::string("rays: Embree ") + what + ", error " + std::to_string(error));
}

/// One thread: trees made by several can differ, and with them which of two equal hits is taken. Throws
/// OutOfMemory or std::runtime_error.
inline Device new_device() {
    Device device(rtcNewDevice("threads=1"));
    if (!device) fail(rtcGetDeviceError(nullptr), "cannot start on this processor");
    return device;
}

/// Throws as new_device().
inline void check_tree_of(const Device& device) {
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
        fail(error, "cannot build its tree");
}

}  // namespace embree

}  // namespace echoloop
