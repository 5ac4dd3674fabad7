// The field tables of R2Sonic's data sections. Tables only; offsets count from the start of the section.
#pragma once

#include "protocols/r2sonic/sections.h"
#include "protocols/wire/layout.h"

namespace echoloop::r2sonic {

using namespace wire;

constexpr Heading section_of(std::string_view tag, std::string_view help) {
    return {tag, help, ByteOrder::big, 4, tag};
}
inline constexpr std::string_view more_help = "roll (rad), projector Z, Y, X (m), 0, 0";

constexpr auto wire_layout(Tag<H0>) {
    return make_layout<H0>(
        section_of("H0", "settings of the ping"), field(&H0::model, "model", "", "e.g. 2024"),
        field(&H0::serial, "serial", "", "e.g. 100017"),
        field(&H0::ping_seconds, "ping_seconds", "s", "Unix time"),
        field(&H0::ping_nanoseconds, "ping_nanoseconds", "ns", ""),
        field(&H0::ping_number, "ping_number", "", "since power-up"),
        field(&H0::ping_period, "ping_period", "s", "between the last two pings"),
        field(&H0::sound_speed, "sound_speed", "m/s", ""), field(&H0::frequency, "frequency", "Hz", "centre"),
        field(&H0::tx_power, "tx_power", "dB", "re 1 uPa at 1 m"),
        field(&H0::tx_pulse_width, "tx_pulse_width", "s", ""),
        field(&H0::tx_beam_width_vertical, "tx_beam_width_vertical", "rad", "along track"),
        field(&H0::tx_beam_width_horizontal, "tx_beam_width_horizontal", "rad", "across track"),
        field(&H0::tx_steering_vertical, "tx_steering_vertical", "rad", ""),
        field(&H0::tx_steering_horizontal, "tx_steering_horizontal", "rad", ""),
        field(&H0::projector_temperature, "projector_temperature", "0.01 K", "2026 only"),
        field(&H0::vtx_offset, "vtx_offset", "0.01 dB", "transmit voltage offset"),
        field(&H0::rx_bandwidth, "rx_bandwidth", "Hz", ""),
        field(&H0::rx_sample_rate, "rx_sample_rate", "Hz", ""),
        field(&H0::rx_range, "rx_range", "m", "range setting"), field(&H0::rx_gain, "rx_gain", "2 dB", ""),
        field(&H0::rx_spreading, "rx_spreading", "dB", "times log10 of the range in m"),
        field(&H0::rx_absorption, "rx_absorption", "dB/km", ""),
        field(&H0::rx_mount_tilt, "rx_mount_tilt", "rad", ""), field(&H0::reserved108, "reserved108", "", ""),
        field(&H0::reserved112, "reserved112", "", ""),
        count(&H0::points, "points", "points", "", "points (BTH0) or beams (AID0)"));
}

constexpr auto wire_layout(Tag<R0>) {
    return make_layout<R0>(section_of("R0", "ranges"), field(&R0::scale, "scale", "s", "of one step"),
                           counted(&R0::r, "points", "r", "scale", "two-way time"));
}

constexpr auto wire_layout(Tag<A0>) {
    return make_layout<A0>(
        section_of("A0", "equi-angle beams"), field(&A0::first, "first", "rad", "angle of point 0"),
        field(&A0::last, "last", "rad", "angle of the last point"), field(&A0::more, "more", "", more_help));
}

constexpr auto wire_layout(Tag<A2>) {
    return make_layout<A2>(
        section_of("A2", "equi-distant beams"), field(&A2::first, "first", "rad", ""),
        field(&A2::scale, "scale", "rad", "of one step"), field(&A2::more, "more", "", more_help),
        counted(&A2::step, "points", "step", "scale", "angle = first + scale * sum of steps so far"));
}

constexpr auto wire_layout(Tag<A1>) {
    return make_layout<A1>(section_of("A1", "beam angles of an image"),
                           field(&A1::more, "more", "", more_help),
                           counted(&A1::angle, "points", "angle", "rad", "port to starboard"));
}

constexpr auto wire_layout(Tag<I1>) {
    return make_layout<I1>(section_of("I1", "intensities"), field(&I1::scale, "scale", "uPa", "of one step"),
                           counted(&I1::intensity, "points", "intensity", "scale", ""));
}

constexpr auto wire_layout(Tag<G0>) {
    return make_layout<G0>(section_of("G0", "depth gate"), field(&G0::gate_min, "gate_min", "s", "two-way"),
                           field(&G0::gate_max, "gate_max", "s", "two-way"),
                           field(&G0::slope, "slope", "rad", "positive: deeper to starboard"));
}

constexpr auto wire_layout(Tag<Gate>) {
    return make_layout<Gate>({"Gate", "gate of one point", ByteOrder::big},
                             field(&Gate::min, "min", "scale", ""), field(&Gate::max, "max", "scale", ""));
}
constexpr auto wire_layout(Tag<G1>) {
    return make_layout<G1>(section_of("G1", "gates of all points"),
                           field(&G1::scale, "scale", "s", "two-way, of one step"),
                           counted(&G1::gate, "points", "gate", "", "least and greatest time"));
}

constexpr auto wire_layout(Tag<Q0>) {
    return make_layout<Q0>(
        section_of("Q0", "quality"),
        counted(&Q0::flags, {"points", 8}, "flags", "",
                "4 bits a point, first in the top bits: 8 phase, 4 magnitude, 2, 1 tests passed"));
}

constexpr auto wire_layout(Tag<M0>) {
    return make_layout<M0>(
        section_of("M0", "part of an 8-bit image"), field(&M0::ping_number, "ping_number", "", "equals H0's"),
        field(&M0::reserved8, "reserved8", "", "0"),
        field(&M0::total_samples, "total_samples", "", "range samples before compression"),
        field(&M0::total_bins, "total_bins", "", "of the image"),
        field(&M0::first_bin, "first_bin", "", "of this section"),
        count(&M0::bins, "bins", "bins", "", "in this section"),
        field(&M0::total_beams, "total_beams", "", "multiple of 4"),
        field(&M0::first_beam, "first_beam", "", "multiple of 4"),
        count(&M0::beams, "beams", "beams", "", "multiple of 4"),
        field(&M0::reserved32, "reserved32", "", ""),
        counted(&M0::data, {"beams", "bins"}, "data", "", "all bins of a beam, then the next beam"));
}

}  // namespace echoloop::r2sonic
