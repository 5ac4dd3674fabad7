// Shots that only the acoustic chain sees, and the chain with just some effects.
#pragma once

#include <cmath>
#include <initializer_list>
#include <vector>

#include "render/acoustics/chain.h"

namespace echoloop::test {

inline constexpr double water_speed = 1500;

/// `beams` beams one width of 1 deg apart, bins of `bin` m, a CW pulse that is `pulse` m long (c tau / 2).
inline Shot chain_shot(std::size_t beams, std::size_t bins, double bin, double pulse) {
    Shot shot;
    shot.beam_width = deg_to_rad(1);
    for (std::size_t i = 0; i < beams; ++i)
        shot.bearings.push_back(deg_to_rad(static_cast<double>(i) - static_cast<double>(beams - 1) / 2));
    shot.fan_height = deg_to_rad(20);
    shot.bins = bins;
    shot.bin_interval = 2 * bin / water_speed;
    shot.frequency = 750e3;
    shot.pulse_length = 2 * pulse / water_speed;
    shot.source_level = 200;
    shot.random_key = 7;
    return shot;
}

inline Effects only(std::initializer_list<Effect> effects) {
    Effects out = Effects::none();
    for (const Effect effect : effects) out.set(effect);
    return out;
}

/// The chain's output for the same power in every bin.
inline std::vector<float> output(Effects effects, const Shot& shot, float power = 1, const Pose& pose = {},
                                 SpeckleOptions speckle = {}) {
    AcousticChain chain(effects, speckle);
    std::vector<float> values(shot.bearings.size() * shot.bins, power);
    chain.apply(shot, pose, water_speed, {}, values);
    return values;
}

inline std::vector<float> output(Effects effects, const Shot& shot, const std::vector<PointEcho>& points) {
    AcousticChain chain(effects);
    std::vector<float> values(shot.bearings.size() * shot.bins, 0.0F);
    chain.apply(shot, {}, water_speed, points, values);
    return values;
}

inline double sum_of(const std::vector<float>& values) {
    double sum = 0;
    for (const float v : values) sum += static_cast<double>(v);
    return sum;
}

inline double to_db(double power) { return 10 * std::log10(power); }

}  // namespace echoloop::test
