// The options and the profile of a Norbit WBMS as typed values. Data only.
#pragma once

#include <string>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/multibeam/figures.h"
#include "protocols/norbit/messages.h"

namespace echoloop::norbit_device {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double reference_frequency = 0;  ///< Hz, at which the widths hold
    double receive_beam_width = 0, transmit_beam_width = 0;
    double forward_fan_height = 0;  ///< rad, along track, of the forward-looking system
    double widest_swath = 0;
    double source_level = 0;  ///< dB re 1 uPa at 1 m, at amplitude 15
    AxisPattern horizontal, vertical;
    Receiver receiver;
    ArrayErrors errors;
    double full_scale = 0;    ///< dB re 1 uPa: reads full scale at 0 dB gain
    double largest_gain = 0;  ///< dB, digital
    multibeam::Rule detection;
};

/// Emulator options; README.md of this folder explains each.
struct Settings {
    bool forward_looking = false;  ///< the system; else a bathymetric one
    norbit::BeamMode beam_mode = norbit::BeamMode::ea256;
    norbit::Sample sample = norbit::Sample::s16;
    std::uint32_t version = 4;
    bool hertz_in_water_column = false;
    bool whole_vga_gains = false;  ///< g1 and g2 as s32
    bool newer_fields = false;
    bool power = false;          ///< pings from the start
    double command_pause = 0.1;  ///< s after which a command without a line's end is one
    double temperature = 25;     ///< degC
    std::string revision = "10.3.6", serial = "700218", part_number = "12004";
    double processing_time = 10e-3;  ///< s from the last echo to the packets
    double sound_speed = 1500;       ///< m/s, that the probe measures
    double unix_start = 0;           ///< s
    Sensors sensors;
    bool tvg = true;    ///< the effect of that name
    bool pulse = true;  ///< the effect of that name
    Acoustics acoustics;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile. std::invalid_argument if a text cannot be answered.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::norbit_device
