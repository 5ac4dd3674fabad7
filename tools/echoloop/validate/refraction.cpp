// V14: rays in water whose sound speed changes evenly with depth.
#include "render/refraction.h"

#include "tools/echoloop/validate/groups.h"

namespace echoloop::validation {

void check_refraction(Findings& find) {
    const std::vector<SoundSpeedPoint> profile{{0, 1500}, {200, 1400}};  // q = -0.5 /s
    RayPoint ray{0, 0, 0};
    while (ray.distance < 60) ray = ray_after(profile, ray, 1e-5);
    find.source("a ray is an arc of radius c / (|q| cos t): c 1500 m/s, q -0.5 /s");
    find.within("drop of a level ray at 60 m", "m", 0.600, 0.002, ray.depth);
    const double radius = (ray.distance * ray.distance + ray.depth * ray.depth) / (2 * ray.depth);
    find.within("its radius", "m", 3000, 5, radius);
    const StraightRayError bound = straight_ray_error(profile, 1500, 0, 60, 0, 0);
    find.within("error that is printed for straight rays to 60 m", "m", 0.600, 0.005, bound.displacement);
}

}  // namespace echoloop::validation
