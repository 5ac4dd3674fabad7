// PD0 ensembles of Teledyne RD Instruments' Doppler logs, and PD5 blocks, as plain structs. No wire code:
// layouts.h says how they stand on the line. Offsets are those of the makers' guides (Pathfinder, Workhorse,
// Explorer).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop::teledyne {

inline constexpr std::int16_t bad = -32768;  ///< a velocity that there is not
inline constexpr std::size_t beams = 4;

struct FixedLeader {
    std::uint8_t firmware = 0, revision = 0;
    std::uint16_t configuration = 0;  ///< frequency, shape, head, direction, beam angle, Janus
    std::uint8_t simulated = 0, lag = 0;
    std::uint8_t beam_count = beams, cells = 0;
    std::uint16_t pings = 0, cell_size = 0, blank = 0;  ///< -, cm, cm
    std::uint8_t mode = 1, correlation_threshold = 64, repetitions = 1, percent_good = 0;
    std::uint16_t error_threshold = 2000;                  ///< mm/s
    std::array<std::uint8_t, 3> between_pings{};           ///< min, s, 0.01 s
    std::uint8_t coordinates = 0;                          ///< EX: frame, tilts, three beams, bin mapping
    std::int16_t heading_alignment = 0, heading_bias = 0;  ///< 0.01 deg
    std::uint8_t sensors_used = 0, sensors_there = 0;
    std::uint16_t first_cell = 0, pulse = 0;  ///< cm
    std::array<std::uint8_t, 2> layer{};
    std::uint8_t false_target = 0, spare = 0;
    std::uint16_t lag_distance = 0;  ///< cm
    std::array<std::uint8_t, 8> board{};
    std::array<std::uint8_t, 4> bandwidth{};
    std::uint32_t serial_number = 0;
    std::vector<std::uint8_t> more;  ///< of a Workhorse: the beam angle, deg

    friend bool operator==(const FixedLeader&, const FixedLeader&) = default;
};

struct VariableLeader {
    std::uint16_t number = 0;
    std::uint8_t year = 0, month = 1, day = 1, hour = 0, minute = 0, second = 0, hundredth = 0;
    std::uint8_t number_high = 0;
    std::uint16_t built_in_test = 0;
    std::uint16_t sound_speed = 1500, depth = 0;  ///< m/s, dm
    std::uint16_t heading = 0;                    ///< 0.01 deg
    std::int16_t pitch = 0, roll = 0;             ///< 0.01 deg
    std::uint16_t salinity = 0;                   ///< parts per thousand
    std::int16_t temperature = 0;                 ///< 0.01 degC
    std::array<std::uint8_t, 3> wait{};           ///< min, s, 0.01 s
    std::array<std::uint8_t, 3> deviation{};      ///< 1, 0.1, 0.1 deg
    std::array<std::uint8_t, 8> converter{};
    std::uint32_t status = 0;
    std::uint16_t spare = 0;
    std::uint32_t pressure = 0, pressure_variance = 0;  ///< daPa
    std::uint8_t spare_2 = 0;
    std::vector<std::uint8_t> more;  ///< clock with a century, health, leaks, supply

    friend bool operator==(const VariableLeader&, const VariableLeader&) = default;
};

/// Of a cell of a water profile.
struct Cell {
    std::array<std::int16_t, beams> velocity{bad, bad, bad, bad};  ///< mm/s
    friend bool operator==(const Cell&, const Cell&) = default;
};
/// Of cells, nearest first.
struct Velocity {
    std::vector<Cell> cells;
    friend bool operator==(const Velocity&, const Velocity&) = default;
};
/// Four values a cell.
struct Correlation {
    std::vector<std::uint8_t> values;
    friend bool operator==(const Correlation&, const Correlation&) = default;
};
struct Intensity {
    std::vector<std::uint8_t> values;
    friend bool operator==(const Intensity&, const Intensity&) = default;
};
struct PercentGood {
    std::vector<std::uint8_t> values;
    friend bool operator==(const PercentGood&, const PercentGood&) = default;
};

struct BottomTrack {
    std::uint16_t pings = 1, delay = 0;
    std::uint8_t least_correlation = 220, least_amplitude = 24, least_good = 0, mode = 8;
    std::uint16_t most_error = 1000;  ///< mm/s
    std::array<std::uint8_t, 4> spare{};
    std::array<std::uint16_t, beams> range{};                      ///< cm, vertical; 0: none
    std::array<std::int16_t, beams> velocity{bad, bad, bad, bad};  ///< mm/s, of the bottom
    std::array<std::uint8_t, beams> correlation{}, amplitude{}, good{};
    std::uint16_t layer_least = 0, layer_near = 0, layer_far = 0;  ///< dm
    std::array<std::int16_t, beams> layer_velocity{bad, bad, bad, bad};
    std::array<std::uint8_t, beams> layer_correlation{}, layer_amplitude{}, layer_good{};
    std::uint16_t most_depth = 0;  ///< dm
    std::array<std::uint8_t, beams> rssi{};
    std::uint8_t gain = 1;
    std::array<std::uint8_t, beams> range_high{};
    std::vector<std::uint8_t> more;

    friend bool operator==(const BottomTrack&, const BottomTrack&) = default;
};

/// What has no table here.
struct Other {
    std::uint16_t id = 0;
    std::vector<std::uint8_t> values;
    friend bool operator==(const Other&, const Other&) = default;
};

using Section = std::variant<FixedLeader, VariableLeader, Velocity, Correlation, Intensity, PercentGood,
                             BottomTrack, Other>;

struct Ensemble {
    std::uint8_t spare = 0;
    std::vector<Section> sections;
    friend bool operator==(const Ensemble&, const Ensemble&) = default;
};

struct Pd5 {
    std::uint8_t configuration = 0;
    std::array<std::int16_t, beams> velocity{bad, bad, bad, bad};  ///< mm/s
    std::array<std::uint16_t, beams> range{};                      ///< cm
    std::uint8_t status = 0;
    std::array<std::int16_t, beams> water{bad, bad, bad, bad};
    std::uint16_t layer_start = 0, layer_end = 0;  ///< dm
    std::uint8_t layer_status = 0;
    std::uint8_t hour = 0, minute = 0, second = 0, hundredth = 0;
    std::uint16_t built_in_test = 0;
    std::uint16_t sound_speed = 1500;  ///< m/s
    std::int16_t temperature = 0;      ///< 0.01 degC
    std::uint8_t salinity = 0;
    std::uint16_t depth = 0;                                ///< dm
    std::int16_t pitch = 0, roll = 0;                       ///< 0.01 deg
    std::uint16_t heading = 0;                              ///< 0.01 deg
    std::array<std::int32_t, beams> way{}, way_in_water{};  ///< dm
    std::uint16_t checksum = 0;

    friend bool operator==(const Pd5&, const Pd5&) = default;
};

}  // namespace echoloop::teledyne
