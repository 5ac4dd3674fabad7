// The field tables of the messages of a Ping1D. Tables only.
#pragma once

#include "protocols/ping/layouts.h"

namespace echoloop::ping {

using namespace wire;

constexpr auto wire_layout(Tag<Ping1dSetDeviceId>) {
    return make_layout<Ping1dSetDeviceId>(payload_of("Ping1dSetDeviceId", "new id of a Ping1D"),
                                          field(&Ping1dSetDeviceId::device_id, "device_id", "", "1 to 254"));
}
constexpr auto wire_layout(Tag<SetRange>) {
    return make_layout<SetRange>(payload_of("SetRange", "scan range; not in automatic mode"),
                                 field(&SetRange::scan_start, "scan_start", "mm", ""),
                                 field(&SetRange::scan_length, "scan_length", "mm", "at least 1000"));
}
constexpr auto wire_layout(Tag<SetSpeedOfSound>) {
    return make_layout<SetSpeedOfSound>(
        payload_of("SetSpeedOfSound", "for distances"),
        field(&SetSpeedOfSound::speed_of_sound, "speed_of_sound", "mm/s", ""));
}
constexpr auto wire_layout(Tag<SetModeAuto>) {
    return make_layout<SetModeAuto>(payload_of("SetModeAuto", "automatic or manual range and gain"),
                                    field(&SetModeAuto::mode_auto, "mode_auto", "", "1 automatic, 0 manual"));
}
constexpr auto wire_layout(Tag<SetPingInterval>) {
    return make_layout<SetPingInterval>(payload_of("SetPingInterval", "time between pings"),
                                        field(&SetPingInterval::ping_interval, "ping_interval", "ms", ""));
}
constexpr auto wire_layout(Tag<SetGainSetting>) {
    return make_layout<SetGainSetting>(payload_of("SetGainSetting", "receiver gain"),
                                       field(&SetGainSetting::gain_setting, "gain_setting", "",
                                             "0 to 6: 0.6, 1.8, 5.5, 12.9, 30.2, 66.1, 144"));
}
constexpr auto wire_layout(Tag<SetPingEnable>) {
    return make_layout<SetPingEnable>(payload_of("SetPingEnable", "pings on or off"),
                                      field(&SetPingEnable::ping_enabled, "ping_enabled", "", ""));
}
constexpr auto wire_layout(Tag<SetOssProfileConfiguration>) {
    return make_layout<SetOssProfileConfiguration>(
        payload_of("SetOssProfileConfiguration", "form of the profile, open firmware only"),
        field(&SetOssProfileConfiguration::number_of_points, "number_of_points", "", ""),
        field(&SetOssProfileConfiguration::normalization_enabled, "normalization_enabled", "", ""),
        field(&SetOssProfileConfiguration::enhance_enabled, "enhance_enabled", "", ""));
}
constexpr auto wire_layout(Tag<GotoBootloader>) {
    return make_layout<GotoBootloader>(payload_of("GotoBootloader", "restart in the boot loader"));
}
constexpr auto wire_layout(Tag<FirmwareVersion>) {
    return make_layout<FirmwareVersion>(payload_of("FirmwareVersion", "of a Ping1D"),
                                        field(&FirmwareVersion::device_type, "device_type", "", ""),
                                        field(&FirmwareVersion::device_model, "device_model", "", ""),
                                        field(&FirmwareVersion::firmware_major, "firmware_major", "", ""),
                                        field(&FirmwareVersion::firmware_minor, "firmware_minor", "", ""));
}
constexpr auto wire_layout(Tag<DeviceId>) {
    return make_layout<DeviceId>(payload_of("DeviceId", "own id"),
                                 field(&DeviceId::device_id, "device_id", "", "1 to 254"));
}
constexpr auto wire_layout(Tag<Voltage5>) {
    return make_layout<Voltage5>(payload_of("Voltage5", "5 V rail"),
                                 field(&Voltage5::voltage_5, "voltage_5", "mV", ""));
}
constexpr auto wire_layout(Tag<SpeedOfSound>) {
    return make_layout<SpeedOfSound>(payload_of("SpeedOfSound", "for distances"),
                                     field(&SpeedOfSound::speed_of_sound, "speed_of_sound", "mm/s", ""));
}
constexpr auto wire_layout(Tag<Range>) {
    return make_layout<Range>(payload_of("Range", "scan range"),
                              field(&Range::scan_start, "scan_start", "mm", ""),
                              field(&Range::scan_length, "scan_length", "mm", ""));
}
constexpr auto wire_layout(Tag<ModeAuto>) {
    return make_layout<ModeAuto>(payload_of("ModeAuto", "automatic or manual range and gain"),
                                 field(&ModeAuto::mode_auto, "mode_auto", "", "1 automatic, 0 manual"));
}
constexpr auto wire_layout(Tag<PingInterval>) {
    return make_layout<PingInterval>(payload_of("PingInterval", "time between pings"),
                                     field(&PingInterval::ping_interval, "ping_interval", "ms", ""));
}
constexpr auto wire_layout(Tag<GainSetting>) {
    return make_layout<GainSetting>(payload_of("GainSetting", "receiver gain"),
                                    field(&GainSetting::gain_setting, "gain_setting", "", "0 to 6"));
}
constexpr auto wire_layout(Tag<TransmitDuration>) {
    return make_layout<TransmitDuration>(
        payload_of("TransmitDuration", "length of a pulse"),
        field(&TransmitDuration::transmit_duration, "transmit_duration", "us", ""));
}
constexpr auto wire_layout(Tag<GeneralInfo>) {
    return make_layout<GeneralInfo>(payload_of("GeneralInfo", "several settings at once"),
                                    field(&GeneralInfo::firmware_major, "firmware_major", "", ""),
                                    field(&GeneralInfo::firmware_minor, "firmware_minor", "", ""),
                                    field(&GeneralInfo::voltage_5, "voltage_5", "mV", ""),
                                    field(&GeneralInfo::ping_interval, "ping_interval", "ms", ""),
                                    field(&GeneralInfo::gain_setting, "gain_setting", "", "0 to 6"),
                                    field(&GeneralInfo::mode_auto, "mode_auto", "", "1 automatic, 0 manual"));
}
constexpr auto wire_layout(Tag<DistanceSimple>) {
    return make_layout<DistanceSimple>(
        payload_of("DistanceSimple", "distance and confidence"),
        field(&DistanceSimple::distance, "distance", "mm", "to the strongest return"),
        field(&DistanceSimple::confidence, "confidence", "%", "of the distance"));
}
constexpr auto wire_layout(Tag<Distance>) {
    return make_layout<Distance>(payload_of("Distance", "distance and settings of its ping"),
                                 field(&Distance::distance, "distance", "mm", "to the strongest return"),
                                 field(&Distance::confidence, "confidence", "%", "of the distance"),
                                 field(&Distance::transmit_duration, "transmit_duration", "us", ""),
                                 field(&Distance::ping_number, "ping_number", "", "since power-up"),
                                 field(&Distance::scan_start, "scan_start", "mm", "start of the scan"),
                                 field(&Distance::scan_length, "scan_length", "mm", "length of the scan"),
                                 field(&Distance::gain_setting, "gain_setting", "", "0 to 6"));
}
constexpr auto wire_layout(Tag<ProcessorTemperature>) {
    return make_layout<ProcessorTemperature>(
        payload_of("ProcessorTemperature", "inside the processor"),
        field(&ProcessorTemperature::processor_temperature, "processor_temperature", "0.01 degC", ""));
}
constexpr auto wire_layout(Tag<PcbTemperature>) {
    return make_layout<PcbTemperature>(
        payload_of("PcbTemperature", "on the board"),
        field(&PcbTemperature::pcb_temperature, "pcb_temperature", "0.01 degC", ""));
}
constexpr auto wire_layout(Tag<PingEnable>) {
    return make_layout<PingEnable>(payload_of("PingEnable", "pings on or off"),
                                   field(&PingEnable::ping_enabled, "ping_enabled", "", ""));
}
constexpr auto wire_layout(Tag<Profile>) {
    return make_layout<Profile>(
        payload_of("Profile", "distance, settings and the echo"),
        field(&Profile::distance, "distance", "mm", "to the strongest return"),
        field(&Profile::confidence, "confidence", "%", "of the distance"),
        field(&Profile::transmit_duration, "transmit_duration", "us", ""),
        field(&Profile::ping_number, "ping_number", "", "since power-up"),
        field(&Profile::scan_start, "scan_start", "mm", "start of the scan"),
        field(&Profile::scan_length, "scan_length", "mm", "length of the scan"),
        field(&Profile::gain_setting, "gain_setting", "", "0 to 6"),
        count<std::uint16_t>("samples", 0, "profile_data_length", "B", "bytes of profile_data"),
        counted(&Profile::profile_data, "samples", "profile_data", "", "echo strength, nearest first"));
}
constexpr auto wire_layout(Tag<OssProfileConfiguration>) {
    return make_layout<OssProfileConfiguration>(
        payload_of("OssProfileConfiguration", "form of the profile, open firmware only"),
        field(&OssProfileConfiguration::number_of_points, "number_of_points", "", ""),
        field(&OssProfileConfiguration::normalization_enabled, "normalization_enabled", "", ""),
        field(&OssProfileConfiguration::enhance_enabled, "enhance_enabled", "", ""));
}
constexpr auto wire_layout(Tag<ContinuousStart>) {
    return make_layout<ContinuousStart>(payload_of("ContinuousStart", "send a message after every ping"),
                                        field(&ContinuousStart::id, "id", "", "1300, 1211 or 1212"));
}
constexpr auto wire_layout(Tag<ContinuousStop>) {
    return make_layout<ContinuousStop>(payload_of("ContinuousStop", "send it no longer"),
                                       field(&ContinuousStop::id, "id", "", "of ContinuousStart"));
}

}  // namespace echoloop::ping
