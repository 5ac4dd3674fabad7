// The options and the profile of a Sonar 3D-15 as typed values, and what a host can set. Data only.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "protocols/sonar3d/messages.h"

namespace echoloop::sonar_3d_15 {

inline constexpr std::size_t width = 256, height = 64;  ///< pixels of an image

/// Figures of one frequency mode; angles in rad.
struct ModeFigures {
    double frequency = 0;                         ///< Hz
    double beam_width = 0, fan_height = 0;        ///< of one beam, -3 dB
    double fov_horizontal = 0, fov_vertical = 0;  ///< between the centres of the outer pixels
    double rate = 0;                              ///< Hz, of images
    double source_level = 0;                      ///< dB re 1 uPa at 1 m
    double directivity_index = 0;                 ///< dB
    double tvg_absorption = 0;                    ///< dB/m, one way
};

struct Acoustics {
    ModeFigures low, high;
    AxisPattern horizontal, vertical;
    Receiver receiver;           ///< its directivity index is that of the mode
    double pulse_length = 0;     ///< s
    double longest_range = 0;    ///< m, that can be set
    double finest_bin = 0;       ///< m
    std::size_t bins = 0;        ///< the most
    double detection = 0;        ///< dB above the noise that an echo must have
    double neighbours = 0;       ///< dB below the mean of beams beside it, at most
    double reference_level = 0;  ///< dB re 1 uPa, reads strength 0
    double tvg_spreading = 0;    ///< dB per decade of range
};

enum class UdpMode { multicast, unicast, disabled };

/// What a host reads and sets by HTTP.
struct State {
    bool enabled = false;
    double range_min = 0.5, range_max = 15;  ///< m
    double speed = 1491;                     ///< m/s; 0: from salinity and temperature
    bool high = false;
    bool salt = true;
    UdpMode udp = UdpMode::multicast;
    std::string unicast_ip;
    std::uint16_t unicast_port = 0;
    std::string ntp_address = "auto";  ///< from release 1.7.1 on
    double clock_error = 0;            ///< s, of the sonar's clock against the run's; set by hand or unset
    double unix_now = 0;               ///< s, of the run, when a request comes
    bool imu = false;                  ///< ImuBatch is sent; from release 1.8.0 on
    double temperature = 0;            ///< degC, as its own sensor reads
};

inline constexpr std::array<int, 3> with_modes{1, 7, 0}, with_time{1, 7, 1}, with_imu{1, 8, 0};  ///< releases

struct Settings {
    State start;
    std::array<int, 3> release{1, 7, 0};  ///< of the firmware
    sonar3d::Version version = sonar3d::Version::rip2;
    std::string package = "waterlinked.sonar.protocol";  ///< of the protobuf messages
    bool frequency_in_hertz = false;                     ///< else 5, as real sonars send
    bool first_row_up = false;
    bool any_page = false;          ///< a web page from elsewhere may command
    bool other_messages = false;    ///< a message that readers do not know follows each shot's images
    double temperature = 21;        ///< degC, inside
    double water_temperature = 10;  ///< degC, for the automatic speed of sound
    double speed_delay = 0;         ///< s until a new speed of sound is used
    double processing_time = 5e-3;  ///< s from the last echo to the image, at least
    bool ntp_reached = true;        ///< from release 1.7.1 on: it has a time server
    bool tvg = true;                ///< the effect of that name
    double unix_start = 0;          ///< s
    std::uint32_t chip_id = 0;      ///< another one for each unit
    Sensors sensors;
    Acoustics acoustics;

    const ModeFigures& mode(bool high) const { return high ? acoustics.high : acoustics.low; }
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile; std::invalid_argument if they contradict each other.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::sonar_3d_15
