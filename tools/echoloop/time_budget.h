// Where the time of one ping goes, asked of the device itself: it is powered up in a time of its own, asked
// as a driver would, and hears silence. Opens nothing and draws nothing.
#pragma once

#include <optional>
#include <string>

#include "emulator/scenario/scenario.h"

namespace echoloop::cli {

/// s each, of a device's default ping.
struct TimeBudget {
    double transmit = 0;  ///< the pulse
    double listen = 0;    ///< from its beginning to the end of the window, 2R/c
    /// One step of a scanning head: 0.9 deg, an Imagenex 0.3 deg. Nothing without a motor, or where that is
    /// not known here.
    std::optional<double> motor;
    /// What comes after listening: processing and the manners of the protocol. Nothing where a device
    /// waits for more of its driver than is known here.
    std::optional<double> work;
    std::optional<std::size_t> bytes;  ///< of what the device then says
    /// Those bytes on a serial line of `line_rate` bit/s, or the pauses between their datagrams.
    std::optional<double> wire;
    double line_rate = 0;  ///< 0: none
};

TimeBudget time_budget(const ScenarioDevice& device);

/// "pulse 0.1 ms, listening 66.667 ms, motor 6 ms, processing 2 ms, 1224 bytes in 106.25 ms at 115200 bit/s".
std::string text_of(const TimeBudget& budget);

}  // namespace echoloop::cli
