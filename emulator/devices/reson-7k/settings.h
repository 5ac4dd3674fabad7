// The options and the profile of a 7k sonar as typed values, and what commands change. Data only.
#pragma once

#include <cstdint>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/multibeam/figures.h"
#include "render/geographic.h"

namespace echoloop::reson7k_device {

/// What a host has set; the comment names the command.
struct Controls {
    double range = 50;                                                  ///< 1003, m
    double max_rate = 50;                                               ///< 1004, Hz; 0: no pings
    double power = 210;                                                 ///< 1005, dB re 1 uPa at 1 m
    double pulse = 60e-6;                                               ///< 1006, s
    double gain = 30;                                                   ///< 1008, dB
    double frequency = 400e3;                                           ///< 1026, Hz
    double sound_speed = 1500;                                          ///< 7610, m/s; before: the true one
    double absorption = 0;                                              ///< record 7611, dB/km
    double spreading = 0;                                               ///< record 7612, dB per decade
    bool range_filter = false;                                          ///< 1009, bit 8
    bool depth_filter = false;                                          ///< 1009, bit 9
    double min_range = 0, max_range = 0, min_depth = 0, max_depth = 0;  ///< 1010, m
    double gate_tilt = 0;                                               ///< 1010, rad, positive to starboard
    std::uint32_t water_column = 0;                                     ///< 7042, flags of that record
    bool pinging = true;                                                ///< 1100, 1101
};

inline constexpr double least_rate = 0.1;  ///< Hz that 1004 takes, beside 0

/// Figures of the profile; angles in rad.
struct Acoustics {
    double frequency = 0;  ///< Hz, at power-up; beam widths and directivity are given at it
    double least_frequency = 0, most_frequency = 0;  ///< Hz
    double sample_rate = 0;                          ///< Hz
    double receive_beam_width = 0, transmit_beam_width = 0, transmit_sector = 0;
    double receive_fan = 0;                  ///< of a receive beam along the track
    double least_range = 0, most_range = 0;  ///< m
    double least_power = 0, most_power = 0;  ///< dB re 1 uPa at 1 m
    double least_pulse = 0, most_pulse = 0;  ///< s
    double most_gain = 0;                    ///< dB
    double most_rate = 0;                    ///< Hz
    double ping_pause = 0;                   ///< s beyond the range time
    double spreading = 0;                    ///< dB per decade of range, at power-up
    double absorption = 0;                   ///< dB/km, at power-up
    double amplitude_reference = 0;          ///< dB re 1 uPa after gain: reads full scale
    multibeam::Rule detection;
    AxisPattern horizontal, vertical;
    Receiver receiver;
    ArrayErrors errors;
};

struct Settings {
    std::uint32_t device = 7125;
    std::uint64_t serial = 2812017;
    std::size_t beams = 256;
    double swath = deg_to_rad(140);  ///< rad, from the first to the last beam
    Controls start;
    Acoustics acoustics;
    bool any_device = false;           ///< commands are taken whatever device they name
    bool ends_by_third_party = false;  ///< 1053 without an address ends subscriptions, not 1052
    double datagram_gap = 0.3e-3;      ///< s between the datagrams of one ping
    double processing_time = 5e-3;     ///< s from the last echo to the records
    bool tvg = true;                   ///< the effect of that name
    bool pulse = true;                 ///< the effect of that name: echoes are as long as the pulse
    double unix_start = 0;             ///< s
    GeoPlace origin;                   ///< of the scene
    Sensors sensors;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::reson7k_device
