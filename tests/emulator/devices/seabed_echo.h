// Echoes of made-up bottoms for tests of bottom detection: beams, pulse, speckle and noise from textbook
// formulas, apart from the renderer.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "render/echogram.h"

namespace echoloop::test {

/// A bottom seen from above: slant range in m at an angle in rad from straight down, starboard positive.
using Bottom = std::function<double(double)>;

inline Bottom flat(double depth) {
    return [depth](double angle) { return depth / std::cos(angle); };
}
/// A plane at `depth` straight below that is shallower to starboard by `slope` rad.
inline Bottom sloping(double depth, double slope) {
    return [=](double angle) { return depth * std::cos(slope) / std::cos(angle - slope); };
}
/// Flat, `depth` to port of `across` m and shallower by `height` to starboard, with a wall between.
inline Bottom step(double depth, double height, double across) {
    return [=](double angle) {
        const double low = depth / std::cos(angle), high = (depth - height) / std::cos(angle);
        if (high * std::sin(angle) >= across) return high;
        return low * std::sin(angle) <= across ? low : across / std::sin(angle);
    };
}

struct Sea {
    double noise = 1;   ///< uPa^2
    double echo = 1e6;  ///< uPa^2, of a beam that its footprint fills
    bool speckle = true;
    unsigned seed = 1;
};

/// A fan of 256 beams over +-60 deg, 0.5 deg wide, 65280 Hz, pulses of 35 us, 1500 m/s, `range` m.
inline Shot wide_fan(double range) {
    Shot shot;
    for (int n = 0; n < 256; ++n) shot.bearings.push_back(deg_to_rad(-60 + 120.0 * n / 255));
    shot.beam_width = deg_to_rad(0.5);
    shot.fan_height = deg_to_rad(1);
    shot.bin_interval = 1 / 65280.0;
    shot.bins = static_cast<std::size_t>(2 * range / 1500 / shot.bin_interval);
    shot.pulse_length = 35e-6;
    shot.receiver.bandwidth = 30e3;
    return shot;
}

inline Echogram empty_sea(const Shot& shot, const Sea& sea) {
    Echogram e;
    e.shot = shot;
    e.sound_speed = 1500;
    e.noise_power = sea.noise;
    std::mt19937 random(sea.seed);
    std::exponential_distribution<float> noise(static_cast<float>(1 / sea.noise));
    e.values.resize(shot.bearings.size() * shot.bins);
    for (float& value : e.values) value = noise(random);
    return e;
}

/// Power of one facet, for `length` s from two-way time `time` on, added to the bins of a beam.
inline void add_pulse(Echogram& e, std::size_t beam, double time, double length, double power) {
    const double from = time / e.shot.bin_interval, to = (time + length) / e.shot.bin_interval;
    for (auto bin = static_cast<std::size_t>(from); bin < e.shot.bins && static_cast<double>(bin) < to;
         ++bin) {
        const double at = static_cast<double>(bin);
        const double part = std::min(to, at + 1) - std::max(from, at);
        e.values[beam * e.shot.bins + bin] += static_cast<float>(power * part);
    }
}

/// Adds the echo of a bottom: facets of a 40th of a beam width, each with its own speckle, through Gaussian
/// beams.
inline void add_bottom(Echogram& e, const Bottom& bottom, const Sea& sea) {
    const Shot& shot = e.shot;
    const double facet = shot.beam_width / 40;
    std::mt19937 random(sea.seed + 1000);
    std::exponential_distribution<double> speckle(1);
    const double length =
        shot.pulse_length + 0.5 / shot.receiver.bandwidth;  // as long as pulse and band make it
    for (double angle = shot.bearings.front() - 0.03; angle < shot.bearings.back() + 0.03; angle += facet) {
        const double power = sea.echo / 40 * (sea.speckle ? speckle(random) : 1);
        const double time = 2 * bottom(angle) / 1500;
        for (std::size_t n = 0; n < shot.bearings.size(); ++n) {
            const double off = (angle - shot.bearings[n]) / shot.beam_width;
            if (std::abs(off) < 2)
                add_pulse(e, n, time, length, power * std::exp(-4 * std::log(2.0) * off * off));
        }
    }
}

inline Echogram bottom_echo(const Shot& shot, const Bottom& bottom, const Sea& sea) {
    Echogram e = empty_sea(shot, sea);
    add_bottom(e, bottom, sea);
    return e;
}

}  // namespace echoloop::test
