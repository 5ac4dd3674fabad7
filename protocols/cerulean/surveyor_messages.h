// The messages of the Surveyor 240-16 as plain structs. No wire code: surveyor_layouts.h says how they stand
// on the line. Names are those of the published definitions.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/cerulean/messages.h"

namespace echoloop::cerulean::surveyor {

/// The device asks for the time of day.
struct UtcRequest {
    friend bool operator==(const UtcRequest&, const UtcRequest&) = default;
};
/// The time of day from the host.
struct UtcResponse {
    std::uint64_t utc_msec = 0;       ///< ms since 1970
    std::uint32_t accuracy_msec = 0;  ///< ms

    friend bool operator==(const UtcResponse&, const UtcResponse&) = default;
};
/// Where the device finds a time server. IPv4 addresses with their first octet in the lowest byte.
struct SetNetInfo {
    std::uint32_t ntp_ip_address = 0;
    std::uint32_t subnet_mask = 0;
    std::uint32_t gateway_ip = 0;  ///< 0: none is needed

    friend bool operator==(const SetNetInfo&, const SetNetInfo&) = default;
};
/// What the sensors in the water say.
struct WaterStats {
    float temperature = 0;  ///< degC
    float pressure = 0;     ///< bar

    friend bool operator==(const WaterStats&, const WaterStats&) = default;
};
/// How the head hangs in the water.
struct AttitudeReport {
    std::array<float, 3> up_vec{};    ///< the world's up direction: x forward, y port, z up of the head
    std::array<float, 3> reserved{};  ///< for a magnetic field
    std::uint64_t utc_msec = 0;       ///< ms since 1970; 0: not known
    std::uint32_t pwr_up_msec = 0;    ///< ms since power-up

    friend bool operator==(const AttitudeReport&, const AttitudeReport&) = default;
};
/// A sounding in the head's plane.
struct YzPoint {
    float y = 0;  ///< m, positive to port
    float z = 0;  ///< m, positive upwards, so negative

    friend bool operator==(const YzPoint&, const YzPoint&) = default;
};
/// The soundings of one ping as places.
struct YzPointData {
    std::uint32_t timestamp_msec = 0;  ///< ms since power-up
    std::uint32_t ping_number = 0;     ///< since power-up
    float sos_mps = 0;                 ///< m/s, speed of sound
    std::array<float, 3> up_vec{};     ///< as in AttitudeReport
    std::array<float, 3> mag_vec{};    ///< for a magnetic field
    std::array<std::uint32_t, 10> reserved{};
    float water_degC = 0;      ///< degC; -1000: no sensor
    float water_bar = 0;       ///< bar; -1000: no sensor
    float heave_m = 0;         ///< m
    float start_m = 0;         ///< m, nearest range listened to
    float end_m = 0;           ///< m, farthest range listened to
    std::uint16_t unused = 0;  ///< 0
    std::vector<YzPoint> yz_point_data;

    friend bool operator==(const YzPointData&, const YzPointData&) = default;
};
/// A sounding as it is measured.
struct AtofPoint {
    float angle = 0;  ///< rad from straight down, positive to port
    float tof = 0;    ///< s, two-way
    std::array<std::uint32_t, 2> reserved{};

    friend bool operator==(const AtofPoint&, const AtofPoint&) = default;
};
/// The soundings of one ping as angles and times of flight.
struct AtofPointData {
    std::uint32_t pwr_up_msec = 0;  ///< ms since power-up, of the transmission
    std::uint64_t utc_msec = 0;     ///< ms since 1970; 0: not known
    float listening_sec = 0;        ///< s, from the transmission to the last range step
    float sos_mps = 0;              ///< m/s, speed of sound
    std::uint32_t ping_number = 0;  ///< since power-up
    std::uint32_t ping_hz = 0;      ///< Hz
    float pulse_sec = 0;            ///< s
    std::uint32_t flags = 0;        ///< 0
    std::uint16_t reserved = 0;     ///< 0
    std::vector<AtofPoint> atof_point_data;

    friend bool operator==(const AtofPointData&, const AtofPointData&) = default;
};
/// How to ping from now on.
struct PingParameters {
    std::int32_t start_mm = 0;                    ///< mm; at least 5 % of end_mm
    std::int32_t end_mm = 0;                      ///< mm; 0: follow the bottom
    float sos_mps = 0;                            ///< m/s, speed of sound
    std::int16_t gain_index = 0;                  ///< -1 automatic, 0 to 100
    std::int16_t msec_per_ping = 0;               ///< ms; upper limit of the ping rate
    std::uint16_t deprecated = 0;                 ///< 0
    std::uint8_t diagnostic_injected_signal = 0;  ///< 0
    std::uint8_t ping_enable = 0;                 ///< 0: stop
    std::uint8_t enable_channel_data = 0;
    std::uint8_t reserved_for_raw_data = 0;  ///< 0
    std::uint8_t enable_yz_point_data = 0;
    std::uint8_t enable_atof_data = 0;
    std::int32_t target_ping_hz = 0;  ///< Hz, 240000
    std::uint16_t n_range_steps = 0;  ///< 200 to 800
    std::uint16_t reserved = 0;       ///< 0
    float pulse_len_steps = 0;        ///< pulse length in range steps; 1.5 is recommended

    friend bool operator==(const PingParameters&, const PingParameters&) = default;
};

using Message =
    std::variant<ping::Ack, ping::Nack, ping::AsciiText, ping::DeviceInformation, ping::ProtocolVersion,
                 ping::GeneralRequest, JsonWrapper, UtcRequest, UtcResponse, SetNetInfo, WaterStats,
                 AttitudeReport, YzPointData, AtofPointData, PingParameters>;

}  // namespace echoloop::cerulean::surveyor
