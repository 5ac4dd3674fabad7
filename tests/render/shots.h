// Shots and small measurements that the tests of the renderer share.
#pragma once

#include <algorithm>
#include <cmath>

#include "render/renderer.h"

namespace echoloop::test {

/// `beams` beams that share `aperture_deg` evenly, without gaps, over a window of 0..range m in `bins` bins.
inline Shot fan(double aperture_deg, double height_deg, std::size_t beams, std::size_t bins, double range,
                double c = 1500) {
    Shot shot;
    shot.beam_width = deg_to_rad(aperture_deg) / static_cast<double>(beams);
    for (std::size_t i = 0; i < beams; ++i)
        shot.bearings.push_back(deg_to_rad(-aperture_deg / 2) +
                                (static_cast<double>(i) + 0.5) * shot.beam_width);
    shot.fan_height = deg_to_rad(height_deg);
    shot.bins = bins;
    shot.bin_interval = 2 * range / c / static_cast<double>(bins);
    shot.frequency = 750e3;
    shot.pulse_length = 50e-6;
    shot.source_level = 200;
    return shot;
}

/// The two sonars of Cerqueira et al. 2016.
inline Shot forward_looking() {
    Shot shot = fan(120, 20, 256, 500, 50);
    shot.tilt = deg_to_rad(-20);
    return shot;
}
inline Shot scanning() { return fan(3, 35, 1, 500, 50); }

/// Mean echoes in beams that are boxes of their nominal widths: what closed forms speak of.
inline RendererOptions boxes() {
    RendererOptions options;
    options.effects = Effects::none().set(Effect::spreading).set(Effect::absorption);
    return options;
}

inline Water water_of(double c) {
    Water water;
    water.sound_speed = c;
    return water;
}

inline double db(double power) { return 10 * std::log10(power); }

inline double beam_power(const Echogram& e, std::size_t beam) {
    double sum = 0;
    for (const float v : e.beam(beam)) sum += v;
    return sum;
}

inline double total_power(const Echogram& e) {
    double sum = 0;
    for (const float v : e.values) sum += v;
    return sum;
}

inline std::size_t strongest_bin(std::span<const float> beam) {
    return static_cast<std::size_t>(std::max_element(beam.begin(), beam.end()) - beam.begin());
}

/// One-way absorption of the water in Np/m.
inline double nepers(const Water& water, double frequency) {
    return db_to_neper(absorption_db_per_km(water, frequency) / 1000);
}

}  // namespace echoloop::test
