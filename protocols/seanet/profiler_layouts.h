// The field tables of a profiler's messages (node 20), which share ids with those of an imaging sonar. Tables
// only.
#pragma once

#include "protocols/seanet/command_layouts.h"

namespace echoloop::seanet {

constexpr auto wire_layout(Tag<ProfilerParameters>) {
    using P = ProfilerParameters;
    return make_layout<P>(
        {"ProfilerParameters", "settings of a profiler", ByteOrder::little, 14},
        field(&P::hd_ctrl, "hd_ctrl", "", "control word").bits(profiler_ctrl_names),
        field(&P::hd_type, "hd_type", "", "5 profiler").hex(),
        field(&P::tx_n1, "tx_n1", "32 MHz / 2^32", "transmit frequency, channel 1"),
        field(&P::tx_n2, "tx_n2", "32 MHz / 2^32", "transmit frequency, channel 2"),
        field(&P::rx_n1, "rx_n1", "32 MHz / 2^32", "transmit frequency + 455 kHz, channel 1"),
        field(&P::rx_n2, "rx_n2", "32 MHz / 2^32", "transmit frequency + 455 kHz, channel 2"),
        field(&P::tx_pulse, "tx_pulse", "us", "pulse length"),
        field(&P::range_scale, "range_scale", "0.1 unit",
              "bits 0-13 range, bits 14-15 m, ft, fathom, yd; informational"),
        field(&P::left_limit, "left_limit", "1/16 grad", "begin of a clockwise pass"),
        field(&P::right_limit, "right_limit", "1/16 grad", "its end"),
        field(&P::ad_threshold, "ad_threshold", "80/255 dB", "weaker echoes do not count"),
        field(&P::filt_gain, "filt_gain", "", "not known"),
        field(&P::agc_max, "agc_max", "80/255 dB", "gain, or the most that adaptive gain may reach"),
        field(&P::agc_set_point, "agc_set_point", "80/255 dB", "what adaptive gain aims at"),
        field(&P::slope1, "slope1", "", "gain slope, channel 1"),
        field(&P::slope2, "slope2", "", "gain slope, channel 2"),
        field(&P::motor_time, "motor_time", "10 us", "per motor step"),
        field(&P::step_size, "step_size", "1/16 grad", "angle between pings"),
        field(&P::scan_time, "scan_time", "100 us", "how long a ping listens"),
        field(&P::prf_spl, "prf_spl", "", "0"), field(&P::prf_ctl2, "prf_ctl2", "", "1: the strongest echo"),
        field(&P::lockout, "lockout", "us", "nothing is heard before"),
        field(&P::minor_axis_direction, "minor_axis_direction", "1/16 grad", "1600 usual"),
        field(&P::major_axis_pan, "major_axis_pan", "", "1 usual"), field(&P::ctl2, "ctl2", "", "0").hex(),
        field(&P::scan_z, "scan_z", "", "0"));
}

constexpr auto wire_layout(Tag<ProfilerGains>) {
    using G = ProfilerGains;
    return make_layout<G>({"ProfilerGains", "acquisition block of two channels", ByteOrder::little, 14},
                          field(&G::ad_threshold1, "ad_threshold1", "80/255 dB", "channel 1"),
                          field(&G::ad_threshold2, "ad_threshold2", "80/255 dB", "channel 2"),
                          field(&G::filt_gain1, "filt_gain1", "", "channel 1"),
                          field(&G::filt_gain2, "filt_gain2", "", "channel 2"),
                          field(&G::agc_max1, "agc_max1", "80/255 dB", "channel 1"),
                          field(&G::agc_max2, "agc_max2", "80/255 dB", "channel 2"),
                          field(&G::agc_set_point1, "agc_set_point1", "80/255 dB", "channel 1"),
                          field(&G::agc_set_point2, "agc_set_point2", "80/255 dB", "channel 2"),
                          field(&G::adv_slope1, "adv_slope1", "", "channel 1"),
                          field(&G::adv_slope2, "adv_slope2", "", "channel 2"),
                          field(&G::slope_delay1, "slope_delay1", "", "channel 1"),
                          field(&G::slope_delay2, "slope_delay2", "", "channel 2"));
}

constexpr auto wire_layout(Tag<ProfilerCommand>) {
    return make_layout<ProfilerCommand>(
        payload_of("ProfilerCommand", "parameters of a profiler, HeadCommand of type 0x1D to node 20"),
        constant(HeadCommandType::dual, "type", "0x1D"),
        field(&ProfilerCommand::parameters, "parameters", "", "settings"),
        field(&ProfilerCommand::gains, "gains", "", "acquisition block"));
}
constexpr auto wire_layout(Tag<ProfilerGainCommand>) {
    return make_layout<ProfilerGainCommand>(
        payload_of("ProfilerGainCommand", "acquisition block only, HeadCommand of type 0x1E to node 20"),
        constant(HeadCommandType::gain, "type", "0x1E"),
        field(&ProfilerGainCommand::gains, "gains", "", "acquisition block"));
}

constexpr auto wire_layout(Tag<ProfilerData>) {
    using D = ProfilerData;
    return make_layout<D>(payload_of("ProfilerData", "echo times of one pass, HeadData from node 20"),
                          total_size<std::uint16_t>("total_count", "2 * count + 37"),
                          field(&D::device_type, "device_type", "", "5 profiler").hex(),
                          field(&D::head_status, "head_status", "", "").bits(head_status_names),
                          field(&D::sweep_code, "sweep_code", "", "where the pass ended"),
                          field(&D::hd_ctrl, "hd_ctrl", "", "echo; scanright: this pass ran clockwise")
                              .bits(profiler_ctrl_names),
                          field(&D::range_scale, "range_scale", "0.1 unit", "echo"),
                          field(&D::tx_n, "tx_n", "32 MHz / 2^32", "echo"),
                          field(&D::gain, "gain", "80/255 dB", ""), field(&D::slope, "slope", "", ""),
                          field(&D::ad_threshold, "ad_threshold", "80/255 dB", "echo"),
                          field(&D::filt_gain, "filt_gain", "", "echo"),
                          field(&D::left_limit, "left_limit", "1/16 grad", "echo"),
                          field(&D::right_limit, "right_limit", "1/16 grad", "echo"),
                          field(&D::step_size, "step_size", "1/16 grad", "echo"),
                          field(&D::scan_time, "scan_time", "100 us", "echo"),
                          count<std::uint16_t>("echo_times", 0, "count", "", "number of pings"),
                          counted(&D::echo_times, "echo_times", "echo_times", "us",
                                  "two-way, in the order of the pings; 0: none"),
                          field(&D::trailer, "trailer", "", "unknown"));
}

}  // namespace echoloop::seanet
