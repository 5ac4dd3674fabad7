// The options and the profile of a Surveyor 240-16 as typed values. Data only.
#pragma once

#include <vector>

#include "emulator/devices/family/cerulean/common.h"
#include "emulator/devices/family/multibeam/figures.h"

namespace echoloop::surveyor240 {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double source_level = 0;      ///< dB re 1 uPa at 1 m
    double swath = 0;             ///< from the first to the last direction
    std::size_t directions = 0;   ///< that are looked into
    double angle_resolution = 0;  ///< width of one direction
    double fan_height = 0;        ///< along the track
    AxisPattern horizontal, vertical;
    Receiver receiver;  ///< its saturation level at gain index 0
    ArrayErrors errors;
    double gain_range = 0;  ///< dB from gain index 0 to 100
    multibeam::Rule detection;
    double longest_range = 0;  ///< m
};

/// Emulator options; README.md of this folder explains each.
struct Settings {
    cerulean_device::Identity identity{.listed_type = 103, .discovery_name = "SONAR SURVEYOR"};
    bool bow_up_is_positive = true;  ///< x of the up vector
    std::size_t points = 15;         ///< at most, in one ping
    double attitude_period = 0.1;    ///< s; 0: on request only
    double utc_request_period = 10;  ///< s; 0: never
    double datagram_gap = 0.01;      ///< s
    double temperature = -1000;      ///< degC; -1000: no sensor
    bool pressure_sensor = false;
    double processing_time = 5e-3;  ///< s from the last range step to the points
    bool pulse = true;              ///< the effect of that name: echoes are as long as the pulse
    std::uint32_t serial = 1001;
    Sensors sensors;
    Acoustics acoustics;
};

/// From complete options and a complete profile. std::invalid_argument if a version is none.
Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

}  // namespace echoloop::surveyor240
