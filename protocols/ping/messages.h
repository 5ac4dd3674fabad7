// The messages of the Blue Robotics Ping protocol as plain structs. No wire code: layouts.h says how they
// stand on the line. Names are those of the published definitions; angles are gradians, 400 a circle.
#pragma once

#include <cstdint>
#include <variant>
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

// Common messages

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

// Ping1D, Ping2

/// New id of a Ping1D.
struct Ping1dSetDeviceId {
    std::uint8_t device_id = 0;  ///< 1 to 254

    friend bool operator==(const Ping1dSetDeviceId&, const Ping1dSetDeviceId&) = default;
};
/// Scan range; not in automatic mode.
struct SetRange {
    std::uint32_t scan_start = 0;   ///< mm
    std::uint32_t scan_length = 0;  ///< mm; at least 1000

    friend bool operator==(const SetRange&, const SetRange&) = default;
};
/// For distances.
struct SetSpeedOfSound {
    std::uint32_t speed_of_sound = 0;  ///< mm/s

    friend bool operator==(const SetSpeedOfSound&, const SetSpeedOfSound&) = default;
};
/// Automatic or manual range and gain.
struct SetModeAuto {
    std::uint8_t mode_auto = 0;  ///< 1 automatic, 0 manual

    friend bool operator==(const SetModeAuto&, const SetModeAuto&) = default;
};
/// Time between pings.
struct SetPingInterval {
    std::uint16_t ping_interval = 0;  ///< ms

    friend bool operator==(const SetPingInterval&, const SetPingInterval&) = default;
};
/// Receiver gain.
struct SetGainSetting {
    std::uint8_t gain_setting = 0;  ///< 0 to 6: 0.6, 1.8, 5.5, 12.9, 30.2, 66.1, 144

    friend bool operator==(const SetGainSetting&, const SetGainSetting&) = default;
};
/// Pings on or off.
struct SetPingEnable {
    std::uint8_t ping_enabled = 0;

    friend bool operator==(const SetPingEnable&, const SetPingEnable&) = default;
};
/// Form of the profile, open firmware only.
struct SetOssProfileConfiguration {
    std::uint16_t number_of_points = 0;
    std::uint8_t normalization_enabled = 0;
    std::uint8_t enhance_enabled = 0;

    friend bool operator==(const SetOssProfileConfiguration&, const SetOssProfileConfiguration&) = default;
};
/// Restart in the boot loader.
struct GotoBootloader {
    friend bool operator==(const GotoBootloader&, const GotoBootloader&) = default;
};
/// Of a Ping1D.
struct FirmwareVersion {
    std::uint8_t device_type = 0;
    std::uint8_t device_model = 0;
    std::uint16_t firmware_major = 0;
    std::uint16_t firmware_minor = 0;

    friend bool operator==(const FirmwareVersion&, const FirmwareVersion&) = default;
};
/// Own id.
struct DeviceId {
    std::uint8_t device_id = 0;  ///< 1 to 254

    friend bool operator==(const DeviceId&, const DeviceId&) = default;
};
/// 5 V rail.
struct Voltage5 {
    std::uint16_t voltage_5 = 0;  ///< mV

    friend bool operator==(const Voltage5&, const Voltage5&) = default;
};
/// For distances.
struct SpeedOfSound {
    std::uint32_t speed_of_sound = 0;  ///< mm/s

    friend bool operator==(const SpeedOfSound&, const SpeedOfSound&) = default;
};
/// Scan range.
struct Range {
    std::uint32_t scan_start = 0;   ///< mm
    std::uint32_t scan_length = 0;  ///< mm

    friend bool operator==(const Range&, const Range&) = default;
};
/// Automatic or manual range and gain.
struct ModeAuto {
    std::uint8_t mode_auto = 0;  ///< 1 automatic, 0 manual

    friend bool operator==(const ModeAuto&, const ModeAuto&) = default;
};
/// Time between pings.
struct PingInterval {
    std::uint16_t ping_interval = 0;  ///< ms

    friend bool operator==(const PingInterval&, const PingInterval&) = default;
};
/// Receiver gain.
struct GainSetting {
    std::uint32_t gain_setting = 0;  ///< 0 to 6

    friend bool operator==(const GainSetting&, const GainSetting&) = default;
};
/// Length of a pulse.
struct TransmitDuration {
    std::uint16_t transmit_duration = 0;  ///< us

