#include "protocols/r2sonic/beams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace echoloop::r2sonic {

namespace {

constexpr double most_steps = std::numeric_limits<std::uint16_t>::max();
/// Of every A2: 20859 to 20861 in 923 real pings, which is this and the rounding of the running sum.
constexpr double largest_angle_step = most_steps / std::numbers::pi;

/// Nearest whole number of steps within 0..65535; 0 for what is no number.
std::uint16_t to_steps(double value) {
    if (!(value > 0)) return 0;
    return static_cast<std::uint16_t>(std::lround(std::min(value, most_steps)));
}

}  // namespace

std::vector<double> two_way_times(const R0& r0) {
    std::vector<double> times(r0.r.size());
    std::transform(r0.r.begin(), r0.r.end(), times.begin(),
                   [&](std::uint16_t r) { return double(r) * r0.scale; });
    return times;
}

std::vector<double> angles(const A0& a0, std::size_t points) {
    std::vector<double> out(points, a0.first);
    const double first = a0.first;
    const double step = points > 1 ? (double(a0.last) - first) / static_cast<double>(points - 1) : 0;
    for (std::size_t n = 0; n < points; ++n) out[n] = first + step * static_cast<double>(n);
    return out;
}

std::vector<double> angles(const A2& a2) {
    std::vector<double> out;
    out.reserve(a2.step.size());
    std::uint32_t sum = 0;
    for (const std::uint16_t step : a2.step) {
        sum += step;
        out.push_back(double(a2.first) + double(a2.scale) * sum);
    }
    return out;
}

std::vector<double> angles(const Bth0& packet) {
    if (const auto* a2 = std::get_if<A2>(&packet.angles)) return angles(*a2);
    return angles(std::get<A0>(packet.angles), packet.r0.r.size());
}

std::uint8_t quality_of(const Q0& q0, std::size_t point) {
    const std::size_t word = point / 8;
    if (word >= q0.flags.size()) return 0;
    return static_cast<std::uint8_t>((q0.flags[word] >> (28 - 4 * (point % 8))) & 0xF);
}

Q0 pack_quality(std::span<const std::uint8_t> nibbles) {
    Q0 q0;
    q0.flags.resize((nibbles.size() + 7) / 8);
    for (std::size_t point = 0; point < nibbles.size(); ++point) {
        q0.flags[point / 8] |= (nibbles[point] & 0xFU) << (28 - 4 * (point % 8));
    }
    return q0;
}

R0 pack_times(std::span<const double> seconds, float scale) {
    R0 r0{.scale = scale, .r = std::vector<std::uint16_t>(seconds.size())};
    std::transform(seconds.begin(), seconds.end(), r0.r.begin(),
                   [&](double s) { return to_steps(s / scale); });
    return r0;
}

A2 pack_angles(std::span<const double> radians) {
    A2 a2;
    a2.step.resize(radians.size());
    if (radians.empty()) return a2;
    a2.first = static_cast<float>(radians[0]);
    double gap = 0;
    for (std::size_t n = 1; n < radians.size(); ++n) gap = std::max(gap, radians[n] - radians[n - 1]);
    if (gap <= 0) return a2;
    a2.scale = static_cast<float>(gap / largest_angle_step);
    double sum = 0;
    for (std::size_t n = 1; n < radians.size(); ++n) {
        a2.step[n] = to_steps((radians[n] - a2.first) / a2.scale - sum);
        sum += a2.step[n];
    }
    return a2;
}

}  // namespace echoloop::r2sonic
