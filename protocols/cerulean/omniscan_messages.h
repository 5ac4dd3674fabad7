// The messages of the Omniscan 450 as plain structs. No wire code: omniscan_layouts.h says how they stand on
// the line.
#pragma once

#include <variant>

#include "protocols/cerulean/messages.h"

namespace echoloop::cerulean::omniscan {

/// Starts and stops the pings.
struct OsPingParams {
    std::uint32_t start_mm = 0;            ///< mm
    std::uint32_t length_mm = 0;           ///< mm; the profile ends at start plus length
    std::uint32_t msec_per_ping = 0;       ///< ms; 0: as fast as the range allows
    float reserved_1 = 0;                  ///< 0
    float reserved_2 = 0;                  ///< 0
    float pulse_len_percent = 0;           ///< of the time of a ping; 0.002 is typical and means 0.2 percent
    float filter_duration_percent = 0;     ///< of the time of a ping; 0.0015 is typical
    std::int16_t gain_index = 0;           ///< -1: automatic, 0 to 7
    std::uint16_t num_results = 0;         ///< 200 to 1200
    std::uint8_t enable = 0;               ///< 0: no pings
    std::vector<std::uint8_t> reserved_3;  ///< 3 bytes; 1 from hosts that follow the maker's manual

    friend bool operator==(const OsPingParams&, const OsPingParams&) = default;
};
/// One ping.
struct OsMonoProfile {
    std::uint32_t ping_number = 0;   ///< since power-up
    std::uint32_t start_mm = 0;      ///< mm
    std::uint32_t length_mm = 0;     ///< mm
    std::uint32_t timestamp_ms = 0;  ///< ms; since power-up, of the transmission
    std::uint32_t ping_hz = 0;       ///< Hz; of the sound
    std::uint16_t gain_index = 0;    ///< 0 to 7, the one in use
    std::uint16_t sos_dmps = 0;      ///< dm/s
    std::uint8_t channel_number = 0;
    std::uint8_t reserved = 0;               ///< 0
    float pulse_duration_sec = 0;            ///< s
    float analog_gain = 0;                   ///< factor
    float max_pwr_db = 0;                    ///< dB; of a result of 65535
    float min_pwr_db = 0;                    ///< dB; of a result of 0
    float transducer_heading_deg = 0;        ///< deg
    float vehicle_heading_deg = 0;           ///< deg
    std::vector<std::uint16_t> pwr_results;  ///< nearest first

    friend bool operator==(const OsMonoProfile&, const OsMonoProfile&) = default;
};

using Message = std::variant<ping::Ack, ping::Nack, ping::AsciiText, ping::DeviceInformation,
                             ping::ProtocolVersion, ping::GeneralRequest, JsonWrapper, SetSpeedOfSound,
                             GeneralSpeedOfSound, OsPingParams, OsMonoProfile>;

}  // namespace echoloop::cerulean::omniscan
