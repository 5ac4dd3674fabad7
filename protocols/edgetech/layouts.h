// The field tables of the EdgeTech messages. Tables only. Layouts behind the header start at byte 16.
#pragma once

#include "protocols/edgetech/names.h"
#include "protocols/wire/layout.h"

namespace echoloop::edgetech {

using namespace wire;

inline constexpr std::size_t header_bytes = 16;

constexpr Heading body_of(std::string_view name, std::string_view help) {
    return {name, help, ByteOrder::little, header_bytes};
}

constexpr auto wire_layout(Tag<Header>) {
    return make_layout<Header>(
        {"Header", "before every message", ByteOrder::little},
        constant(start_mark, "start", "always the same"),
        field(&Header::version, "version", "", "of the protocol").hex(),
        field(&Header::session, "session", "", "0"), field(&Header::type, "type", "", "what follows"),
        field(&Header::command, "command", "", "0 also in data"),
        field(&Header::subsystem, "subsystem", "", "0 sub-bottom, 20 low, 21 high frequency"),
        field(&Header::channel, "channel", "", "0 port, 1 starboard"),
        field(&Header::sequence, "sequence", "", "0"), constant(std::uint16_t{0}, "reserved", "0"),
        field(&Header::size, "size", "B", "of what follows"));
}

constexpr auto wire_layout(Tag<SystemTime>) {
    return make_layout<SystemTime>(body_of("SystemTime", "time of the sonar, type 22; of a file 426"),
                                   field(&SystemTime::seconds, "seconds", "s", "since 1970"),
                                   field(&SystemTime::milliseconds, "milliseconds", "ms",
                                         "of the day in a reply; readers take them modulo 1000"));
}

constexpr auto wire_layout(Tag<Setting>) {
    return make_layout<Setting>(
        body_of("Setting", "types 25, 83, 120, 121, 125, 128, 133, 141"),
        field(&Setting::value, "value", "", "of a range in mm; else 0, 1 or a number"));
}

constexpr auto wire_layout(Tag<Coupling>) {
    return make_layout<Coupling>(body_of("Coupling", "type 129: pings with another subsystem's"),
                                 field(&Coupling::source, "source", "", "subsystem that it follows"),
                                 field(&Coupling::divider, "divider", "", "each so manieth ping"),
                                 field(&Coupling::delay, "delay", "", "not known"));
}

constexpr auto wire_layout(Tag<SonarData>) {
    return make_layout<SonarData>(
        body_of("SonarData", "type 80: one side of one ping; a level is sample x 2^-weighting"),
        field(&SonarData::seconds, "seconds", "s", "since 1970"),
        field(&SonarData::first_sample, "first_sample", "samples", ""),
        field(&SonarData::ping, "ping", "", "1 more each ping, the same on both sides"),
        field(&SonarData::reserved_12, "reserved_12", "", "0"),
        field(&SonarData::high_bits, "high_bits", "",
              "nibbles from the lowest: start, end frequency, samples, mark")
            .hex(),
        field(&SonarData::low_bits_1, "low_bits_1", "", "fractions of interval and course").hex(),
        field(&SonarData::low_bits_2, "low_bits_2", "", "fraction of speed, sweep in us").hex(),
        field(&SonarData::reserved_22, "reserved_22", "", "0"), field(&SonarData::id, "id", "", "1"),
        field(&SonarData::validity, "validity", "", "what is told below").bits(valid_names),
        field(&SonarData::reserved_32, "reserved_32", "", "0"),
        field(&SonarData::format, "format", "", "of the data"),
        field(&SonarData::antenna_aft, "antenna_aft", "cm", ""),
        field(&SonarData::antenna_starboard, "antenna_starboard", "cm", ""),
        field(&SonarData::reserved_40, "reserved_40", "", "0"),
        field(&SonarData::old_position, "old_position", "",
              "an old x and y: the same as x and y below marks an obsolete header"),
        field(&SonarData::x, "x", "", "longitude, as the units say"),
        field(&SonarData::y, "y", "", "latitude"),
        field(&SonarData::position_units, "position_units", "", "1 mm, 2 1e-4 minutes of arc, 3 dm"),
        field(&SonarData::annotation, "annotation", "", ""),
        field(&SonarData::samples, "samples", "", "low 16 bits"),
        field(&SonarData::interval, "interval", "ns", "from sample to sample"),
        field(&SonarData::converter_gain, "converter_gain", "", ""),
        field(&SonarData::power, "power", "%", ""), field(&SonarData::reserved_124, "reserved_124", "", "0"),
        field(&SonarData::start_frequency, "start_frequency", "10 Hz", "of the chirp, low 16 bits"),
        field(&SonarData::end_frequency, "end_frequency", "10 Hz", "low 16 bits"),
        field(&SonarData::sweep, "sweep", "ms", "length of the chirp"),
        field(&SonarData::pressure, "pressure", "0.001 psi", ""), field(&SonarData::depth, "depth", "mm", ""),
        field(&SonarData::sample_rate, "sample_rate", "Hz", "modulo 65536"),
        field(&SonarData::pulse, "pulse", "", ""), field(&SonarData::altitude, "altitude", "mm", ""),
        field(&SonarData::sound_speed, "sound_speed", "m/s", ""), field(&SonarData::mixer, "mixer", "Hz", ""),
        field(&SonarData::year, "year", "", ""), field(&SonarData::day, "day", "", "of the year"),
        field(&SonarData::hour, "hour", "", ""), field(&SonarData::minute, "minute", "", ""),
        field(&SonarData::second, "second", "", ""), field(&SonarData::time_basis, "time_basis", "", "3"),
        field(&SonarData::weighting, "weighting", "", "N of 2^-N"),
        field(&SonarData::pulses_in_water, "pulses_in_water", "", ""),
        field(&SonarData::heading, "heading", "0.01 deg", ""),
        field(&SonarData::pitch, "pitch", "180/32768 deg", "bow up"),
        field(&SonarData::roll, "roll", "180/32768 deg", "port up"),
        field(&SonarData::reserved_178, "reserved_178", "", "0"),
        field(&SonarData::trigger, "trigger", "", ""), field(&SonarData::mark, "mark", "", ""),
        field(&SonarData::fix_hour, "fix_hour", "", "of the position"),
        field(&SonarData::fix_minute, "fix_minute", "", ""),
        field(&SonarData::fix_second, "fix_second", "", ""), field(&SonarData::course, "course", "deg", ""),
        field(&SonarData::speed, "speed", "0.1 kn", ""), field(&SonarData::fix_day, "fix_day", "", ""),
        field(&SonarData::fix_year, "fix_year", "", ""),
        field(&SonarData::milliseconds, "milliseconds", "ms", "of the day"),
        field(&SonarData::converter_maximum, "converter_maximum", "", ""),
        field(&SonarData::reserved_206, "reserved_206", "", "0"),
        field(&SonarData::software, "software", "", ""),
        field(&SonarData::spherical_correction, "spherical_correction", "0.01", "-1 off"),
        field(&SonarData::packet, "packet", "", "from 1"),
        field(&SonarData::decimation, "decimation", "", ""),
        field(&SonarData::reserved_224, "reserved_224", "", "temperature, layback, cable: sources disagree"),
        rest(&SonarData::data, {}, "data", "", "near to far on both sides"));
}

constexpr auto wire_layout(Tag<OldSideScan>) {
    return make_layout<OldSideScan>(
        body_of("OldSideScan", "type 82, of older files"),
        field(&OldSideScan::subsystem, "subsystem", "", ""),
        field(&OldSideScan::channel, "channel", "", "0 port, 1 starboard"),
        field(&OldSideScan::ping, "ping", "", ""), field(&OldSideScan::packet, "packet", "", ""),
        field(&OldSideScan::trigger, "trigger", "", ""), field(&OldSideScan::samples, "samples", "", ""),
        field(&OldSideScan::interval, "interval", "ns", ""),
        field(&OldSideScan::first_sample, "first_sample", "samples", ""),
        field(&OldSideScan::weighting, "weighting", "", "N of 2^-N"),
        field(&OldSideScan::converter_gain, "converter_gain", "", ""),
        field(&OldSideScan::converter_maximum, "converter_maximum", "", ""),
        field(&OldSideScan::range, "range", "0.1 m", ""), field(&OldSideScan::pulse, "pulse", "", ""),
        field(&OldSideScan::mark, "mark", "", ""), field(&OldSideScan::format, "format", "", ""),
        field(&OldSideScan::reserved_38, "reserved_38", "", "0"),
        field(&OldSideScan::milliseconds, "milliseconds", "ms", "of the day"),
        field(&OldSideScan::year, "year", "", ""), field(&OldSideScan::day, "day", "", "of the year"),
        field(&OldSideScan::hour, "hour", "", ""), field(&OldSideScan::minute, "minute", "", ""),
        field(&OldSideScan::second, "second", "", ""), field(&OldSideScan::heading, "heading", "arcmin", ""),
        field(&OldSideScan::pitch, "pitch", "arcmin", ""), field(&OldSideScan::roll, "roll", "arcmin", ""),
        field(&OldSideScan::heave, "heave", "cm", ""), field(&OldSideScan::yaw, "yaw", "arcmin", ""),
        field(&OldSideScan::depth, "depth", "cm", ""),
        field(&OldSideScan::temperature, "temperature", "0.1 degC", ""),
        field(&OldSideScan::reserved_70, "reserved_70", "", "0"),
        rest(&OldSideScan::data, {}, "data", "", "near to far"));
}

constexpr auto wire_layout(Tag<SystemInformation>) {
    return make_layout<SystemInformation>(
        body_of("SystemInformation", "type 182, of files"),
        field(&SystemInformation::system, "system", "",
              "1, 2 2xxx series, 4 4300-MPX, 16 2xxx dual, 18 4700, 19, 20 4200, 128 4100"),
        field(&SystemInformation::reserved_4, "reserved_4", "", "0"),
        field(&SystemInformation::software_version, "software_version", "", "of the software"),
        field(&SystemInformation::reserved_12, "reserved_12", "", "0"),
        field(&SystemInformation::serial, "serial", "", "of the sonar"),
        field(&SystemInformation::text_size, "text_size", "B", ""),
        rest(&SystemInformation::text, {}, "text", "", ""));
}

constexpr auto wire_layout(Tag<NmeaText>) {
    return make_layout<NmeaText>(body_of("NmeaText", "type 2002"),
                                 field(&NmeaText::seconds, "seconds", "s", "since 1970"),
                                 field(&NmeaText::milliseconds, "milliseconds", "ms", ""),
                                 field(&NmeaText::source, "source", "", "1 sonar, 2 acquisition program"),
                                 field(&NmeaText::reserved_9, "reserved_9", "", "0"),
                                 rest(&NmeaText::text, {}, "text", "", "a sentence"));
}

constexpr auto wire_layout(Tag<PitchRoll>) {
    return make_layout<PitchRoll>(
        body_of("PitchRoll", "type 2020"), field(&PitchRoll::seconds, "seconds", "s", "since 1970"),
        field(&PitchRoll::milliseconds, "milliseconds", "ms", ""),
        field(&PitchRoll::reserved_8, "reserved_8", "", "0"),
        field(&PitchRoll::acceleration, "acceleration", "30/32768 g", "x, y, z"),
        field(&PitchRoll::rate, "rate", "750/32768 deg/s", "about x, y, z"),
        field(&PitchRoll::pitch, "pitch", "180/32768 deg", "bow up"),
        field(&PitchRoll::roll, "roll", "180/32768 deg", "port up"),
        field(&PitchRoll::temperature, "temperature", "0.1 degC", ""),
        field(&PitchRoll::device_info, "device_info", "", ""), field(&PitchRoll::heave, "heave", "mm", ""),
        field(&PitchRoll::heading, "heading", "0.01 deg", ""),
        field(&PitchRoll::validity, "validity", "", "bits of the fields in this order").hex(),
        field(&PitchRoll::reserved_40, "reserved_40", "", "0"));
}

constexpr auto wire_layout(Tag<Pressure>) {
    return make_layout<Pressure>(
        body_of("Pressure", "type 2060"), field(&Pressure::seconds, "seconds", "s", "since 1970"),
        field(&Pressure::milliseconds, "milliseconds", "ms", ""),
        field(&Pressure::reserved_8, "reserved_8", "", "0"),
        field(&Pressure::pressure, "pressure", "0.001 psi", ""),
        field(&Pressure::salinity, "salinity", "ppm", ""),
        field(&Pressure::validity, "validity", "", "").hex(),
        field(&Pressure::conductivity, "conductivity", "uS/cm", ""),
        field(&Pressure::sound_speed, "sound_speed", "mm/s", ""), rest(&Pressure::rest, {}, "rest", "", ""));
}

constexpr auto wire_layout(Tag<Unread>) {
    return make_layout<Unread>(
        body_of("Unread", "what no public program reads, and what a get carries: readers ignore it"),
        rest(&Unread::bytes, {}, "bytes", "", ""));
}

static_assert(fixed_size<Header>() == header_bytes);

}  // namespace echoloop::edgetech
