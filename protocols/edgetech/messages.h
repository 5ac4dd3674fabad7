// The messages of EdgeTech side-scans (JSF) as plain structs, all little-endian on the wire; over TCP and in
// .jsf files they are the same. No wire code: layouts.h says how they stand there. What no public program
// reads is kept as bytes.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/wire/bytes.h"
#include "protocols/wire/text.h"

namespace echoloop::edgetech {

inline constexpr std::uint16_t start_mark = 0x1601;

enum class Type : std::uint16_t {
    system_time = 22,
    time_delta = 23,
    shutdown = 25,
    alive = 41,
    sonar_data = 80,
    old_side_scan = 82,
    data_active = 83,
    ping = 120,
    ping_gain = 121,
    trigger = 125,
    range = 128,
    coupling = 129,
    pulse_select = 133,
    gain_control = 141,
    system_information = 182,
    file_time = 426,
    padding = 428,
    nmea_text = 2002,
    pitch_roll = 2020,
    pressure = 2060,
    doppler_log = 2080,
    situation = 2090,
    situation_2 = 2091,
};

enum class Command : std::uint8_t { set = 0, get = 1, reply = 2, error = 3 };

inline constexpr std::uint8_t low_frequency = 20, high_frequency = 21;  ///< subsystems; 0: sub-bottom

/// Before every message.
struct Header {
    std::uint8_t version = 0x0D;  ///< of the protocol
    std::uint8_t session = 0;
    Type type = Type::sonar_data;
    Command command = Command::set;
    std::uint8_t subsystem = 0;
    std::uint8_t channel = 0;  ///< 0 port, 1 starboard
    std::uint8_t sequence = 0;
    std::uint32_t size = 0;  ///< B of what follows

    friend bool operator==(const Header&, const Header&) = default;
};

/// Type 22, and 426 of files.
struct SystemTime {
    std::uint32_t seconds = 0;       ///< since 1970
    std::uint32_t milliseconds = 0;  ///< of the day in a reply; readers take them modulo 1000

    friend bool operator==(const SystemTime&, const SystemTime&) = default;
};

/// A setting: types 25, 83, 120, 121, 125, 128, 133, 141.
struct Setting {
    std::uint32_t value = 0;  ///< of type 128 in mm

    friend bool operator==(const Setting&, const Setting&) = default;
};

/// Type 129: a subsystem pings with each `divider`th ping of another.
struct Coupling {
    std::uint32_t source = 0, divider = 0, delay = 0;

    friend bool operator==(const Coupling&, const Coupling&) = default;
};

namespace valid {
inline constexpr std::uint16_t position = 1U << 0, course = 1U << 1, speed = 1U << 2, heading = 1U << 3,
                               pressure = 1U << 4, pitch_roll = 1U << 5, altitude = 1U << 6,
                               temperature = 1U << 8, depth = 1U << 9, sound_speed = 1U << 14;
}  // namespace valid

enum class DataFormat : std::int16_t {
    envelope = 0,  ///< u16
    analytic = 1,  ///< s16, real and imaginary
    raw = 2,       ///< s16
    real = 3,      ///< s16
    pixel = 4,     ///< u16
    analytic_unmatched = 9,
};

/// Type 80: one side of one ping.
struct SonarData {
    std::int32_t seconds = 0;  ///< since 1970
    std::uint32_t first_sample = 0;
    std::uint32_t ping = 0;  ///< the same for both sides
    std::array<std::uint8_t, 4> reserved_12{};
    std::uint16_t high_bits = 0;  ///< nibbles: start, end frequency, samples, mark
    std::uint16_t low_bits_1 = 0, low_bits_2 = 0;
    std::array<std::uint8_t, 6> reserved_22{};
    std::int16_t id = 1;
    std::uint16_t validity = 0;  ///< of namespace valid
    std::uint16_t reserved_32 = 0;
    DataFormat format = DataFormat::envelope;
    std::int16_t antenna_aft = 0, antenna_starboard = 0;  ///< cm
    std::array<std::uint8_t, 32> reserved_40{};
    std::array<std::uint8_t, 8> old_position{};  ///< a reader takes the header for obsolete if it equals x, y
    std::int32_t x = 0, y = 0;                   ///< longitude, latitude
    std::int16_t position_units = 0;             ///< 1 mm, 2 1e-4 minutes of arc, 3 dm
    wire::Text<24> annotation;
    std::uint16_t samples = 0;   ///< low 16 bits of the number
    std::uint32_t interval = 0;  ///< ns
    std::uint16_t converter_gain = 0;
    std::int16_t power = 0;  ///< %
    std::uint16_t reserved_124 = 0;
    std::uint16_t start_frequency = 0, end_frequency = 0;  ///< 10 Hz, low 16 bits
    std::uint16_t sweep = 0;                               ///< ms
    std::int32_t pressure = 0;                             ///< 0.001 psi
    std::int32_t depth = 0;                                ///< mm
    std::uint16_t sample_rate = 0;                         ///< Hz modulo 65536
    std::uint16_t pulse = 0;
    std::int32_t altitude = 0;                                         ///< mm
    float sound_speed = 0;                                             ///< m/s
    float mixer = 0;                                                   ///< Hz
    std::int16_t year = 0, day = 0, hour = 0, minute = 0, second = 0;  ///< day of the year
    std::int16_t time_basis = 3;
    std::int16_t weighting = 0;  ///< N: a level is sample x 2^-N
    std::int16_t pulses_in_water = 0;
    std::uint16_t heading = 0;         ///< 0.01 deg
    std::int16_t pitch = 0, roll = 0;  ///< 180 deg / 32768, bow up, port up
    std::array<std::uint8_t, 4> reserved_178{};
    std::int16_t trigger = 0;
    std::uint16_t mark = 0;
    std::int16_t fix_hour = 0, fix_minute = 0, fix_second = 0;
    std::int16_t course = 0;  ///< deg
    std::int16_t speed = 0;   ///< 0.1 kn
    std::int16_t fix_day = 0, fix_year = 0;
    std::uint32_t milliseconds = 0;  ///< of the day
    std::uint16_t converter_maximum = 0;
    std::array<std::uint8_t, 4> reserved_206{};
    wire::Text<6> software;
    std::int32_t spherical_correction = 0;  ///< 0.01; -1 off
    std::uint16_t packet = 1;
    std::int16_t decimation = 0;
    std::array<std::uint8_t, 16> reserved_224{};  ///< temperature, layback, cable: sources disagree
    wire::Bytes data;                             ///< near to far on both sides

