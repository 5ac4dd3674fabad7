// The options and the profile of a Ping360 as typed values, and the ping that a host's parameters make. Data
// only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/ping/serial_rate.h"
#include "protocols/ping/messages.h"

namespace echoloop::ping360 {

/// Figures of the profile, in radians where they are angles.
struct Acoustics {
    double centre_frequency = 0, response_width = 0;  ///< Hz, of the transducer
    double source_level = 0;                          ///< dB re 1 uPa at 1 m
    double beam_width = 0, fan_height = 0;
    AxisPattern horizontal, vertical;
    Receiver receiver;
    double reference_level = 0;  ///< dB re 1 uPa after TVG: reads 0 at low gain
    double full_scale = 0;       ///< dB from 0 to 255
    double gain_step = 0;        ///< dB
    double tvg_spreading = 0;    ///< dB per decade of range; 0 with the effect tvg off
    double tvg_absorption = 0;   ///< dB/m one way; 0 with the effect tvg off
};

/// Emulator options; README.md of this folder explains each.
struct Settings {
    std::uint8_t device_type = 2, device_revision = 1;
    std::array<std::uint8_t, 3> firmware{3, 3, 8}, protocol{1, 1, 0};
    bool echo_400 = false;
    int forward_angle = 200;  ///< gradians
    bool clockwise = true;
    bool ends_twice = false;
    bool last_data_on_request = false;
    bool accept_anything = false;
    bool accept_common_id = false;
    bool nack_requested_id = false;
    bool ack_set_id = true;
    double turn_time = 2.4;           ///< s for 400 gradians
    double idle_off = 30;             ///< s; 0: never
    double ethernet_time = 0.018;     ///< s from the end of the range to the reply by UDP
    std::vector<bool> by_ethernet{};  ///< of each endpoint: whether that time counts there
    double baud = 0;                  ///< bit/s, of ptys and TCP; 0: not paced
    SerialRate line;
    bool marks_are_breaks = true;
    std::string discovery = "auto";
    std::uint32_t announced = 0;  ///< IPv4 address of `discovery`; 0: not discoverable
    bool ring_down = true;
    Acoustics acoustics;

    /// Whether this firmware knows auto_transmit (2602) and auto_device_data (2301): above 3.3.0.
    bool scans_by_itself() const { return firmware > std::array<std::uint8_t, 3>{3, 3, 0}; }
};

/// From complete options and a complete profile. std::invalid_argument if a version or an address is none.
Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

/// What 2300 echoes before a host has set anything.
ping::DeviceData boot_settings();
/// The ping of these settings at an angle of 0..399 gradians.
Shot shot_from(const ping::DeviceData& settings, int angle, const Settings& options);

}  // namespace echoloop::ping360
