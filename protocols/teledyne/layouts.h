// The field tables of the sections of a PD0 ensemble, and of PD5. Tables only.
#pragma once

#include "protocols/teledyne/messages.h"
#include "protocols/wire/layout.h"

namespace echoloop::teledyne {

using namespace wire;

inline constexpr std::uint16_t fixed_leader_id = 0x0000, variable_leader_id = 0x0080, velocity_id = 0x0100,
                               correlation_id = 0x0200, intensity_id = 0x0300, percent_good_id = 0x0400,
                               bottom_track_id = 0x0600;

constexpr auto id_of(std::uint16_t id) { return constant<std::uint16_t>(id, "id", "of the section"); }

constexpr auto wire_layout(Tag<FixedLeader>) {
    using M = FixedLeader;
    return make_layout<M>(
        {"FixedLeader", "what stays from ensemble to ensemble", ByteOrder::little}, id_of(fixed_leader_id),
        field(&M::firmware, "firmware", "", "version"), field(&M::revision, "revision", "", ""),
        field(&M::configuration, "configuration", "",
              "bits 0-2 frequency, 3 convex, 6 head, 7 up, 8-9 beam angle, 12-15 Janus")
            .hex(),
        field(&M::simulated, "simulated", "", ""), field(&M::lag, "lag", "", ""),
        field(&M::beam_count, "beam_count", "", ""), field(&M::cells, "cells", "", "of the water profile"),
        field(&M::pings, "pings", "", "of the water profile in an ensemble"),
        field(&M::cell_size, "cell_size", "cm", ""), field(&M::blank, "blank", "cm", ""),
        field(&M::mode, "mode", "", ""), field(&M::correlation_threshold, "correlation_threshold", "", ""),
        field(&M::repetitions, "repetitions", "", "of the code"),
        field(&M::percent_good, "percent_good", "%", ""),
        field(&M::error_threshold, "error_threshold", "mm/s", ""),
        field(&M::between_pings, "between_pings", "", "min, s, 0.01 s"),
        field(&M::coordinates, "coordinates", "",
              "bits 3-4: 0 beam, 1 instrument, 2 ship, 3 earth; 2 tilts, 1 three beams, 0 bin mapping")
            .hex(),
        field(&M::heading_alignment, "heading_alignment", "0.01 deg", "EA"),
        field(&M::heading_bias, "heading_bias", "0.01 deg", "EB"),
        field(&M::sensors_used, "sensors_used", "", "EZ").hex(),
        field(&M::sensors_there, "sensors_there", "", "").hex(),
        field(&M::first_cell, "first_cell", "cm", "to its middle"), field(&M::pulse, "pulse", "cm", ""),
        field(&M::layer, "layer", "", "first and last cell of the reference layer"),
        field(&M::false_target, "false_target", "", ""), field(&M::spare, "spare", "", ""),
        field(&M::lag_distance, "lag_distance", "cm", ""), field(&M::board, "board", "", "its serial number"),
        field(&M::bandwidth, "bandwidth", "", ""), field(&M::serial_number, "serial_number", "", ""),
        rest(&M::more, {}, "more", "", "of a Workhorse: the beam angle, deg"));
}

constexpr auto wire_layout(Tag<VariableLeader>) {
    using M = VariableLeader;
    return make_layout<M>(
        {"VariableLeader", "time and sensors of an ensemble", ByteOrder::little}, id_of(variable_leader_id),
        field(&M::number, "number", "", "of the ensemble, from 1"),
        field(&M::year, "year", "", "of the century"), field(&M::month, "month", "", ""),
        field(&M::day, "day", "", ""), field(&M::hour, "hour", "h", ""),
        field(&M::minute, "minute", "min", ""), field(&M::second, "second", "s", ""),
        field(&M::hundredth, "hundredth", "0.01 s", ""),
        field(&M::number_high, "number_high", "", "65536 ensembles"),
        field(&M::built_in_test, "built_in_test", "", "0 is good").hex(),
        field(&M::sound_speed, "sound_speed", "m/s", ""), field(&M::depth, "depth", "dm", ""),
        field(&M::heading, "heading", "0.01 deg", ""), field(&M::pitch, "pitch", "0.01 deg", "bow up"),
        field(&M::roll, "roll", "0.01 deg", "starboard down"),
        field(&M::salinity, "salinity", "", "per thousand"),
        field(&M::temperature, "temperature", "0.01 degC", ""), field(&M::wait, "wait", "", "min, s, 0.01 s"),
        field(&M::deviation, "deviation", "", "of heading (deg), pitch and roll (0.1 deg)"),
        field(&M::converter, "converter", "", "channels of the analogue-digital converter"),
        field(&M::status, "status", "", "").hex(), field(&M::spare, "spare", "", ""),
        field(&M::pressure, "pressure", "daPa", ""),
        field(&M::pressure_variance, "pressure_variance", "daPa", ""), field(&M::spare_2, "spare_2", "", ""),
        rest(&M::more, {}, "more", "", "clock with a century, health, leaks, supply"));
}

template <class M>
constexpr auto profile_layout(std::string_view name, std::uint16_t id, std::string_view unit,
                              std::string_view help) {
    return make_layout<M>({name, "of the cells of a water profile", ByteOrder::little}, id_of(id),
                          rest(&M::values, {}, "values", unit, help));
}
constexpr auto wire_layout(Tag<Cell>) {
    return make_layout<Cell>({"Cell", "of a water profile", ByteOrder::little},
                             field(&Cell::velocity, "velocity", "mm/s", "-32768 is bad"));
}
constexpr auto wire_layout(Tag<Velocity>) {
    return make_layout<Velocity>({"Velocity", "of the cells of a water profile", ByteOrder::little},
                                 id_of(velocity_id), list(&Velocity::cells, "cells", "nearest first"));
}
constexpr auto wire_layout(Tag<Correlation>) {
    return profile_layout<Correlation>("Correlation", correlation_id, "", "four a cell");
}
constexpr auto wire_layout(Tag<Intensity>) {
    return profile_layout<Intensity>("Intensity", intensity_id, "0.61 dB", "four a cell");
}
constexpr auto wire_layout(Tag<PercentGood>) {
    return profile_layout<PercentGood>("PercentGood", percent_good_id, "%", "four a cell");
}
constexpr auto wire_layout(Tag<Other>) {
    return make_layout<Other>({"Other", "a section that has no table", ByteOrder::little},
                              field(&Other::id, "id", "", "of the section").hex(),
                              rest(&Other::values, {}, "values", "", ""));
}

constexpr auto wire_layout(Tag<BottomTrack>) {
    using M = BottomTrack;
    return make_layout<M>(
        {"BottomTrack", "the bottom in four beams", ByteOrder::little}, id_of(bottom_track_id),
        field(&M::pings, "pings", "", "in an ensemble"), field(&M::delay, "delay", "", ""),
        field(&M::least_correlation, "least_correlation", "", ""),
        field(&M::least_amplitude, "least_amplitude", "", ""), field(&M::least_good, "least_good", "%", ""),
        field(&M::mode, "mode", "", ""), field(&M::most_error, "most_error", "mm/s", ""),
        field(&M::spare, "spare", "", ""), field(&M::range, "range", "cm", "vertical; 0: none"),
        field(&M::velocity, "velocity", "mm/s", "of the bottom against the log; -32768 is bad"),
        field(&M::correlation, "correlation", "", ""), field(&M::amplitude, "amplitude", "", ""),
        field(&M::good, "good", "%", ""), field(&M::layer_least, "layer_least", "dm", ""),
        field(&M::layer_near, "layer_near", "dm", ""), field(&M::layer_far, "layer_far", "dm", ""),
        field(&M::layer_velocity, "layer_velocity", "mm/s", "of the reference layer; -32768 is bad"),
        field(&M::layer_correlation, "layer_correlation", "", ""),
        field(&M::layer_amplitude, "layer_amplitude", "", ""), field(&M::layer_good, "layer_good", "%", ""),
        field(&M::most_depth, "most_depth", "dm", "BX"), field(&M::rssi, "rssi", "0.61 dB", ""),
        field(&M::gain, "gain", "", "0 low, 1 high"),
        field(&M::range_high, "range_high", "655.36 m", "added to the range"),
        rest(&M::more, {}, "more", "", ""));
}

constexpr auto wire_layout(Tag<Pd5>) {
    using M = Pd5;
    return make_layout<M>(
        {"PD5", "velocities, ranges, attitude and way of a report", ByteOrder::little},
        constant<std::uint8_t>(0x7D, "start", ""), constant<std::uint8_t>(1, "structure", "1: PD5"),
        constant<std::uint16_t>(86, "size", "bytes without the checksum"),
        field(&M::configuration, "configuration", "", "frame, tilts, beams, frequency").hex(),
        field(&M::velocity, "velocity", "mm/s", "x, y, z, error; -32768 is bad"),
        field(&M::range, "range", "cm", "of beams 1 to 4"),
        field(&M::status, "status", "", "of the bottom track; 0 is good").hex(),
        field(&M::water, "water", "mm/s", "against a layer of water"),
        field(&M::layer_start, "layer_start", "dm", ""), field(&M::layer_end, "layer_end", "dm", ""),
        field(&M::layer_status, "layer_status", "", ""), field(&M::hour, "hour", "h", ""),
        field(&M::minute, "minute", "min", ""), field(&M::second, "second", "s", ""),
        field(&M::hundredth, "hundredth", "0.01 s", ""), field(&M::built_in_test, "built_in_test", "", ""),
        field(&M::sound_speed, "sound_speed", "m/s", ""),
        field(&M::temperature, "temperature", "0.01 degC", ""),
        field(&M::salinity, "salinity", "", "per thousand"), field(&M::depth, "depth", "dm", ""),
        field(&M::pitch, "pitch", "0.01 deg", ""), field(&M::roll, "roll", "0.01 deg", ""),
        field(&M::heading, "heading", "0.01 deg", ""),
        field(&M::way, "way", "dm", "made good over the bottom: east, north, up, error"),
        field(&M::way_in_water, "way_in_water", "dm", "made good through the water"),
        field(&M::checksum, "checksum", "", "sum of the bytes before").hex());
}

}  // namespace echoloop::teledyne
