// The field tables of the Surveyor 240-16. Tables only.
#pragma once

#include "protocols/cerulean/layouts.h"
#include "protocols/cerulean/surveyor_messages.h"

namespace echoloop::cerulean::surveyor {

constexpr auto wire_layout(Tag<UtcRequest>) {
    return make_layout<UtcRequest>(payload_of("UtcRequest", "the device asks for the time of day"));
}
constexpr auto wire_layout(Tag<UtcResponse>) {
    return make_layout<UtcResponse>(payload_of("UtcResponse", "the time of day from the host"),
                                    field(&UtcResponse::utc_msec, "utc_msec", "ms", "since 1970"),
                                    field(&UtcResponse::accuracy_msec, "accuracy_msec", "ms", ""));
}
constexpr auto wire_layout(Tag<SetNetInfo>) {
    return make_layout<SetNetInfo>(
        payload_of("SetNetInfo", "a time server for the device; first octets in the lowest bytes"),
        field(&SetNetInfo::ntp_ip_address, "ntp_ip_address", "", "time server").hex(),
        field(&SetNetInfo::subnet_mask, "subnet_mask", "", "").hex(),
        field(&SetNetInfo::gateway_ip, "gateway_ip", "", "0: none is needed").hex());
}
constexpr auto wire_layout(Tag<WaterStats>) {
    return make_layout<WaterStats>(payload_of("WaterStats", "what the sensors in the water say"),
                                   field(&WaterStats::temperature, "temperature", "degC", ""),
                                   field(&WaterStats::pressure, "pressure", "bar", ""));
}
constexpr auto wire_layout(Tag<AttitudeReport>) {
    return make_layout<AttitudeReport>(
        payload_of("AttitudeReport", "how the head hangs in the water"),
        field(&AttitudeReport::up_vec, "up_vec", "",
              "the world's up direction: x forward, y port, z up of the head"),
        field(&AttitudeReport::reserved, "reserved", "", "for a magnetic field"),
        field(&AttitudeReport::utc_msec, "utc_msec", "ms", "since 1970; 0: not known"),
        field(&AttitudeReport::pwr_up_msec, "pwr_up_msec", "ms", "since power-up"));
}
constexpr auto wire_layout(Tag<YzPoint>) {
    return make_layout<YzPoint>({"YzPoint", "a sounding in the head's plane", ByteOrder::little},
                                field(&YzPoint::y, "y", "m", "positive to port"),
                                field(&YzPoint::z, "z", "m", "positive upwards, so negative"));
}
constexpr auto wire_layout(Tag<YzPointData>) {
    return make_layout<YzPointData>(
        payload_of("YzPointData", "the soundings of one ping as places"),
        field(&YzPointData::timestamp_msec, "timestamp_msec", "ms", "since power-up"),
        field(&YzPointData::ping_number, "ping_number", "", "since power-up"),
        field(&YzPointData::sos_mps, "sos_mps", "m/s", "speed of sound"),
        field(&YzPointData::up_vec, "up_vec", "", "as in AttitudeReport"),
        field(&YzPointData::mag_vec, "mag_vec", "", "for a magnetic field"),
        field(&YzPointData::reserved, "reserved", "", ""),
        field(&YzPointData::water_degC, "water_degC", "degC", "-1000: no sensor"),
        field(&YzPointData::water_bar, "water_bar", "bar", "-1000: no sensor"),
        field(&YzPointData::heave_m, "heave_m", "m", ""),
        field(&YzPointData::start_m, "start_m", "m", "nearest range listened to"),
        field(&YzPointData::end_m, "end_m", "m", "farthest range listened to"),
        field(&YzPointData::unused, "unused", "", "0"),
        count<std::uint16_t>("points", 0, "num_points", "", "number of points"),
        counted(&YzPointData::yz_point_data, "points", "yz_point_data", "", "port first"));
}
constexpr auto wire_layout(Tag<AtofPoint>) {
    return make_layout<AtofPoint>(
        {"AtofPoint", "a sounding as it is measured", ByteOrder::little},
        field(&AtofPoint::angle, "angle", "rad", "from straight down, positive to port"),
        field(&AtofPoint::tof, "tof", "s", "two-way time of flight"),
        field(&AtofPoint::reserved, "reserved", "", "0"));
}
constexpr auto wire_layout(Tag<AtofPointData>) {
    return make_layout<AtofPointData>(
        payload_of("AtofPointData", "the soundings of one ping as angles and times of flight"),
        field(&AtofPointData::pwr_up_msec, "pwr_up_msec", "ms", "since power-up, of the transmission"),
        field(&AtofPointData::utc_msec, "utc_msec", "ms", "since 1970; 0: not known"),
        field(&AtofPointData::listening_sec, "listening_sec", "s",
              "from the transmission to the last range step"),
        field(&AtofPointData::sos_mps, "sos_mps", "m/s", "speed of sound"),
        field(&AtofPointData::ping_number, "ping_number", "", "since power-up"),
        field(&AtofPointData::ping_hz, "ping_hz", "Hz", ""),
        field(&AtofPointData::pulse_sec, "pulse_sec", "s", "pulse length"),
        field(&AtofPointData::flags, "flags", "", "0"),
        count<std::uint16_t>("points", 0, "num_points", "", "number of points"),
        field(&AtofPointData::reserved, "reserved", "", "0"),
        counted(&AtofPointData::atof_point_data, "points", "atof_point_data", "", "port first"));
}
constexpr auto wire_layout(Tag<PingParameters>) {
    using M = PingParameters;
    return make_layout<M>(
        payload_of("SurveyorPingParameters", "how to ping from now on"),
        field(&M::start_mm, "start_mm", "mm", "at least 5 % of end_mm"),
        field(&M::end_mm, "end_mm", "mm", "0: follow the bottom"),
        field(&M::sos_mps, "sos_mps", "m/s", "speed of sound"),
        field(&M::gain_index, "gain_index", "", "-1 automatic, 0 to 100"),
        field(&M::msec_per_ping, "msec_per_ping", "ms", "upper limit of the ping rate"),
        field(&M::deprecated, "deprecated", "", "0"),
        field(&M::diagnostic_injected_signal, "diagnostic_injected_signal", "", "0"),
        field(&M::ping_enable, "ping_enable", "", "0: stop"),
        field(&M::enable_channel_data, "enable_channel_data", "", "0 or 1"),
        field(&M::reserved_for_raw_data, "reserved_for_raw_data", "", "0"),
        field(&M::enable_yz_point_data, "enable_yz_point_data", "", "0 or 1"),
        field(&M::enable_atof_data, "enable_atof_data", "", "0 or 1"),
        field(&M::target_ping_hz, "target_ping_hz", "Hz", "240000"),
        field(&M::n_range_steps, "n_range_steps", "", "200 to 800"), field(&M::reserved, "reserved", "", "0"),
        field(&M::pulse_len_steps, "pulse_len_steps", "steps", "pulse length; 1.5 is recommended"));
}

}  // namespace echoloop::cerulean::surveyor
