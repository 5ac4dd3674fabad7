// What a Teledyne Wayfinder and its host say, as plain structs. No wire code: layouts.h says how they stand
// on the line. Offsets, numbers and units are those of the maker's public driver (Teledyne-Marine/Wayfinder
// 1.00.00.24).
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/wire/text.h"

namespace echoloop::wayfinder {

inline constexpr std::size_t beams = 4, boards = 4;

/// What a packet holds.
enum class Kind : std::uint8_t { command = 3, response = 4, data = 5, status = 7, spectrum = 8 };

enum class CommandId : std::uint32_t {
    stop = 0x0000000F,
    start = 0x00000010,
    trigger = 0x00000011,
    factory_defaults = 0x00000017,
    get_features = 0x10000001,
    set_features = 0x12000002,
    get_tests = 0x19000001,
    get_spectrum = 0x1B000002,
    get_time = 0x1D000001,
    set_time = 0x1F000002,
    start_update = 0x22000001,
    upload = 0x22000002,
    get_system = 0x81000001,
    get_components = 0x81000003,
    set_system = 0x83000002,
    set_components = 0x83000004,
    get_setup = 0x85000001,
    set_sound_speed = 0x86000003,
    set_setup = 0x87000002,
};

/// How a command went.
enum class Outcome : std::uint8_t {
    none = 0,
    success = 1,
    unknown = 2,  ///< command
    invalid = 3,  ///< parameter
    failed = 4,   ///< in its execution
    not_set = 5,  ///< error of a set command
    not_got = 6,  ///< error of a get command
    pinging = 7,  ///< it cannot be done while pinging
};

/// Which parameter is invalid.
enum class Wrong : std::uint8_t { none = 0, baud = 1, trigger = 2, sound_speed = 3, range = 4, time = 5 };

/// A command without parameters, or with some that do not fit it.
struct Command {
    CommandId command = CommandId::get_system;
    std::vector<std::uint8_t> parameters;
    friend bool operator==(const Command&, const Command&) = default;
};

struct Clock {
    std::uint8_t version = 0x10;
    std::uint32_t size = 12;  ///< B, of this structure with its number
    std::uint8_t year = 0;    ///< of the century
    std::uint8_t month = 1, day = 1;
    std::uint8_t hour = 0, minute = 0, second = 0;
    friend bool operator==(const Clock&, const Clock&) = default;
};

/// What a host can set.
struct Setup {
    std::uint8_t version = 0x11;
    std::uint32_t size = 20;        ///< B; a host may say 16 of the same bytes
    std::uint8_t trigger = 0;       ///< 1: it pings when it is told
    std::uint8_t baud = 7;          ///< 3: 9600, 7: 115200 bit/s
    float sound_speed = 1500;       ///< m/s
    float most_range = 60;          ///< m
    float most_vertical_range = 0;  ///< m, of a vertical beam
    friend bool operator==(const Setup&, const Setup&) = default;
};
/// The same of a unit without a vertical beam.
struct OlderSetup {
    std::uint8_t version = 0x10;
    std::uint32_t size = 16;
    std::uint8_t trigger = 0, baud = 7;
    float sound_speed = 1500, most_range = 60;
    friend bool operator==(const OlderSetup&, const OlderSetup&) = default;
};

struct SetTime {
    Clock clock;
    friend bool operator==(const SetTime&, const SetTime&) = default;
};
struct SetSetup {
    Setup setup;
    friend bool operator==(const SetSetup&, const SetSetup&) = default;
};
struct SetOlderSetup {
    OlderSetup setup;
    friend bool operator==(const SetOlderSetup&, const SetOlderSetup&) = default;
};
struct SetSoundSpeed {
    float sound_speed = 1500;  ///< m/s
    friend bool operator==(const SetSoundSpeed&, const SetSoundSpeed&) = default;
};

/// How a command went that asks for nothing, or whose structure has no table.
struct Response {
    CommandId command = CommandId::get_system;
    Outcome outcome = Outcome::success;
    std::vector<std::uint8_t> more;
    friend bool operator==(const Response&, const Response&) = default;
};
/// The same, and which parameter is to blame.
struct Refusal {
    CommandId command = CommandId::get_system;
    Outcome outcome = Outcome::invalid;
    Wrong wrong = Wrong::none;
    friend bool operator==(const Refusal&, const Refusal&) = default;
};

struct TimeResponse {
    Outcome outcome = Outcome::success;
    Wrong wrong = Wrong::none;
    Clock clock;
    friend bool operator==(const TimeResponse&, const TimeResponse&) = default;
};
struct SetupResponse {
    Outcome outcome = Outcome::success;
    Wrong wrong = Wrong::none;
    Setup setup;
    friend bool operator==(const SetupResponse&, const SetupResponse&) = default;
};
struct SystemResponse {
    Outcome outcome = Outcome::success;
    Wrong wrong = Wrong::none;
    std::uint8_t version = 0x10;
    std::uint32_t size = 135;                ///< B
    float frequency = 614400;                ///< Hz
    std::array<std::uint8_t, 4> firmware{};  ///< major, minor, patch, build
    std::uint32_t fpga = 0;
    std::uint64_t system_id = 0;
    std::uint8_t transducer = 0;
    float beam_angle = 30;  ///< deg
    std::uint8_t vertical_beam = 0;
    std::array<std::uint8_t, 101> reserved{};
    std::uint8_t type = 76, subtype = 0;
    friend bool operator==(const SystemResponse&, const SystemResponse&) = default;
};
struct FeaturesResponse {
    Outcome outcome = Outcome::success;
    Wrong wrong = Wrong::none;
    std::uint8_t version = 0x10;
    std::uint32_t size = 7;          ///< B
    std::uint8_t base_accuracy = 1;  ///< 0: the high one
    friend bool operator==(const FeaturesResponse&, const FeaturesResponse&) = default;
};
struct TestsResponse {
    Outcome outcome = Outcome::success;
    Wrong wrong = Wrong::none;
    std::uint8_t version = 0x10;
    std::uint32_t size = 12;              ///< B
    std::array<std::uint8_t, 6> tests{};  ///< SDRAM, FRAM, clock, EEPROM, flash, converter: 1 passed
    friend bool operator==(const TestsResponse&, const TestsResponse&) = default;
};
struct ComponentsResponse {
    Outcome outcome = Outcome::success;
    Wrong wrong = Wrong::none;
    std::uint8_t version = 0x10;
    std::uint32_t size = 135;  ///< B
    std::uint8_t count = boards;
    /// Part number, revision and serial number, a NUL behind each.
    wire::Text<32> board_1, board_2, board_3, board_4;
    friend bool operator==(const ComponentsResponse&, const ComponentsResponse&) = default;
};

/// A ping.
struct Data {
    std::uint32_t data_size = 87;  ///< B, of the data with their sum
    std::uint8_t type = 76, subtype = 0;
    std::array<std::uint8_t, 4> firmware{};
    std::uint8_t year = 0, month = 1, day = 1;  ///< of the century
    std::uint8_t hour = 0, minute = 0, second = 0;
    std::uint16_t millisecond = 0;
    std::uint8_t frame = 1;                        ///< 0 beam, 1 instrument, 2 ship, 3 earth
    std::array<float, beams> velocity{}, range{};  ///< m/s, m; NaN: none
    float mean_range = 0;                          ///< m; NaN: none
    float sound_speed = 1500;                      ///< m/s, by which it was measured
    std::uint16_t status = 0;
    std::uint8_t test_errors = 0, test_code = 0;           ///< of built-in tests
    float voltage = 0, transmit_voltage = 0, current = 0;  ///< V, V, A
    wire::Text<6> serial_number;
    std::array<std::uint8_t, 2> reserved{};
    std::uint16_t checksum = 0;  ///< sum of the data before it
    friend bool operator==(const Data&, const Data&) = default;
};

/// What has no table here: states of tests, spectra, data of other versions.
struct Other {
    std::vector<std::uint8_t> values;
    friend bool operator==(const Other&, const Other&) = default;
};

using Body = std::variant<Command, SetTime, SetSetup, SetOlderSetup, SetSoundSpeed, Response, Refusal,
                          TimeResponse, SetupResponse, SystemResponse, FeaturesResponse, TestsResponse,
                          ComponentsResponse, Data, Other>;

struct Packet {
    Kind kind = Kind::command;
    Body body;
    friend bool operator==(const Packet&, const Packet&) = default;
};

}  // namespace echoloop::wayfinder
