#include "emulator/devices/r2sonic/variant.h"

#include <algorithm>
#include <cmath>

#include "render/pose.h"

namespace echoloop::r2sonic_device {

const std::array<Variant, 4>& variants() {
    // Operation manual: band and UHR of all, 90 and 100 kHz and the longer pulse of the 2026, sectors of the
    // 2022, 2024 and 2026. The 2020 is in no manual at hand: its sector is an own estimate for its short
    // array.
    static const std::array<Variant, 4> all{{
        {"r2sonic-2020",
         "R2Sonic Sonic 2020 multibeam echosounder",
         "2020",
         {700e3},
         deg_to_rad(130),
         1115e-6},
        {"r2sonic-2022",
         "R2Sonic Sonic 2022 multibeam echosounder",
         "2022",
         {700e3},
         deg_to_rad(160),
         1115e-6},
        {"r2sonic-2024",
         "R2Sonic Sonic 2024 multibeam echosounder",
         "2024",
         {700e3},
         deg_to_rad(160),
         1115e-6},
        {"r2sonic-2026",
         "R2Sonic Sonic 2026 multibeam echosounder",
         "2026",
         {90e3, 100e3, 700e3},
         deg_to_rad(160),
         2000e-6,
         true},
    }};
    return all;
}

double nearest_frequency(const Variant& variant, double frequency) {
    double nearest = std::clamp(frequency, 200e3, 400e3);
    for (const double single : variant.singles)
        if (single > 0 && std::abs(single - frequency) < std::abs(nearest - frequency)) nearest = single;
    return nearest;
}

}  // namespace echoloop::r2sonic_device
