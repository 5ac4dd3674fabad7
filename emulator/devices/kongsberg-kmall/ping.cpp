#include "emulator/devices/kongsberg-kmall/ping.h"

#include <algorithm>

namespace echoloop::kongsberg_kmall {
namespace {

constexpr double pause = 10e-3;  // s beyond the range's time, own choice
constexpr double most_bins = 4096;

std::vector<double> bearings(const Settings& s) {
    std::vector<double> all(s.soundings);
    const auto even = [&](double port, double starboard, std::size_t n) {
        return port + (starboard - port) * static_cast<double>(n) / static_cast<double>(all.size() - 1);
    };
    for (std::size_t n = 0; n < all.size(); ++n)
        all[n] = s.equidistant ? std::atan(even(-std::tan(s.port_edge), std::tan(s.starboard_edge), n))
                               : even(-s.port_edge, s.starboard_edge, n);
    return all;
}

}  // namespace

double edge_cosine(const Settings& s) { return std::cos(std::max(s.port_edge, s.starboard_edge)); }

double listening_range(const Settings& s) {
    constexpr double least = 2, most = 600;  // m, as the option `range`
    return s.max_depth ? std::clamp(*s.max_depth / edge_cosine(s), least, most) : s.range;
}

double range_time(const Settings& settings) { return 2 * listening_range(settings) / settings.sound_speed; }

double ping_period(const Settings& settings) {
    return std::max(range_time(settings) + pause, 1 / settings.ping_rate);
}

Shot make_shot(const Settings& s, std::uint64_t ping) {
    Shot shot;
    shot.ping = ping;
    shot.bearings = bearings(s);
    shot.beam_width = s.receive_beam_width;
    shot.fan_height = s.transmit_beam_width;
    shot.bin_interval = std::max(s.pulse / 4, range_time(s) / most_bins);
    shot.bins = static_cast<std::size_t>(std::ceil(range_time(s) / shot.bin_interval));
    shot.frequency = s.frequency;
    shot.pulse_length = s.pulse;
    shot.source_level = s.source_level + s.power;
    shot.horizontal = s.horizontal;
    shot.vertical = s.vertical;
    shot.receiver = s.receiver;
    shot.errors = s.errors;
    shot.receiver.bandwidth = 1 / s.pulse;
    shot.interval = ping_period(s);
    return shot;
}

Surface surface_of(const Pose& world_from_sonar) {
    Surface surface;
    Vec3 ahead = rotate(world_from_sonar.orientation, {0, 0, 1});
    surface.keel = rotate(world_from_sonar.orientation, {1, 0, 0});
    if (std::hypot(ahead.x, ahead.y) < 0.5) {  // a head that looks ahead, not down
        surface.keel = -1 * ahead;
        ahead = rotate(world_from_sonar.orientation, {1, 0, 0});
    }
    const double length = std::hypot(ahead.x, ahead.y);
    surface.ahead = {ahead.x / length, ahead.y / length, 0};
    surface.starboard = {surface.ahead.y, -surface.ahead.x, 0};
    surface.heading = std::atan2(ahead.x, ahead.y);  // east is x, north is y
    return surface;
}

Vec3 beam_direction(const Pose& world_from_sonar, const Surface& surface, double bearing) {
    const Vec3 in_sonar{std::cos(bearing), -std::sin(bearing), 0};
    return surface.from_world(rotate(world_from_sonar.orientation, in_sonar));
}

}  // namespace echoloop::kongsberg_kmall
