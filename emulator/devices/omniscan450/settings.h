// The options and the profile of an Omniscan 450 as typed values, what a host can set, and the ping that
// follows. Data only.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "emulator/devices/family/cerulean/common.h"
#include "protocols/cerulean/omniscan_messages.h"

namespace echoloop::omniscan450 {

using cerulean::omniscan::OsPingParams;

inline constexpr std::size_t gain_steps = 8;

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0;     ///< Hz
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    double beam_width = 0, fan_height = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;                       ///< clips where `full_scales` says
    std::array<double, gain_steps> gains{};  ///< factors by index
    std::vector<double> full_scales;         ///< dB re 1 uPa, by index
};

/// Emulator options; README.md of this folder explains each.
struct Settings {
    cerulean_device::Identity identity{.listed_type = 101, .discovery_name = "SONAR OMNISCAN450"};
    bool takes_1002 = true, takes_116 = true;
    bool accept_anything = false;
    std::uint8_t channel = 0;
    double mount_bearing = 0;       ///< deg clockwise, of the transducer against the vehicle
    double processing_time = 2e-3;  ///< s between the end of a ping and its profile
    Sensors sensors;
    Acoustics acoustics;
};

/// From complete options and a complete profile. std::invalid_argument if a version is none.
Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

/// What a host can change.
struct State {
    OsPingParams params;
    std::uint32_t speed_of_sound = 1500000;  ///< mm/s
    std::size_t gain = 4;                    ///< the index in use
};

/// Typical parameters of the maker's manual, not pinging.
OsPingParams typical_params();
/// Why these parameters are refused; nothing if they are good. What stops the pings is always good.
std::optional<std::string_view> out_of_range(const OsPingParams& params);

/// What can be pinged of parameters that are out of range.
OsPingParams limited(OsPingParams params);

/// s from the transmission to the end of the range.
double window(const State& state);
/// s from the transmission to the profile, which is the time that percentages of a ping's time mean.
double ping_time(const State& state, const Settings& settings);
double pulse_length(const State& state, const Settings& settings);  ///< s
/// Bins over which the receiver's filter averages.
std::size_t filter_bins(const State& state, const Settings& settings);
Shot shot_from(const State& state, const Settings& settings);

}  // namespace echoloop::omniscan450
