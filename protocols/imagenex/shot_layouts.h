// The field tables of the maker's shot files. Tables only.
#pragma once

#include "protocols/imagenex/messages.h"
#include "protocols/imagenex/shot_files.h"
#include "protocols/wire/field.h"

namespace echoloop::imagenex {

constexpr auto wire_layout(Tag<Shot852>) {
    using S = Shot852;
    using wire::field;
    return wire::make_layout<S>(
        {"Shot852", "one shot of a .852 file", ByteOrder::big}, wire::magic("852", "magic", ""),
        field(&S::index, "index", "", "0, 2, 3: 0, 252, 500 bytes of echo data"),
        field(&S::total_bytes, "total_bytes", "B", "128, 384 or 640"),
        wire::count<std::uint16_t>("reply", 0, "reply_bytes", "B", "13, 265 or 513"),
        field(&S::date, "date", "", "DD-Mmm-YYYY"), field(&S::time, "time", "", "HH:MM:SS"),
        field(&S::hundredths, "hundredths", "", "of the second, .hh"),
        field(&S::reserved33, "reserved33", "", "0"), field(&S::start_gain, "start_gain", "dB", "0 to 40"),
        field(&S::reserved39, "reserved39", "", "0 with the sounder; one real file has 120, 70, 0"),
        field(&S::absorption, "absorption", "0.01 dB/m", "20"), field(&S::reserved43, "reserved43", "", "9"),
        field(&S::pulse_length, "pulse_length", "us", ""),
        field(&S::profile, "profile", "", "0 off, 1 points only, 2 to 4 mixed"),
        field(&S::sound_speed, "sound_speed", "0.1 m/s", "bit 15: valid"),
        field(&S::reserved48, "reserved48", "", "0"),
        field(&S::depth, "depth", "0.1", "of the vehicle; bit 15: valid"),
        field(&S::depth_unit, "depth_unit", "", "'M' or 'F'"), field(&S::heading, "heading", "0.1 deg", ""),
        field(&S::turns, "turns", "", "+ 100"),
        field(&S::frequency, "frequency", "", "0: 675 kHz, 1: 850 kHz head"),
        field(&S::head_id, "head_id", "", "").hex(), field(&S::reserved89, "reserved89", "", "0"),
        wire::counted(&S::reply, "reply", "reply", "", "as it came over the line"),
        wire::rest(&S::fill, {}, "fill", "", "zeros up to the total"));
}

constexpr auto wire_layout(Tag<Shot81A>) {
    using S = Shot81A;
    using wire::field;
    return wire::make_layout<S>(
        {"Shot81A", "one shot of a .81A file", ByteOrder::big}, wire::magic("81A", "magic", ""),
        field(&S::index, "index", "", "0 to 3: 0, 128, 250 or 252, 500 bytes of echo data"),
        field(&S::total_bytes, "total_bytes", "B", "128, 256, 384 or 640, and the extended bytes"),
        wire::count<std::uint16_t>("reply", 0, "reply_bytes", "B", "13, 141, 263, 265 or 513"),
        field(&S::date, "date", "", "DD-MMM-YYYY"), field(&S::time, "time", "", "HH:MM:SS"),
        field(&S::hundredths, "hundredths", "", "of the second, .hh"),
        field(&S::reserved33, "reserved33", "", "0"),
        field(&S::extended, "extended", "128 B", "bytes with positions behind the zeros"),
        field(&S::reserved35, "reserved35", "", "0"),
        field(&S::scan, "scan", "", "bit 7 clockwise, 6 transducer up, 5-3 mode, 2-0 step").hex(),
        field(&S::start_gain, "start_gain", "dB", "0 to 40"),
        field(&S::sector_width, "sector_width", "3 deg", ""),
        field(&S::train_angle, "train_angle", "3 deg", "0 to 119"),
        field(&S::range_offset, "range_offset", "m", ""),
        field(&S::absorption, "absorption", "0.01 dB/m", ""),
        field(&S::data_setting, "data_setting", "", "bit 7 profile grid, 6 zero down, 5-3 bits, 2-0 LOGF")
            .hex(),
        field(&S::pulse_length, "pulse_length", "10 us", ""),
        field(&S::profile, "profile", "", "0 off, 1 points only, 2 to 4 mixed"),
        field(&S::sound_speed, "sound_speed", "0.1 m/s", "bit 15: valid"),
        field(&S::operator_text, "operator_text", "", ""), field(&S::frequency, "frequency", "kHz", ""),
        field(&S::azimuth, "azimuth", "", "bit 15: valid"), field(&S::reserved84, "reserved84", "", "0"),
        field(&S::vertical_offset, "vertical_offset", "0.1", "+ 1800"),
        field(&S::reserved93, "reserved93", "", "0"),
        wire::counted(&S::reply, "reply", "reply", "", "as it came over the line"),
        wire::rest(&S::fill, {}, "fill", "", "zeros, extended bytes, bytes of this shot and the one before"));
}

constexpr auto wire_layout(Tag<Shot31L>) {
    using S = Shot31L;
    using wire::field;
    return wire::make_layout<S>(
        {"Shot31L", "one shot of a .31L file", ByteOrder::big}, wire::magic("31L", "magic", ""),
        field(&S::index, "index", "", "2: 250 bytes of echo data"),
        field(&S::total_bytes, "total_bytes", "B", "512"),
        wire::count<std::uint16_t>("reply", 0, "reply_bytes", "B", "283"),
        field(&S::date, "date", "", "DD-MMM-YYYY"), field(&S::time, "time", "", "HH:MM:SS"),
        field(&S::hundredths, "hundredths", "", "of the second, .hh, or mmm"),
        field(&S::reserved33, "reserved33", "", "0"),
        field(&S::sensors, "sensors", "", "1: there is another sensor of pitch, roll and distance"),
        field(&S::reserved35, "reserved35", "", "0"),
        field(&S::scan, "scan", "", "bit 7 clockwise, 6 transducer up, 5-3 mode, 2-0 step").hex(),
        field(&S::start_gain, "start_gain", "dB", "0 to 40"),
        field(&S::sector_width, "sector_width", "3 deg", ""),
        field(&S::train_angle, "train_angle", "3 deg", "0 to 120"),
        field(&S::range_code, "range_code", "", "as in a command"),
        field(&S::absorption, "absorption", "0.01 dB/m", ""),
        field(&S::data_setting, "data_setting", "", "bit 7 profile grid, 6 zero down, 5-3 bits, 2-0 LOGF")
            .hex(),
        field(&S::pulse_length, "pulse_length", "us", ""),
        field(&S::profile, "profile", "", "0 off, 1 points only, 2 to 4 mixed"),
        field(&S::sound_speed, "sound_speed", "0.1 m/s", "bit 15: valid"),
        field(&S::operator_text, "operator_text", "", ""), field(&S::frequency, "frequency", "kHz", ""),
        field(&S::repetition_rate, "repetition_rate", "0.01 Hz", ""),
        field(&S::reserved84, "reserved84", "", "0"),
        field(&S::sensors_valid, "sensors_valid", "", "of the other sensor: 1 pitch, 2 roll, 4 distance"),
        field(&S::pitch, "pitch", "deg", "of the other sensor"),
        field(&S::roll, "roll", "deg", "of the other sensor"),
        field(&S::distance, "distance", "m", "of the other sensor"),
        field(&S::reserved112, "reserved112", "", "0"),
        wire::counted(&S::reply, "reply", "reply", "", "as it came over the line"),
        field(&S::end, "end", "", "0"));
}

}  // namespace echoloop::imagenex
