// The message ids of Cerulean sonars and their names. Names only; the frame itself is that of protocols/ping.
#pragma once

#include <cstdint>

#include "protocols/wire/field.h"

namespace echoloop::cerulean {

/// The u16 at byte 4 of a frame. 1200 to 1213 have other meanings in a Blue Robotics Ping1D.
enum class Id : std::uint16_t {
    ack = 1,
    nack = 2,
    ascii_text = 3,
    device_information = 4,
    protocol_version = 5,
    general_request = 6,
    json_wrapper = 10,
    utc_request = 14,
    utc_response = 15,
    set_net_info = 17,
    general_speed_of_sound = 116,
    water_stats = 118,
    attitude_report = 504,
    set_speed_of_sound = 1002,
    s500_ping_params = 1015,
    fw_version = 1200,
    speed_of_sound = 1203,
    range = 1204,
    ping_rate = 1206,
    gain_index = 1207,
    altitude = 1211,
    processor_temperature = 1213,
    distance2 = 1223,
    profile6 = 1308,
    os_ping_params = 2197,
    os_mono_profile = 2198,
    yz_point_data = 3011,
    atof_point_data = 3012,
    surveyor_ping_parameters = 3023,
};

inline constexpr wire::NamedValue id_names[] = {
    {1, "Ack"},
    {2, "Nack"},
    {3, "AsciiText"},
    {4, "DeviceInformation"},
    {5, "ProtocolVersion"},
    {6, "GeneralRequest"},
    {10, "JsonWrapper"},
    {14, "UtcRequest"},
    {15, "UtcResponse"},
    {17, "SetNetInfo"},
    {116, "GeneralSpeedOfSound"},
    {118, "WaterStats"},
    {504, "AttitudeReport"},
    {1002, "SetSpeedOfSound"},
    {1015, "S500PingParams"},
    {1200, "FwVersion"},
    {1203, "SpeedOfSound"},
    {1204, "Range"},
    {1206, "PingRate"},
    {1207, "GainIndex"},
    {1211, "Altitude"},
    {1213, "ProcessorTemperature"},
    {1223, "Distance2"},
    {1308, "Profile6"},
    {2197, "OsPingParams"},
    {2198, "OsMonoProfile"},
    {3011, "YzPointData"},
    {3012, "AtofPointData"},
    {3023, "SurveyorPingParameters"},
};

}  // namespace echoloop::cerulean

template <>
inline constexpr std::span<const echoloop::wire::NamedValue>
    echoloop::wire::value_names<echoloop::cerulean::Id> = echoloop::cerulean::id_names;
