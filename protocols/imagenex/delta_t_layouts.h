// The field tables of 83P and EC. Tables only.
#pragma once

#include "protocols/imagenex/delta_t_messages.h"
#include "protocols/wire/field.h"

namespace echoloop::imagenex {

inline constexpr wire::NamedValue flag_names_83p[] = {
    {1, "roll_corrected"}, {2, "ray_bending"}, {4, "overlapped"}};
inline constexpr wire::NamedValue sensor_names_83p[] = {
    {1, "heading"}, {2, "roll"}, {4, "pitch"}, {8, "heave"}};

constexpr auto wire_layout(Tag<Profile83P>) {
    using P = Profile83P;
    using wire::field;
    return wire::make_layout<P>(
        {"83P", "one ping as profile points", ByteOrder::big}, wire::magic("83P", "magic", ""),
        field(&P::version, "version", "", "0: v1.00; 10: v1.10"),
        wire::total_size<std::uint16_t>("total_bytes", "256 and 2 or 4 a beam"),
        field(&P::reserved6, "reserved6", "", "0; first byte '#': a comment of MB-System"),
        field(&P::date, "date", "", "DD-MMM-YYYY"), field(&P::time, "time", "", "HH:MM:SS"),
        field(&P::hundredths, "hundredths", "", "of the second, .hh"),
        field(&P::latitude, "latitude", "", "dd.mm.xxxxx N"),
        field(&P::longitude, "longitude", "", "ddd.mm.xxxxx E"), field(&P::speed, "speed", "0.1 kn", ""),
        field(&P::course, "course", "0.1 deg", ""),
        field(&P::pitch, "pitch", "0.1 deg", "+ 900; bit 15: valid"),
        field(&P::roll, "roll", "0.1 deg", "+ 900; bit 15: valid"),
        field(&P::heading, "heading", "0.1 deg", "bit 15: valid"),
        wire::count<std::uint16_t>("beams", 0, "beams", "", "480, 240 or 120"),
        field(&P::samples, "samples", "", "of a beam"), field(&P::sector, "sector", "deg", ""),
        field(&P::start_angle, "start_angle", "0.01 deg", "+ 18000; of the first beam"),
        field(&P::angle_increment, "angle_increment", "0.01 deg", "from beam to beam"),
        field(&P::range, "range", "m", ""), field(&P::frequency, "frequency", "kHz", ""),
        field(&P::sound_speed, "sound_speed", "0.1 m/s", "bit 15: valid; 0: 1500 m/s"),
        field(&P::resolution, "resolution", "mm", "unit of the ranges"),
        field(&P::reserved87, "reserved87", "", "0"), field(&P::tilt, "tilt", "deg", "+ 180"),
        field(&P::ping_interval, "ping_interval", "ms", "between pings"),
        field(&P::ping_number, "ping_number", "", ""), field(&P::reserved97, "reserved97", "", "0"),
        field(&P::x_offset, "x_offset", "m",
              "this and all that follows to 154: v1.10; floats of either order"),
        field(&P::y_offset, "y_offset", "m", ""), field(&P::z_offset, "z_offset", "m", ""),
        field(&P::milliseconds, "milliseconds", "", "of the second, .mmm"),
        wire::count(&P::has_intensity, "intensity", "has_intensity", "", "1: intensities follow"),
        field(&P::ping_latency, "ping_latency", "100 us", ""),
        field(&P::data_latency, "data_latency", "100 us", ""),
        field(&P::sample_rate, "sample_rate", "", "0: 1 in 500; 1: 1 in 5000"),
        field(&P::flags, "flags", "", "").bits(flag_names_83p),
        field(&P::reserved124, "reserved124", "", "0"),
        field(&P::pings_averaged, "pings_averaged", "", "0 to 25"),
        field(&P::centre_ping_offset, "centre_ping_offset", "100 us", ""), field(&P::heave, "heave", "m", ""),
        field(&P::user, "user", "", ""), field(&P::altitude, "altitude", "m", ""),
        field(&P::sensors, "sensors", "", "external ones").bits(sensor_names_83p),
        field(&P::external_pitch, "external_pitch", "deg", ""),
        field(&P::external_roll, "external_roll", "deg", ""),
        field(&P::external_heading, "external_heading", "deg", ""),
        field(&P::transmit_scan, "transmit_scan", "", ""), field(&P::scan_angle, "scan_angle", "deg", ""),
        field(&P::reserved155, "reserved155", "", "0"),
        wire::counted(&P::ranges, "beams", "ranges", "resolution", "at 1500 m/s; 0: none"),
        wire::counted(&P::intensities, {"beams", "intensity"}, "intensities", "", ""));
}

constexpr auto wire_layout(Tag<ExternalControl>) {
    using E = ExternalControl;
    using wire::field;
    return wire::make_layout<E>(
        {"EC", "external control: a host's settings", ByteOrder::big}, wire::magic("EC", "magic", ""),
        field(&E::id, "id", "", "0"), field(&E::external, "external", "", "0: the program's own settings"),
        field(&E::receive_only, "receive_only", "", "1: no pulse"),
        field(&E::reserved5, "reserved5", "", "0"),
        field(&E::range, "range", "", "2 to 14: 5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 250, 300 m"),
        field(&E::gain, "gain", "dB", "0 to 20"), field(&E::display_gain, "display_gain", "%", "1 to 100"),
        field(&E::gain_equalisation, "gain_equalisation", "", ""),
        field(&E::sector, "sector", "", "0 to 3: 30, 60, 90, 120 deg"),
        field(&E::beam_width, "beam_width", "", "0 wide, 1 normal, 2 narrow, 3 narrow mixed"),
        field(&E::beams, "beams", "", "0, 1, 2: 480, 240, 120"),
        field(&E::averaging, "averaging", "", "pings, to 10; 0 and 1: off"),
        field(&E::persistence, "persistence", "", ""),
        field(&E::sound_speed, "sound_speed", "0.1 m/s", "some hosts send it little-endian"),
        field(&E::mode, "mode", "", "0 sector, 1 linear, 2 perspective, 3 profile, 4 beam test"),
        field(&E::output, "output", "", "0 83P, 1 83B, 2 83F"), field(&E::profile, "profile", "", "enable"),
        field(&E::minimum_range, "minimum_range", "m", ""),
        field(&E::minimum_level, "minimum_level", "%", "10 to 90"),
        field(&E::transducer_up, "transducer_up", "", "0 down, 1 up"),
        field(&E::tilt, "tilt", "deg", "+ 180"), field(&E::roll_compensation, "roll_compensation", "", ""),
        field(&E::reserved27, "reserved27", "", "0"), field(&E::record_837, "record_837", "", ""),
        field(&E::record_83p, "record_83p", "", ""), field(&E::reserved30, "reserved30", "", "0"),
        field(&E::control, "control", "", ""), field(&E::trigger_delay, "trigger_delay", "", ""),
        field(&E::profile_filter, "profile_filter", "", "0 first, 1 maximum, 2 bottom follow"),
        field(&E::reserved35, "reserved35", "", "0"));
}

}  // namespace echoloop::imagenex
