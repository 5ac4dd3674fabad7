// The options and the profile of an S500 as typed values, what a host can set, and the ping that follows.
// Data only.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "emulator/devices/family/cerulean/common.h"
#include "protocols/cerulean/s500_messages.h"

namespace echoloop::s500 {

using cerulean::s500::SetPingParams;

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double frequency = 0, chirp_width = 0;  ///< Hz
    double source_level = 0;                ///< dB re 1 uPa at 1 m
    double beam_width = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;                ///< clips where `full_scales` says
    double lowest_gain = 0;           ///< factor at index 0
    double gain_step = 0;             ///< dB from index to index
    std::vector<double> gains;        ///< factors by index
    std::vector<double> full_scales;  ///< dB re 1 uPa, by index
    double nearest_range = 0;         ///< m, nothing closer is taken for the bottom
    double absorption = 0;            ///< dB/m one way, given back before echoes are compared
    double sample_rate = 0;           ///< Hz, of which a chirp's results are every so manieth
};

/// Emulator options; README.md of this folder explains each.
struct Settings {
    cerulean_device::Identity identity{.listed_type = 112, .discovery_name = "SONAR S500"};
    bool accept_anything = false;
    double processing_time = 2e-3;               ///< s between the end of a ping and its report
    std::uint32_t processor_temperature = 4000;  ///< 0.01 degC
    bool long_temperature = false;               ///< 4 bytes of it, as documented
    Sensors sensors;
    Acoustics acoustics;
};

/// From complete options and a complete profile. std::invalid_argument if a version is none.
Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

/// What a host can change.
struct State {
    SetPingParams params;                    ///< as asked for
    std::uint32_t length = 10000;            ///< mm, the one in use
    std::uint32_t speed_of_sound = 1500000;  ///< mm/s
    std::size_t gain = 6;                    ///< the index in use

    bool single() const { return params.msec_per_ping < 0; }
    std::uint16_t interval() const;  ///< ms
};

inline constexpr std::uint32_t shortest_automatic = 1000, longest_automatic = 150000;  ///< mm, range

inline constexpr int highest_gain = 13;  ///< index
/// Whether its start and length can be pinged.
bool is_range(const SetPingParams& params);
/// Why these parameters are refused; nothing if they are good. What stops the pings is always good.
std::optional<std::string_view> out_of_range(const SetPingParams& params);
/// What can be pinged of parameters that are out of range.
SetPingParams limited(SetPingParams params);

/// s from the transmission to the end of the range, and to the report.
double window(const State& state);
double ping_time(const State& state, const Settings& settings);
/// Results of a profile, and the decimation by which they follow from the sample rate; 0 for one tone.
struct Resolution {
    std::size_t results = 1024;
    std::uint8_t decimation = 0;
};
Resolution resolution(const State& state, const Settings& settings);
Shot shot_from(const State& state, const Settings& settings);

}  // namespace echoloop::s500
