#pragma once
// The few calls of Embree that differ between versions 3 and 4. Only for .cpp files of this room.
#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace nacre::embree {

#if RTC_VERSION_MAJOR >= 4
inline void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray, nullptr); }
inline void occluded(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray, nullptr); }
#else
inline void intersect(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
}
inline void occluded(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
#endif

}  // namespace nacre::embree
