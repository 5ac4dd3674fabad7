// The field tables of the Omniscan 450. Tables only.
#pragma once

#include "protocols/cerulean/layouts.h"
#include "protocols/cerulean/omniscan_messages.h"

namespace echoloop::cerulean::omniscan {

constexpr auto wire_layout(Tag<OsPingParams>) {
    using M = OsPingParams;
    return make_layout<M>(
        payload_of("OsPingParams", "starts and stops the pings of an Omniscan 450"),
        field(&M::start_mm, "start_mm", "mm", ""),
        field(&M::length_mm, "length_mm", "mm", "the profile ends at start plus length"),
        field(&M::msec_per_ping, "msec_per_ping", "ms", "0: as fast as the range allows"),
        field(&M::reserved_1, "reserved_1", "", "0"), field(&M::reserved_2, "reserved_2", "", "0"),
        field(&M::pulse_len_percent, "pulse_len_percent", "", "fraction of a ping's time; 0.002 is typical"),
        field(&M::filter_duration_percent, "filter_duration_percent", "",
              "fraction of a ping's time; 0.0015 is typical"),
        field(&M::gain_index, "gain_index", "", "-1 automatic, 0 to 7"),
        field(&M::num_results, "num_results", "", "200 to 1200"),
        field(&M::enable, "enable", "", "0: no pings"),
        rest(&M::reserved_3, {3, 1}, "reserved_3", "",
             "zeros; 1 byte from hosts that follow the maker's manual"));
}
constexpr auto wire_layout(Tag<OsMonoProfile>) {
    using M = OsMonoProfile;
    return make_layout<M>(
        payload_of("OsMonoProfile", "one ping of an Omniscan 450"),
        field(&M::ping_number, "ping_number", "", "since power-up"),
        field(&M::start_mm, "start_mm", "mm", ""),
        field(&M::length_mm, "length_mm", "mm", "the profile ends at start plus length"),
        field(&M::timestamp_ms, "timestamp_ms", "ms", "since power-up, of the transmission"),
        field(&M::ping_hz, "ping_hz", "Hz", "of the sound"),
        field(&M::gain_index, "gain_index", "", "0 to 7, the one in use"),
        count<std::uint16_t>("results", 0, "num_results", "", "number of results"),
        field(&M::sos_dmps, "sos_dmps", "dm/s", ""), field(&M::channel_number, "channel_number", "", ""),
        field(&M::reserved, "reserved", "", "0"),
        field(&M::pulse_duration_sec, "pulse_duration_sec", "s", ""),
        field(&M::analog_gain, "analog_gain", "", "factor"),
        field(&M::max_pwr_db, "max_pwr_db", "dB", "of a result of 65535"),
        field(&M::min_pwr_db, "min_pwr_db", "dB", "of a result of 0"),
        field(&M::transducer_heading_deg, "transducer_heading_deg", "deg", ""),
        field(&M::vehicle_heading_deg, "vehicle_heading_deg", "deg", ""),
        counted(&M::pwr_results, "results", "pwr_results", "",
                "strength in even steps of dB, nearest first"));
}

}  // namespace echoloop::cerulean::omniscan
