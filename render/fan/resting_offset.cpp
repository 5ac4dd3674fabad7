#include "render/fan/resting_offset.h"

#include <cmath>

#include "render/acoustics/random.h"

namespace echoloop {
namespace {

double within_pixel(double v) { return v - std::floor(v + 0.5); }

/// 0..1
double fraction(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

}  // namespace

PixelOffset resting_offset(std::uint64_t key, Vec3 position, double pan) {
    const double way = position.x + position.y + position.z + rad_to_deg(pan);
    return {within_pixel(fraction(mix(key, 1)) + way * 0.7548776662466927),
            within_pixel(fraction(mix(key, 2)) + way * 0.5698402909980532)};
}

}  // namespace echoloop
