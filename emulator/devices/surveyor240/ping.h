// The ping that follows from what a host has set on a Surveyor 240-16: range, steps, gain, times. Pure
// functions.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "emulator/devices/surveyor240/settings.h"
#include "protocols/cerulean/surveyor_messages.h"
#include "render/echogram.h"

namespace echoloop::surveyor240 {

using Parameters = cerulean::surveyor::PingParameters;

/// The published defaults: no pings, 5 m, 1500 m/s, automatic gain, 100 ms, 240 kHz, 400 steps of which a
/// pulse has 1.5.
Parameters default_parameters();

/// Why these parameters cannot be set, as the text of a nack; nothing if they can.
std::optional<std::string_view> refusal(const Parameters& wanted, const Settings& settings);

/// What the device finds for itself where the host leaves it to it.
struct Automatic {
    double end = 10;  ///< m
    int gain = 50;    ///< index
};

/// One ping as it goes out.
struct Plan {
    double sound_speed = 1500;    ///< m/s, the host's
    double start = 0, end = 0;    ///< m
    std::size_t steps = 0;        ///< range steps from start to end
    double pulse = 0;             ///< s
    double frequency = 0;         ///< Hz
    int gain = 0;                 ///< index 0 to 100
    bool follows_bottom = false;  ///< the end is the device's own
    bool automatic_gain = false;
    bool yz = false, atof = false;  ///< what is sent of it
    double period = 0;              ///< s, least time to the next ping

    /// s, from the transmission to the last range step.
    double listening() const { return 2 * end / sound_speed; }
    /// s, two-way time of a range step.
    double step_time() const { return 2 * (end - start) / sound_speed / static_cast<double>(steps); }
};
Plan make_plan(const Parameters& parameters, const Automatic& automatic, const Settings& settings);

/// dB by which the input is amplified at a gain index.
double gain_db(int index, const Acoustics& acoustics);

Shot make_shot(const Plan& plan, const Settings& settings, std::uint32_t ping);
/// A ping that sends nothing and hears next to nothing: how the head hangs in the water comes with its
/// echogram.
Shot silent_shot(const Settings& settings);

/// End of the range and gain of the next ping. `farthest`: slant range of the farthest point, m, 0 if there
/// is none; `loudest`: dB re 1 uPa, of any sample.
Automatic follow(const Plan& plan, Automatic before, double farthest, double loudest,
                 const Settings& settings);

}  // namespace echoloop::surveyor240
