// Names of the Ping protocol's message ids. Names only.
#pragma once

#include "protocols/ping/messages.h"
#include "protocols/wire/field.h"

namespace echoloop::ping {

inline constexpr wire::NamedValue id_names[] = {
    {1, "Ack"},
    {2, "Nack"},
    {3, "AsciiText"},
    {4, "DeviceInformation"},
    {5, "ProtocolVersion"},
    {6, "GeneralRequest"},
    {100, "SetDeviceId"},
    {1000, "Ping1dSetDeviceId"},
    {1001, "SetRange"},
    {1002, "SetSpeedOfSound"},
    {1003, "SetModeAuto"},
    {1004, "SetPingInterval"},
    {1005, "SetGainSetting"},
    {1006, "SetPingEnable"},
    {1007, "SetOssProfileConfiguration"},
    {1100, "GotoBootloader"},
    {1200, "FirmwareVersion"},
    {1201, "DeviceId"},
    {1202, "Voltage5"},
    {1203, "SpeedOfSound"},
    {1204, "Range"},
    {1205, "ModeAuto"},
    {1206, "PingInterval"},
    {1207, "GainSetting"},
    {1208, "TransmitDuration"},
    {1210, "GeneralInfo"},
    {1211, "DistanceSimple"},
    {1212, "Distance"},
    {1213, "ProcessorTemperature"},
    {1214, "PcbTemperature"},
    {1215, "PingEnable"},
    {1300, "Profile"},
    {1301, "OssProfileConfiguration"},
    {1400, "ContinuousStart"},
    {1401, "ContinuousStop"},
    {2000, "Ping360SetDeviceId"},
    {2300, "DeviceData"},
    {2301, "AutoDeviceData"},
    {2600, "Reset"},
    {2601, "Transducer"},
    {2602, "AutoTransmit"},
    {2903, "MotorOff"},
};

}  // namespace echoloop::ping

template <>
inline constexpr std::span<const echoloop::wire::NamedValue> echoloop::wire::value_names<echoloop::ping::Id> =
    echoloop::ping::id_names;
