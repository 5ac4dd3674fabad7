// The field tables of the S500 echosounder. Tables only.
#pragma once

#include "protocols/cerulean/layouts.h"
#include "protocols/cerulean/s500_messages.h"

namespace echoloop::cerulean::s500 {

constexpr auto wire_layout(Tag<SetPingParams>) {
    using M = SetPingParams;
    return make_layout<M>(
        payload_of("S500PingParams", "starts and stops the pings of an S500"),
        field(&M::start_mm, "start_mm", "mm", ""), field(&M::length_mm, "length_mm", "mm", "0: automatic"),
        field(&M::gain_index, "gain_index", "", "-1 automatic, 0 to 13"),
        field(&M::msec_per_ping, "msec_per_ping", "ms", "at least; -1: a single ping"),
        field(&M::pulse_len_usec, "pulse_len_usec", "us", "the device chooses its own"),
        field(&M::report_id, "report_id", "", "1223 or 1308 after every ping; 0: no pings"),
        field(&M::reserved, "reserved", "", "0"), field(&M::chirp, "chirp", "", "1 chirp, 0 one tone"),
        field(&M::decimation, "decimation", "", "of a chirp's results; 0: automatic"));
}
constexpr auto wire_layout(Tag<FwVersion>) {
    using M = FwVersion;
    return make_layout<M>(
        payload_of("FwVersion", "of an S500"), field(&M::device_type, "device_type", "", ""),
        field(&M::device_model, "device_model", "", ""), field(&M::version_major, "version_major", "", ""),
        field(&M::version_minor, "version_minor", "", ""));
}
constexpr auto wire_layout(Tag<SpeedOfSound>) {
    return make_layout<SpeedOfSound>(payload_of("SpeedOfSound", "of an S500"),
                                     field(&SpeedOfSound::sos_mm_per_sec, "sos_mm_per_sec", "mm/s", ""));
}
constexpr auto wire_layout(Tag<Range>) {
    return make_layout<Range>(payload_of("Range", "of an S500"),
                              field(&Range::start_mm, "start_mm", "mm", ""),
                              field(&Range::length_mm, "length_mm", "mm", ""));
}
constexpr auto wire_layout(Tag<PingRate>) {
    return make_layout<PingRate>(payload_of("PingRate", "of an S500"),
                                 field(&PingRate::msec_per_ping, "msec_per_ping", "ms", "at least"));
}
constexpr auto wire_layout(Tag<GainIndex>) {
    return make_layout<GainIndex>(payload_of("GainIndex", "of an S500"),
                                  field(&GainIndex::gain_index, "gain_index", "", "0 to 13"));
}
constexpr auto wire_layout(Tag<Altitude>) {
    return make_layout<Altitude>(payload_of("Altitude", "distance of an S500's last ping"),
                                 field(&Altitude::altitude_mm, "altitude_mm", "mm", ""),
                                 field(&Altitude::quality, "quality", "%", ""));
}
constexpr auto wire_layout(Tag<ProcessorTemperature>) {
    using M = ProcessorTemperature;
    return make_layout<M>(payload_of("ProcessorTemperature", "of an S500"),
                          field(&M::centi_degC, "centi_degC", "0.01 degC", ""));
}
constexpr auto wire_layout(Tag<Distance2>) {
    using M = Distance2;
    return make_layout<M>(payload_of("Distance2", "distance of one ping of an S500, and its average"),
                          field(&M::ping_distance_mm, "ping_distance_mm", "mm", ""),
                          field(&M::averaged_distance_mm, "averaged_distance_mm", "mm", "of 20 pings"),
                          field(&M::reserved, "reserved", "", "0"),
                          field(&M::ping_confidence, "ping_confidence", "%", ""),
                          field(&M::average_distance_confidence, "average_distance_confidence", "%", ""),
                          field(&M::timestamp, "timestamp", "ms", "since power-up"));
}
constexpr auto wire_layout(Tag<Profile6>) {
    using M = Profile6;
    return make_layout<M>(
        payload_of("Profile6", "one ping of an S500"),
        field(&M::ping_number, "ping_number", "", "since power-up"),
        field(&M::start_mm, "start_mm", "mm", ""), field(&M::length_mm, "length_mm", "mm", ""),
        field(&M::start_ping_hz, "start_ping_hz", "Hz", "where the chirp begins"),
        field(&M::end_ping_hz, "end_ping_hz", "Hz", "where the chirp ends"),
        field(&M::adc_sample_hz, "adc_sample_hz", "Hz", ""),
        field(&M::timestamp_msec, "timestamp_msec", "ms", "since power-up"),
        field(&M::spare2, "spare2", "", "0"), field(&M::pulse_duration_sec, "pulse_duration_sec", "s", ""),
        field(&M::analog_gain, "analog_gain", "", "factor"),
        field(&M::max_pwr_db, "max_pwr_db", "dB", "of a result of 65535"),
        field(&M::min_pwr_db, "min_pwr_db", "dB", "of a result of 0"),
        field(&M::this_ping_depth_m, "this_ping_depth_m", "m", ""),
        field(&M::smooth_depth_m, "smooth_depth_m", "m", ""), field(&M::fspare2, "fspare2", "", "0"),
        field(&M::ping_depth_measurement_confidence, "ping_depth_measurement_confidence", "%", ""),
        field(&M::gain_index, "gain_index", "", "the one in use"),
        field(&M::decimation, "decimation", "", "the one in use; 0 for one tone"),
        field(&M::smoothed_depth_measurement_confidence, "smoothed_depth_measurement_confidence", "%", ""),
        count<std::uint16_t>("results", 0, "num_results", "", "number of results"),
        counted(&M::pwr_results, "results", "pwr_results", "",
                "strength in even steps of dB, nearest first"));
}

}  // namespace echoloop::cerulean::s500
