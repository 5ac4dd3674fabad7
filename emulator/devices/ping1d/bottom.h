// From the echo of a Ping1D to its profile and to the bottom. Pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/ping1d/settings.h"
#include "render/echogram.h"

namespace echoloop::ping1d {

struct Bottom {
    std::uint32_t distance = 0;  ///< mm, by the speed of sound that the host has set; 0: nothing heard at all
    std::uint8_t confidence = 0;  ///< %
};

/// The leading edge of the strongest echo after time-varied gain: its first point within 10 dB of the
/// strongest one, at most 15 % of the range nearer. Not closer than the nearest range. Its confidence grows
/// from 0 where the strongest point stands 10 dB above the noise, as the loudest of 200 noise samples may, to
/// 100 % at 25 dB.
Bottom find_bottom(const Echogram& echogram, const State& state, const Settings& settings);

/// 0..255, one per bin.
std::vector<std::uint8_t> profile_points(const Echogram& echogram, const State& state,
                                         const Settings& settings);

/// Range and gain of the next ping in automatic mode: the bottom at two thirds of the range, or further and
/// further out where there is none; one gain step at a time.
void follow(State& state, const Bottom& bottom, const std::vector<std::uint8_t>& points);

}  // namespace echoloop::ping1d
