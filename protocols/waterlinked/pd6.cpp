#include "protocols/waterlinked/pd6.h"

#include <cmath>
#include <cstdio>

namespace echoloop::waterlinked {
namespace {

char good_or_bad(bool good) { return good ? 'A' : 'V'; }

/// In hundredths, never -0.
double hundredths(double value) { return std::round(100 * value) / 100 + 0.0; }

}  // namespace

std::string pd6_attitude(double pitch, double roll, double heading, int width) {
    char text[96];
    std::snprintf(text, sizeof text, ":SA,%+*.2f,%+*.2f,%6.2f\r\n", width, hundredths(pitch), width,
                  hundredths(roll), heading);
    return text;
}

std::string pd6_time(std::string_view time, double salinity, double temperature, double depth,
                     double sound_speed, int built_in_test) {
    char text[128];
    std::snprintf(text, sizeof text, ",%4.1f,%+5.1f,%6.1f,%6.1f,%3d\r\n", salinity, temperature, depth,
                  sound_speed, built_in_test);
    return ":TS," + std::string(time) + text;
}

std::string pd6_track(char against, const Pd6Track& t) {
    const auto& i = t.instrument;
    char text[320];
    std::snprintf(text, sizeof text,
                  ":%cI,%+6d,%+6d,%+6d,%+6d,%c\r\n:%cS,%+6d,%+6d,%+6d,%c\r\n:%cE,%+6d,%+6d,%+6d,%c\r\n"
                  ":%cD,%+12.2f,%+12.2f,%+12.2f,%7.2f,%6.2f\r\n",
                  against, i[0], i[1], i[2], i[3], good_or_bad(t.instrument_good), against, t.ship[0],
                  t.ship[1], t.ship[2], good_or_bad(t.ship_good), against, t.earth[0], t.earth[1], t.earth[2],
                  good_or_bad(t.earth_good), against, hundredths(t.way[0]), hundredths(t.way[1]),
                  hundredths(t.way[2]), t.range, t.since);
    return text;
}

std::string pd13_ranges(double pressure, const std::array<double, 4>& ranges) {
    char text[128];
    std::snprintf(text, sizeof text, ":RA,%6.2f,%7.2f,%7.2f,%7.2f,%7.2f\r\n", pressure, ranges[0], ranges[1],
                  ranges[2], ranges[3]);
    return text;
}

}  // namespace echoloop::waterlinked
