// The options and the profile of an ARIS as typed values. Data only.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/contract/settings_list.h"

namespace echoloop::aris_device {

/// Figures of one frequency; angles in rad.
struct Carrier {
    double frequency = 0;          ///< Hz
    double beam_width = 0;         ///< of one beam, -3 dB
    double source_level = 0;       ///< dB re 1 uPa at 1 m, at 150 V
    double directivity_index = 0;  ///< dB
    double tvg_absorption = 0;     ///< dB/m, one way
    double pulse_limit = 0;        ///< us
};

struct Acoustics {
    Carrier low, high;
    AxisPattern horizontal, vertical;
    Receiver receiver;  ///< its directivity index is that of the carrier
    ArrayErrors errors;
    double fan_height = 0;        ///< rad, -3 dB
    double energy_limit = 0;      ///< us pulses/s
    double low_voltage_loss = 0;  ///< dB, without 150 V
    double floor_level = 0;       ///< dB re 1 uPa: reads 0 at 0 dB gain within a metre
    double tvg_spreading = 0;     ///< dB per decade of range
    double tvg_limit = 0;         ///< dB
};

/// One of the sonars of the series.
struct Variant {
    std::uint32_t system_type = 0;
    std::uint32_t first_mode = 0, second_mode = 0;  ///< ping modes; the same where there is one only
};

struct Settings {
    Variant variant;
    std::uint32_t serial = 1001;
    double temperature = 10;       ///< degC, of the water, at the sonar's own sensor
    double beacon_period = 1;      ///< s
    double silence_limit = 10;     ///< s; 0: none
    std::size_t datagram = 1472;   ///< B, the longest part
    double part_delay = 0.3e-3;    ///< s between parts, unless the controller says so
    std::uint32_t controller = 0;  ///< IPv4, instead of that of one that names no receiver; 0: its own
    bool reordered = false;        ///< samples range after range
    bool pulse_in_cycles = false;  ///< else us
    bool ethernet = true;
    bool voyager = false;
    double processing_time = 2e-3;  ///< s from the last sample to the first part
    bool tvg = true;                ///< the effect of that name
    double unix_start = 0;          ///< s
    Sensors sensors;
    Acoustics acoustics;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile; std::invalid_argument if the controller is no address.
Settings read_settings(const DeviceConfig& config, const Variant& variant);

/// Host byte order; std::invalid_argument if the text is no dotted IPv4 address.
std::uint32_t read_ipv4(const std::string& text);

}  // namespace echoloop::aris_device