    friend bool operator==(const TransmitDuration&, const TransmitDuration&) = default;
};
/// Several settings at once.
struct GeneralInfo {
    std::uint16_t firmware_major = 0;
    std::uint16_t firmware_minor = 0;
    std::uint16_t voltage_5 = 0;      ///< mV
    std::uint16_t ping_interval = 0;  ///< ms
    std::uint8_t gain_setting = 0;    ///< 0 to 6
    std::uint8_t mode_auto = 0;       ///< 1 automatic, 0 manual

    friend bool operator==(const GeneralInfo&, const GeneralInfo&) = default;
};
/// Distance and confidence.
struct DistanceSimple {
    std::uint32_t distance = 0;   ///< mm; to the strongest return
    std::uint8_t confidence = 0;  ///< %; of the distance

    friend bool operator==(const DistanceSimple&, const DistanceSimple&) = default;
};
/// Distance and settings of its ping.
struct Distance {
    std::uint32_t distance = 0;           ///< mm; to the strongest return
    std::uint16_t confidence = 0;         ///< %; of the distance
    std::uint16_t transmit_duration = 0;  ///< us
    std::uint32_t ping_number = 0;        ///< since power-up
    std::uint32_t scan_start = 0;         ///< mm; start of the scan
    std::uint32_t scan_length = 0;        ///< mm; length of the scan
    std::uint32_t gain_setting = 0;       ///< 0 to 6

    friend bool operator==(const Distance&, const Distance&) = default;
};
/// Inside the processor.
struct ProcessorTemperature {
    std::uint16_t processor_temperature = 0;  ///< 0.01 degC

    friend bool operator==(const ProcessorTemperature&, const ProcessorTemperature&) = default;
};
/// On the board.
struct PcbTemperature {
    std::uint16_t pcb_temperature = 0;  ///< 0.01 degC

    friend bool operator==(const PcbTemperature&, const PcbTemperature&) = default;
};
/// Pings on or off.
struct PingEnable {
    std::uint8_t ping_enabled = 0;

    friend bool operator==(const PingEnable&, const PingEnable&) = default;
};
/// Distance, settings and the echo.
struct Profile {
    std::uint32_t distance = 0;              ///< mm; to the strongest return
    std::uint16_t confidence = 0;            ///< %; of the distance
    std::uint16_t transmit_duration = 0;     ///< us
    std::uint32_t ping_number = 0;           ///< since power-up
    std::uint32_t scan_start = 0;            ///< mm; start of the scan
    std::uint32_t scan_length = 0;           ///< mm; length of the scan
    std::uint32_t gain_setting = 0;          ///< 0 to 6
    std::vector<std::uint8_t> profile_data;  ///< echo strength, nearest first

    friend bool operator==(const Profile&, const Profile&) = default;
};
/// Form of the profile, open firmware only.
struct OssProfileConfiguration {
    std::uint16_t number_of_points = 0;
    std::uint8_t normalization_enabled = 0;
    std::uint8_t enhance_enabled = 0;

    friend bool operator==(const OssProfileConfiguration&, const OssProfileConfiguration&) = default;
};
/// Send a message after every ping.
struct ContinuousStart {
    std::uint16_t id = 0;  ///< 1300, 1211 or 1212

    friend bool operator==(const ContinuousStart&, const ContinuousStart&) = default;
};
/// Send it no longer.
struct ContinuousStop {
    std::uint16_t id = 0;  ///< of ContinuousStart

    friend bool operator==(const ContinuousStop&, const ContinuousStop&) = default;
};

// Ping360

/// New id of a Ping360.
struct Ping360SetDeviceId {
    std::uint8_t id = 0;        ///< 1 to 254
    std::uint8_t reserved = 0;  ///< 0

    friend bool operator==(const Ping360SetDeviceId&, const Ping360SetDeviceId&) = default;
};
/// One ping and its settings.
struct DeviceData {
    std::uint8_t mode = 0;                 ///< 1; hosts also send 0
    std::uint8_t gain_setting = 0;         ///< 0 low, 1 normal, 2 high
    std::uint16_t angle = 0;               ///< grad; 0 to 399
    std::uint16_t transmit_duration = 0;   ///< us; 1 to 1000
    std::uint16_t sample_period = 0;       ///< 25 ns; two-way time of a sample, 80 to 40000
    std::uint16_t transmit_frequency = 0;  ///< kHz; 500 to 1000
    std::uint16_t number_of_samples = 0;   ///< 200 to 1200
    std::vector<std::uint8_t> data;        ///< echo strength, nearest first

