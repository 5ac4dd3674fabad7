// The messages of the Ping1D and Ping2 as plain structs. No wire code: layouts.h says how they stand on the
// line.
#pragma once

#include "protocols/ping/common_messages.h"

namespace echoloop::ping {

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

}  // namespace echoloop::ping
