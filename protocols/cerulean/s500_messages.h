// The messages of the S500 echosounder as plain structs. No wire code: s500_layouts.h says how they stand on
// the line.
#pragma once

#include <variant>

#include "protocols/cerulean/messages.h"

namespace echoloop::cerulean::s500 {

/// Starts and stops the pings.
struct SetPingParams {
    std::uint32_t start_mm = 0;        ///< mm
    std::uint32_t length_mm = 0;       ///< mm; 0: automatic
    std::int16_t gain_index = 0;       ///< -1: automatic, 0 to 13
    std::int16_t msec_per_ping = 0;    ///< ms, at least; -1: a single ping
    std::uint16_t pulse_len_usec = 0;  ///< us; the device chooses its own
    std::uint16_t report_id = 0;       ///< 1223 or 1308 after every ping; 0: no pings
    std::uint16_t reserved = 0;        ///< 0
    std::uint8_t chirp = 0;            ///< 1: chirp, 0: one tone
    std::uint8_t decimation = 0;       ///< of the chirp's results; 0: automatic

    friend bool operator==(const SetPingParams&, const SetPingParams&) = default;
};
/// What and which version.
struct FwVersion {
    std::uint8_t device_type = 0;
    std::uint8_t device_model = 0;
    std::uint16_t version_major = 0;
    std::uint16_t version_minor = 0;

    friend bool operator==(const FwVersion&, const FwVersion&) = default;
};
struct SpeedOfSound {
    std::uint32_t sos_mm_per_sec = 0;  ///< mm/s

    friend bool operator==(const SpeedOfSound&, const SpeedOfSound&) = default;
};
struct Range {
    std::uint32_t start_mm = 0;   ///< mm
    std::uint32_t length_mm = 0;  ///< mm

    friend bool operator==(const Range&, const Range&) = default;
};
struct PingRate {
    std::uint16_t msec_per_ping = 0;  ///< ms, at least

    friend bool operator==(const PingRate&, const PingRate&) = default;
};
struct GainIndex {
    std::uint32_t gain_index = 0;

    friend bool operator==(const GainIndex&, const GainIndex&) = default;
};
/// The distance of the last ping.
struct Altitude {
    std::uint32_t altitude_mm = 0;  ///< mm
    std::uint8_t quality = 0;       ///< %

    friend bool operator==(const Altitude&, const Altitude&) = default;
};
struct ProcessorTemperature {
    std::uint32_t centi_degC = 0;  ///< 0.01 degC

    friend bool operator==(const ProcessorTemperature&, const ProcessorTemperature&) = default;
};
/// The distance of one ping, and its average.
struct Distance2 {
    std::uint32_t ping_distance_mm = 0;            ///< mm
    std::uint32_t averaged_distance_mm = 0;        ///< mm; of 20 pings
    std::uint16_t reserved = 0;                    ///< 0
    std::uint8_t ping_confidence = 0;              ///< %
    std::uint8_t average_distance_confidence = 0;  ///< %
    std::uint32_t timestamp = 0;                   ///< ms; since power-up

    friend bool operator==(const Distance2&, const Distance2&) = default;
};
/// One ping.
struct Profile6 {
    std::uint32_t ping_number = 0;                           ///< since power-up
    std::uint32_t start_mm = 0;                              ///< mm
    std::uint32_t length_mm = 0;                             ///< mm
    std::uint32_t start_ping_hz = 0;                         ///< Hz; where the chirp begins
    std::uint32_t end_ping_hz = 0;                           ///< Hz; where the chirp ends
    std::uint32_t adc_sample_hz = 0;                         ///< Hz
    std::uint32_t timestamp_msec = 0;                        ///< ms; since power-up
    std::uint32_t spare2 = 0;                                ///< 0
    float pulse_duration_sec = 0;                            ///< s
    float analog_gain = 0;                                   ///< factor
    float max_pwr_db = 0;                                    ///< dB; of a result of 65535
    float min_pwr_db = 0;                                    ///< dB; of a result of 0
    float this_ping_depth_m = 0;                             ///< m
    float smooth_depth_m = 0;                                ///< m
    float fspare2 = 0;                                       ///< 0
    std::uint8_t ping_depth_measurement_confidence = 0;      ///< %
    std::uint8_t gain_index = 0;                             ///< the one in use
    std::uint8_t decimation = 0;                             ///< the one in use; 0 for one tone
    std::uint8_t smoothed_depth_measurement_confidence = 0;  ///< %
    std::vector<std::uint16_t> pwr_results;                  ///< nearest first

    friend bool operator==(const Profile6&, const Profile6&) = default;
};

using Message =
    std::variant<ping::Ack, ping::Nack, ping::AsciiText, ping::DeviceInformation, ping::ProtocolVersion,
                 ping::GeneralRequest, JsonWrapper, SetSpeedOfSound, SetPingParams, FwVersion, SpeedOfSound,
                 Range, PingRate, GainIndex, Altitude, ProcessorTemperature, Distance2, Profile6>;

}  // namespace echoloop::cerulean::s500
