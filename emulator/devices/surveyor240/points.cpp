#include "emulator/devices/surveyor240/points.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/family/multibeam/bottom.h"

namespace echoloop::surveyor240 {
namespace {

/// Whether all of the echo lies in the window: where it may be cut, its middle is not that of the bottom.
bool is_whole(const multibeam::Detection& found, const Shot& shot) {
    const double end = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
    const double edge = shot.bin_interval / 2;
    return found.begin > shot.first_bin_time + edge && found.end < end - edge;
}

}  // namespace

std::vector<Point> find_points(const Echogram& echogram, const Settings& settings) {
    const Shot& shot = echogram.shot;
    const double end = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
    const std::vector<multibeam::TimeGate> gates(echogram.beams(), {shot.first_bin_time, end});
    const auto found = multibeam::detect(echogram, gates, settings.acoustics.detection.with(settings.pulse));
    std::vector<Point> points;
    std::size_t last_part = echogram.beams();  // none
    float strongest = 0;
    for (std::size_t n = 0; n < found.size(); ++n) {
        if (!found[n].found() || !is_whole(found[n], shot)) continue;
        const std::size_t part = n * settings.points / found.size();
        if (part == last_part && found[n].power <= strongest) continue;
        if (part == last_part) points.pop_back();
        points.push_back({-shot.bearings[n], found[n].time});
        last_part = part;
        strongest = found[n].power;
    }
    return points;
}

std::array<float, 3> up_vector(const Pose& world_from_sonar, const Settings& settings) {
    const Vec3 up = rotate(conjugate(world_from_sonar.orientation), {0, 0, 1});
    const double sign = settings.bow_up_is_positive ? 1 : -1;
    return {static_cast<float>(sign * up.z), static_cast<float>(up.y), static_cast<float>(-up.x)};
}

double water_pressure(const Pose& world_from_sonar) {
    constexpr double air = 1.01325, per_metre = 0.1005;  // bar; 1025 kg/m^3
    return air + per_metre * std::max(0.0, -world_from_sonar.position.z);
}

}  // namespace echoloop::surveyor240
