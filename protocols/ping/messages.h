// All messages of the Blue Robotics Ping protocol. No wire code: layouts.h says how they stand on the line.
#pragma once

#include <variant>

#include "protocols/ping/ping1d_messages.h"
#include "protocols/ping/ping360_messages.h"

namespace echoloop::ping {

using Message =
    std::variant<Ack, Nack, AsciiText, DeviceInformation, ProtocolVersion, GeneralRequest, SetDeviceId,
                 Ping1dSetDeviceId, SetRange, SetSpeedOfSound, SetModeAuto, SetPingInterval, SetGainSetting,
                 SetPingEnable, SetOssProfileConfiguration, GotoBootloader, FirmwareVersion, DeviceId,
                 Voltage5, SpeedOfSound, Range, ModeAuto, PingInterval, GainSetting, TransmitDuration,
                 GeneralInfo, DistanceSimple, Distance, ProcessorTemperature, PcbTemperature, PingEnable,
                 Profile, OssProfileConfiguration, ContinuousStart, ContinuousStop, Ping360SetDeviceId,
                 DeviceData, AutoDeviceData, Reset, Transducer, AutoTransmit, MotorOff>;

}  // namespace echoloop::ping
