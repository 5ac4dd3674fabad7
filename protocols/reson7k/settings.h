// The two records of settings of a 7k sonar, 7000 and 7503, and the two that set its time-varied gain, 7611
// and 7612. Plain structs.
#pragma once

#include <array>
#include <cstdint>

#include "protocols/wire/bytes.h"

namespace echoloop::reson7k {

/// What 7000 and 7503 share, from the frequency to the receive flags.
struct Settings {
    float frequency = 0;           ///< Hz
    float sample_rate = 0;         ///< Hz
    float receiver_bandwidth = 0;  ///< Hz
    float pulse = 0;               ///< s
    std::uint32_t pulse_type = 0;  ///< 0 CW, 1 linear chirp
    std::uint32_t envelope = 0;    ///< 0 tapered rectangular
    float envelope_parameter = 0;
    std::uint16_t pulse_mode = 1;  ///< 1: single ping
    std::uint16_t reserved = 0;
    float max_rate = 0;  ///< Hz
    float period = 0;    ///< s since the last ping
    float range = 0;     ///< m
    float power = 0;     ///< dB re 1 uPa at 1 m
    float gain = 0;      ///< dB
    std::uint32_t control = 0;
    std::uint32_t projector = 0;
    float steering_vertical = 0;    ///< rad
    float steering_horizontal = 0;  ///< rad
    float tx_width_vertical = 0;    ///< rad, along the track
    float tx_width_horizontal = 0;  ///< rad, across
    float focus = 0;                ///< m
    std::uint32_t tx_window = 0;
    float tx_window_parameter = 0;
    std::uint32_t transmit_flags = 0;
    std::uint32_t hydrophone = 0;
    std::uint32_t rx_window = 0;
    float rx_window_parameter = 0;
    std::uint32_t receive_flags = 0;

    friend bool operator==(const Settings&, const Settings&) = default;
};

/// What both have behind it; 7000 has the width of a receive beam in between.
struct Conditions {
    float min_range = 0, max_range = 0, min_depth = 0, max_depth = 0;  ///< m, of the bottom filter
    float absorption = 0;                                              ///< dB/km
    float sound_speed = 0;                                             ///< m/s
    float spreading = 0;                                               ///< dB per decade of range

    friend bool operator==(const Conditions&, const Conditions&) = default;
};

struct SonarSettings {  ///< 7000
    static constexpr std::uint32_t type = 7000;
    std::uint64_t serial = 0;
    std::uint32_t ping = 0;
    std::uint16_t multi_ping = 0;
    Settings settings;
    float rx_width = 0;  ///< rad
    Conditions conditions;
    std::uint16_t reserved = 0;
    friend bool operator==(const SonarSettings&, const SonarSettings&) = default;
};

/// What 7503 has behind that.
struct RemoteExtras {
    std::uint8_t vernier_mode = 0;
    std::uint8_t search_window = 0;        ///< %
    std::array<float, 3> tx_offset{};      ///< m
    std::array<float, 3> head_tilt{};      ///< rad
    std::uint32_t ping_state = 0;          ///< 0 off, 1 on, 2 by an external trigger
    std::uint16_t beam_spacing = 1;        ///< 1 equi-angle, 2 equi-distant
    std::uint16_t mode = 0;                ///< 0 normal
    std::array<float, 2> adaptive_gate{};  ///< m, least and greatest depth
    std::array<double, 2> trigger_out{};   ///< length and offset
    std::uint16_t projector_81xx = 0;
    std::array<std::uint32_t, 2> reserved1{};
    float other_gain = 0;  ///< dB
    std::uint8_t vernier_filter = 0;
    std::uint8_t reserved2 = 0;
    std::uint16_t custom_beams = 0;
    float coverage = 0;  ///< rad
    std::uint8_t coverage_mode = 0;
    std::uint8_t quality_filter = 0;
    float rx_steering = 0;               ///< rad
    std::array<float, 2> flex_sector{};  ///< rad, coverage and steering
    float constant_spacing = 0;          ///< m
    std::uint16_t beam_mode = 0;         ///< of those in 7001, from 0
    float gate_tilt = 0;                 ///< rad, positive to starboard
    float applied_frequency = 0;         ///< Hz
    std::uint32_t element = 0;

    friend bool operator==(const RemoteExtras&, const RemoteExtras&) = default;
};

struct RemoteSettings {  ///< 7503
    static constexpr std::uint32_t type = 7503;
    std::uint64_t serial = 0;
    std::uint32_t ping = 0;  ///< 0: on request
    Settings settings;
    Conditions conditions;
    RemoteExtras extras;
    wire::Bytes more;  ///< what the sonar's version adds
    friend bool operator==(const RemoteSettings&, const RemoteSettings&) = default;
};

struct AbsorptionLoss {  ///< 7611, to the sonar
    static constexpr std::uint32_t type = 7611;
    float loss = 0;  ///< dB/km
    friend bool operator==(const AbsorptionLoss&, const AbsorptionLoss&) = default;
};

struct SpreadingLoss {  ///< 7612, to the sonar
    static constexpr std::uint32_t type = 7612;
    float loss = 0;  ///< dB per decade of range
    friend bool operator==(const SpreadingLoss&, const SpreadingLoss&) = default;
};

}  // namespace echoloop::reson7k
