// How a profile writes down what a receiver hears beside the water: ring-down and interference. Pure
// functions.
#pragma once

#include <memory>
#include <string_view>

#include "render/acoustics/interference.h"
#include "render/acoustics/ring_down.h"

namespace echoloop {

/// As a reader is told when something else stands there.
inline constexpr std::string_view ring_down_notation =
    "write \"none\", or points as \"0.2: -60 +-4 ~2, 0.5: -80\": ms after the transmission began, level, "
    "standard deviation from ping to ping, standard deviation over bearing that lasts from ping to ping; "
    "before them \"pulse 0.05;\" (ms) where longer pulses ring later; after them \"; bearings 0.5 1.2 "
    "-1.7\", "
    "what ~ is multiplied by at bearings all round, the first astern, clockwise";
inline constexpr std::string_view interference_notation =
    "write \"none\", or any of \"lines 13 % by 5 +-2 dB; dashes 9 per s at 118 +-6 dB; beams 128-135 of 256 "
    "by 3.9 dB\": how many lines are lifted above the noise, how many dashes of 1 to 3 bins a second of "
    "listening brings and their level at the receiver re 1 uPa, which beams are always lifted";

/// Null where `text` is "none". std::invalid_argument says which part is wrong and how to write it.
std::shared_ptr<const RingDown> read_ring_down(std::string_view text);
std::shared_ptr<const Interference> read_interference(std::string_view text);

}  // namespace echoloop
