// Header, frame and the common messages of the Blue Robotics Ping protocol as plain structs. No wire code:
// layouts.h says how they stand on the line. Names are those of the published definitions; angles are
// gradians, 400 a circle.
#pragma once

#include <cstdint>
#include <vector>

namespace echoloop::ping {

/// The u16 at byte 4 of a frame.
enum class Id : std::uint16_t {
    ack = 1,
    nack = 2,
    ascii_text = 3,
    device_information = 4,
    protocol_version = 5,
    general_request = 6,
    set_device_id = 100,
    ping1d_set_device_id = 1000,
    set_range = 1001,
    set_speed_of_sound = 1002,
    set_mode_auto = 1003,
    set_ping_interval = 1004,
    set_gain_setting = 1005,
    set_ping_enable = 1006,
    set_oss_profile_configuration = 1007,
    goto_bootloader = 1100,
    firmware_version = 1200,
    device_id = 1201,
    voltage5 = 1202,
    speed_of_sound = 1203,
    range = 1204,
    mode_auto = 1205,
    ping_interval = 1206,
    gain_setting = 1207,
    transmit_duration = 1208,
    general_info = 1210,
    distance_simple = 1211,
    distance = 1212,
    processor_temperature = 1213,
    pcb_temperature = 1214,
    ping_enable = 1215,
    profile = 1300,
    oss_profile_configuration = 1301,
    continuous_start = 1400,
    continuous_stop = 1401,
    ping360_set_device_id = 2000,
    device_data = 2300,
    auto_device_data = 2301,
    reset = 2600,
    transducer = 2601,
    auto_transmit = 2602,
    motor_off = 2903,
};

struct Header {
    Id id{};
    std::uint8_t source = 0;       ///< 0 for hosts, a device's own id otherwise
    std::uint8_t destination = 0;  ///< 0 from most hosts, and from devices

    friend bool operator==(const Header&, const Header&) = default;
};

/// One frame from 'B' to the checksum.
struct Frame {
    Header header;
    std::vector<std::uint8_t> payload;  ///< at most 65535 bytes
    std::uint16_t checksum = 0;         ///< sum of all bytes before it, modulo 65536

    friend bool operator==(const Frame&, const Frame&) = default;
};

/// The message was obeyed.
struct Ack {
    std::uint16_t acked_id = 0;  ///< id of that message

    friend bool operator==(const Ack&, const Ack&) = default;
};
/// The message was refused.
struct Nack {
    std::uint16_t nacked_id = 0;     ///< id of that message
    std::vector<std::uint8_t> text;  ///< why; not always terminated

    friend bool operator==(const Nack&, const Nack&) = default;
};
/// Text for people.
struct AsciiText {
    std::vector<std::uint8_t> text;

    friend bool operator==(const AsciiText&, const AsciiText&) = default;
};
/// What is at the other end.
struct DeviceInformation {
    std::uint8_t device_type = 0;      ///< 0 unknown, 1 Ping1D, 2 Ping360
    std::uint8_t device_revision = 0;  ///< hardware
    std::uint8_t firmware_major = 0;
    std::uint8_t firmware_minor = 0;
    std::uint8_t firmware_patch = 0;
    std::uint8_t reserved = 0;  ///< 0

    friend bool operator==(const DeviceInformation&, const DeviceInformation&) = default;
};
/// Version of the message set.
struct ProtocolVersion {
    std::uint8_t major = 0;
    std::uint8_t minor = 0;
    std::uint8_t patch = 0;
    std::uint8_t reserved = 0;  ///< 0

    friend bool operator==(const ProtocolVersion&, const ProtocolVersion&) = default;
};
/// Asks for a message.
struct GeneralRequest {
    std::uint16_t requested_id = 0;  ///< id of that message

    friend bool operator==(const GeneralRequest&, const GeneralRequest&) = default;
};
/// New id of any device.
struct SetDeviceId {
    std::uint8_t device_id = 0;  ///< 1 to 254

    friend bool operator==(const SetDeviceId&, const SetDeviceId&) = default;
};

}  // namespace echoloop::ping
