#include "emulator/devices/kongsberg-kmall/soundings.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace echoloop::kongsberg_kmall {
namespace {

using kmall::Sounding;
using multibeam::Detection;

// rejectionInfo2 and the confidence of real soundings of an EM 2040P and, by phase, of an EM 2042 (98 in one
// of 13 there); rejectionInfo1 is 0 in all 46,000.
constexpr std::uint8_t rejected = 40, by_amplitude = 88, by_phase = 99, confidence = 12;

/// Standard deviation in parts of the range, %. Real ones by amplitude are 0.117 to 0.34 (0.135 in the mean
/// at the nadir, 0.168 at 45 deg), by phase 0.04 to 0.46, new for each sounding; that they follow the speckle
/// of the echo is our own choice.
double quality(double angle, double contrast, bool phase) {
    const double part = angle / deg_to_rad(45), mean = 0.135 + 0.033 * part * part, usual_contrast = 3;
    const double q = mean * std::pow(std::max(contrast, 0.1) / usual_contrast, phase ? 0.8 : 0.4);
    return phase ? std::clamp(q, 0.04, 0.46) : std::clamp(q, 0.117, 0.34);
}

/// Exact in real datagrams: both come from the quality, and an EM 2042 adds the error of its position to the
/// horizontal one.
void add_uncertainties(Sounding& out, double contrast) {
    const double angle = std::abs(std::atan2(std::hypot(out.x, out.y), out.z));
    const double range = std::hypot(out.x, out.y, out.z);
    const double q = quality(angle, contrast, out.method == 2);
    out.quality = f(q);
    out.vertical_uncertainty = f(q / 100 * range * std::abs(std::cos(angle)));
    out.horizontal_uncertainty = f(std::hypot(q / 100 * range * std::sin(angle), position_error));
}

/// Depth of the bottom at sounding `n` by the valid ones, whose numbers these are: evenly between two, level
/// beyond the outermost.
double depth_between(std::span<const std::size_t> valid, std::size_t n, std::span<const Sounding> soundings) {
    const auto after = std::upper_bound(valid.begin(), valid.end(), n);
    if (after == valid.begin()) return soundings[valid.front()].z;
    if (after == valid.end()) return soundings[valid.back()].z;
    const std::size_t left = after[-1], right = after[0];
    const double part = static_cast<double>(n - left) / static_cast<double>(right - left);
    return std::lerp(static_cast<double>(soundings[left].z), static_cast<double>(soundings[right].z), part);
}

}  // namespace

Degrees degrees_of(double east, double north, const Settings& s) {
    const auto radii = geographic::radii_at(s.latitude);
    return {rad_to_deg(north / radii.meridian), rad_to_deg(east / radii.circle)};
}

Sounding beam(const Settings& s, std::size_t index, double bearing, Vec3 direction) {
    Sounding out;
    out.index = out.water_beam = static_cast<std::uint16_t>(index);
    out.type = 2;
    out.rejection2 = rejected;
    out.confidence = confidence;
    out.water_angle = f(rad_to_deg(std::atan2(-direction.y, direction.z)));
    out.absorption = f(1000 * s.absorption);
    out.source_level = f(s.source_level + s.power);
    out.angle = f(-rad_to_deg(bearing));
    return out;
}

void add_bottom(Sounding& out, const Detection& d, double sample_rate) {
    out.type = 0;
    const bool phase = d.method == multibeam::Method::phase;
    out.method = phase ? 2 : 1;
    out.rejection2 = phase ? by_phase : by_amplitude;
    out.range_factor = 100;
    const double least_samples = 6;  // real ones: 6 to 42
    out.window = out.echo_length =
        f(std::max(least_samples, std::round((d.end - d.begin) * sample_rate)) / sample_rate);
    out.water_range = static_cast<std::uint16_t>(std::min(d.time * sample_rate, 65535.0));
    out.time = f(d.time);
}

void add_place(Sounding& out, Vec3 place, const Surface& surface, const Settings& s, double contrast) {
    const Vec3 world = place.x * surface.ahead + place.y * surface.starboard;
    const Degrees moved = degrees_of(world.x, world.y, s);
    out.delta_latitude = f(moved.latitude);
    out.delta_longitude = f(moved.longitude);
    out.x = f(place.x);
    out.y = f(place.y);
    out.z = f(place.z);
    add_uncertainties(out, contrast);
}

void place_rejected(kmall::Mrz& m, std::span<const Vec3> directions, const Surface& surface,
                    const Settings& s) {
    constexpr double least_down = 0.1, contrast = 3;
    std::vector<std::size_t> valid;
    for (std::size_t n = 0; n < m.soundings.size(); ++n)
        if (is_valid(m.soundings[n])) valid.push_back(n);
    if (valid.empty()) return;
    for (std::size_t n = 0; n < m.soundings.size(); ++n) {
        Sounding& one = m.soundings[n];
        if (is_valid(one) || directions[n].z < least_down) continue;
        const double range = depth_between(valid, n, m.soundings) / directions[n].z;
        if (range <= 0) continue;  // the others see what lies above them
        one.range_factor = 100;
        one.time = f(2 * range / s.sound_speed);
        add_place(one, range * directions[n], surface, s, contrast);
    }
}

}  // namespace echoloop::kongsberg_kmall