    friend bool operator==(const SonarData&, const SonarData&) = default;
};

/// Type 82, of older files.
struct OldSideScan {
    std::uint16_t subsystem = 0, channel = 0;
    std::uint32_t ping = 0;
    std::uint16_t packet = 0, trigger = 0;
    std::uint32_t samples = 0;
    std::uint32_t interval = 0;  ///< ns
    std::uint32_t first_sample = 0;
    std::int16_t weighting = 0;
    std::uint16_t converter_gain = 0, converter_maximum = 0;
    std::uint16_t range = 0;  ///< 0.1 m
    std::uint16_t pulse = 0, mark = 0, format = 0;
    std::uint16_t reserved_38 = 0;
    std::uint32_t milliseconds = 0;  ///< of the day
    std::int16_t year = 0;
    std::uint16_t day = 0, hour = 0, minute = 0, second = 0;
    std::int16_t heading = 0, pitch = 0, roll = 0;  ///< minutes of arc
    std::int16_t heave = 0;                         ///< cm
    std::int16_t yaw = 0;                           ///< minutes of arc
    std::uint32_t depth = 0;                        ///< cm
    std::int16_t temperature = 0;                   ///< 0.1 degC
    std::array<std::uint8_t, 10> reserved_70{};
    wire::Bytes data;

    friend bool operator==(const OldSideScan&, const OldSideScan&) = default;
};

/// Type 182, of files.
struct SystemInformation {
    std::int32_t system = 0;  ///< 2: 2xxx series
    std::int32_t reserved_4 = 0;
    std::int32_t software_version = 0;
    std::int32_t reserved_12 = 0;
    std::int32_t serial = 0;
    std::uint32_t text_size = 0;
    wire::Bytes text;

    friend bool operator==(const SystemInformation&, const SystemInformation&) = default;
};

/// Type 2002.
struct NmeaText {
    std::int32_t seconds = 0, milliseconds = 0;
    std::uint8_t source = 1;  ///< 1 sonar, 2 acquisition program
    std::array<std::uint8_t, 3> reserved_9{};
    wire::Bytes text;

    friend bool operator==(const NmeaText&, const NmeaText&) = default;
};

/// Type 2020.
struct PitchRoll {
    std::int32_t seconds = 0, milliseconds = 0;
    std::array<std::uint8_t, 4> reserved_8{};
    std::array<std::int16_t, 3> acceleration{};  ///< 30 / 32768 g
    std::array<std::int16_t, 3> rate{};          ///< 750 / 32768 deg/s
    std::int16_t pitch = 0, roll = 0;            ///< 180 deg / 32768
    std::int16_t temperature = 0;                ///< 0.1 degC
    std::uint16_t device_info = 0;
    std::int16_t heave = 0;      ///< mm
    std::uint16_t heading = 0;   ///< 0.01 deg
    std::uint32_t validity = 0;  ///< bits of the fields in this order
    std::int32_t reserved_40 = 0;

    friend bool operator==(const PitchRoll&, const PitchRoll&) = default;
};

/// Type 2060.
struct Pressure {
    std::int32_t seconds = 0, milliseconds = 0;
    std::array<std::uint8_t, 4> reserved_8{};
    std::int32_t pressure = 0;  ///< 0.001 psi
    std::int32_t salinity = 0;  ///< ppm
    std::uint32_t validity = 0;
    std::int32_t conductivity = 0;  ///< uS/cm
    std::int32_t sound_speed = 0;   ///< mm/s
    wire::Bytes rest;

    friend bool operator==(const Pressure&, const Pressure&) = default;
};

/// What no public program reads, and what a get carries.
struct Unread {
    wire::Bytes bytes;

    friend bool operator==(const Unread&, const Unread&) = default;
};

using Body = std::variant<SystemTime, Setting, Coupling, SonarData, OldSideScan, SystemInformation, NmeaText,
                          PitchRoll, Pressure, Unread>;

struct Message {
    Header header;
    Body body;

    friend bool operator==(const Message&, const Message&) = default;
};

}  // namespace echoloop::edgetech
