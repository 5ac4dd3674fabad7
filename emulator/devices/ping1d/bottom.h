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

/// The leading edge of the strongest echo after time-varied gain, in the middle of its bin; what is nearer
/// than the transducer's ring-down lasts does not count. Confidence grows from 0 where the strongest bin
/// stands 10 dB above the noise, as the loudest of 200 noise samples may, to 100 % at 25 dB. Without an echo
/// it is the loudest noise, which has no confidence, as with a real one.
Bottom find_bottom(const Echogram& echogram, const State& state, const Settings& settings);

/// 0..255, one per bin, with the transducer's ring-down.
std::vector<std::uint8_t> profile_points(const Echogram& echogram, const State& state,
                                         const Settings& settings);
/// Of the points behind the ring-down.
std::uint8_t loudest(const std::vector<std::uint8_t>& points, const State& state, const Settings& settings);

/// Range and gain of the next ping in automatic mode: the bottom at two thirds of the range, or further and
/// further out where there is none; one gain step at a time, so that `loudest` reads 120 to 240.
void follow(State& state, const Bottom& bottom, std::uint8_t loudest);

}  // namespace echoloop::ping1d