    friend bool operator==(const DeviceData&, const DeviceData&) = default;
};
/// One ping of an automatic scan.
struct AutoDeviceData {
    std::uint8_t mode = 0;                 ///< 1; hosts also send 0
    std::uint8_t gain_setting = 0;         ///< 0 low, 1 normal, 2 high
    std::uint16_t angle = 0;               ///< grad; 0 to 399
    std::uint16_t transmit_duration = 0;   ///< us; 1 to 1000
    std::uint16_t sample_period = 0;       ///< 25 ns; two-way time of a sample, 80 to 40000
    std::uint16_t transmit_frequency = 0;  ///< kHz; 500 to 1000
    std::uint16_t start_angle = 0;         ///< grad
    std::uint16_t stop_angle = 0;          ///< grad
    std::uint8_t num_steps = 0;            ///< grad; between pings, 1 to 10
    std::uint8_t delay = 0;                ///< ms; between pings, 0 to 100
    std::uint16_t number_of_samples = 0;   ///< 200 to 1200
    std::vector<std::uint8_t> data;        ///< echo strength, nearest first

    friend bool operator==(const AutoDeviceData&, const AutoDeviceData&) = default;
};
/// Restart.
struct Reset {
    std::uint8_t bootloader = 0;  ///< 1: stay in the boot loader
    std::uint8_t reserved = 0;    ///< 0

    friend bool operator==(const Reset&, const Reset&) = default;
};
/// Turn, and ping once; answered by DeviceData.
struct Transducer {
    std::uint8_t mode = 0;                 ///< 1; hosts also send 0
    std::uint8_t gain_setting = 0;         ///< 0 low, 1 normal, 2 high
    std::uint16_t angle = 0;               ///< grad; 0 to 399; 400 is 0
    std::uint16_t transmit_duration = 0;   ///< us; 1 to 1000
    std::uint16_t sample_period = 0;       ///< 25 ns; two-way time of a sample, 80 to 40000
    std::uint16_t transmit_frequency = 0;  ///< kHz; 500 to 1000
    std::uint16_t number_of_samples = 0;   ///< 200 to 1200
    std::uint8_t transmit = 0;             ///< 0: turn only
    std::uint8_t reserved = 0;             ///< 0

    friend bool operator==(const Transducer&, const Transducer&) = default;
};
/// Scan by itself; answered by AutoDeviceData again and again.
struct AutoTransmit {
    std::uint8_t mode = 0;                 ///< 1; hosts also send 0
    std::uint8_t gain_setting = 0;         ///< 0 low, 1 normal, 2 high
    std::uint16_t transmit_duration = 0;   ///< us; 1 to 1000
    std::uint16_t sample_period = 0;       ///< 25 ns; two-way time of a sample, 80 to 40000
    std::uint16_t transmit_frequency = 0;  ///< kHz; 500 to 1000
    std::uint16_t number_of_samples = 0;   ///< 200 to 1200
    std::uint16_t start_angle = 0;         ///< grad
    std::uint16_t stop_angle = 0;          ///< grad
    std::uint8_t num_steps = 0;            ///< grad; between pings, 1 to 10
    std::uint8_t delay = 0;                ///< ms; between pings, 0 to 100

    friend bool operator==(const AutoTransmit&, const AutoTransmit&) = default;
};
/// Motor current off; ends an automatic scan.
struct MotorOff {
    friend bool operator==(const MotorOff&, const MotorOff&) = default;
};

using Message =
    std::variant<Ack, Nack, AsciiText, DeviceInformation, ProtocolVersion, GeneralRequest, SetDeviceId,
                 Ping1dSetDeviceId, SetRange, SetSpeedOfSound, SetModeAuto, SetPingInterval, SetGainSetting,
                 SetPingEnable, SetOssProfileConfiguration, GotoBootloader, FirmwareVersion, DeviceId,
                 Voltage5, SpeedOfSound, Range, ModeAuto, PingInterval, GainSetting, TransmitDuration,
                 GeneralInfo, DistanceSimple, Distance, ProcessorTemperature, PcbTemperature, PingEnable,
                 Profile, OssProfileConfiguration, ContinuousStart, ContinuousStop, Ping360SetDeviceId,
                 DeviceData, AutoDeviceData, Reset, Transducer, AutoTransmit, MotorOff>;

}  // namespace echoloop::ping
