// Echograms with known values, for the tests of drawing.
#pragma once

#include <functional>
#include <vector>

#include "render/echogram.h"

namespace echoloop::test {

/// Value in uPa^2 at a slant range (m) and a bearing (rad).
using Field = std::function<float(double range, double bearing)>;

inline Echogram ping(std::vector<double> bearings, double pan, double beam_width, double range,
                     std::size_t bins, const Field& field) {
    Echogram echogram;
    echogram.sound_speed = 1500;
    echogram.shot.pan = pan;
    echogram.shot.bearings = std::move(bearings);
    echogram.shot.beam_width = beam_width;
    echogram.shot.bins = bins;
    echogram.shot.bin_interval = range / 750 / static_cast<double>(bins);
    echogram.shot.frequency = 400e3;
    for (const double bearing : echogram.shot.bearings)
        for (std::size_t bin = 0; bin < bins; ++bin)
            echogram.values.push_back(field(echogram.bin_range(bin), pan + bearing));
    return echogram;
}

/// A fan of `beams` equally spaced beams over +-`half` degrees.
inline Echogram fan(double half, std::size_t beams, double range, const Field& field) {
    std::vector<double> bearings;
    for (std::size_t i = 0; i < beams; ++i)
        bearings.push_back(
            deg_to_rad(-half + 2 * half * static_cast<double>(i) / static_cast<double>(beams - 1)));
    return ping(bearings, 0, deg_to_rad(0.5), range, 500, field);
}

/// One-beam pings of a head that steps by `step` degrees from `first` to `last`, both included.
inline std::vector<Echogram> scan(double first, double last, double step, double range, const Field& field) {
    std::vector<Echogram> pings;
    const auto count = static_cast<int>(std::lround((last - first) / step)) + 1;
    for (int i = 0; i < count; ++i)
        pings.push_back(ping({0}, deg_to_rad(first + i * step), deg_to_rad(3), range, 200, field));
    return pings;
}

/// A spot at (range, bearing), `radius` m wide, on a ground of another level.
inline Field spot(double range, double bearing, double radius, float level, float ground) {
    const double x = range * std::sin(bearing), y = range * std::cos(bearing);
    return [=](double r, double b) {
        return std::hypot(r * std::sin(b) - x, r * std::cos(b) - y) < radius ? level : ground;
    };
}

}  // namespace echoloop::test
