// The field tables of Imagenex commands and replies. Tables only.
#pragma once

#include "protocols/imagenex/messages.h"
#include "protocols/wire/field.h"

namespace echoloop::wire {

inline constexpr NamedValue imagenex_kind_names[] = {{'M', "IMX"}, {'G', "IGX"}, {'P', "IPX"}};
template <>
inline constexpr std::span<const NamedValue> value_names<imagenex::Kind>{imagenex_kind_names};

}  // namespace echoloop::wire

namespace echoloop::imagenex {

inline constexpr wire::NamedValue motion_names[] = {{1, "hold"}, {0x40, "reverse"}};
inline constexpr wire::NamedValue mode_names[] = {{1, "transmit"}, {2, "send_data"}, {0x40, "slave"}};
inline constexpr wire::NamedValue pipe_status_names[] = {{1, "range_error"},
                                                         {2, "frequency_error"},
                                                         {4, "sensor_error"},
                                                         {8, "calibration_error"},
                                                         {0x80, "accepted"}};
inline constexpr wire::NamedValue trigger_names[] = {{1, "positive_edge"}, {2, "enable"}, {4, "automatic"}};
inline constexpr wire::NamedValue status_names[] = {
    {1, "V5_or_sounder"}, {4, "trigger_available"}, {0x40, "accepted"}, {0x80, "overrun"}};

constexpr auto wire_layout(Tag<Packed14>) {
    using wire::field;
    return wire::make_layout<Packed14>({"Packed14", "14 bits, 7 in each byte", ByteOrder::little},
                                       field(&Packed14::low, "low", "", "bits 0 to 6"),
                                       field(&Packed14::high, "high", "", "bits 7 to 13"));
}

constexpr auto wire_layout(Tag<Signed14>) {
    using wire::field;
    return wire::make_layout<Signed14>(
        {"Signed14", "14 signed bits and two flags", ByteOrder::little},
        field(&Signed14::low, "low", "", "bits 0 to 7"),
        field(&Signed14::high, "high", "", "bits 8 to 13; 80: new data, 40: alarm"));
}

constexpr auto wire_layout(Tag<SwitchCommand>) {
    using C = SwitchCommand;
    using wire::field;
    return wire::make_layout<C>(
        {"SwitchCommand", "all settings of one ping; the host asks for a reply with it", ByteOrder::little},
        wire::constant<std::uint8_t>(0xFE, "start", ""), wire::constant<std::uint8_t>(0x44, "start2", ""),
        field(&C::head_id, "head_id", "", "10 to 1F (881A), 11 to 15 (852), 0 (872, 831L)").hex(),
        field(&C::range, "range", "m",
              "1 to 200 (881A); 5, 10, 20, 30, 40, 50 (852); 831L: code, tenths of a metre from 10 on"),
        field(&C::reserved4, "reserved4", "", "0"),
        field(&C::motion, "motion", "", "831L: bit 0 profile at the pulse's start").bits(motion_names),
        field(&C::mode, "mode", "", "43; 0 from some hosts").bits(mode_names),
        field(&C::reserved7, "reserved7", "", "0; 872: frequency, 0 to 2"),
        field(&C::start_gain, "start_gain", "dB", "0 to 40; 872: data gain, 0 to 100 %"),
        field(&C::logf, "logf", "", "0 to 3: 10, 20, 30, 40 dB; 0 (852)"),
        field(&C::absorption, "absorption", "0.01 dB/m", "0 to 255, not 253; 872: balance gain, 0 to 60"),
        field(&C::train_angle, "train_angle", "3 deg", "0 to 120, 60 ahead; 0 (852)"),
        field(&C::sector_width, "sector_width", "3 deg", "0 to 120, 120 all around; 0 (852)"),
        field(&C::step_size, "step_size", "0.3 deg", "0, 1, 2, 3, 4, 8; 0 (852); 0, 3 (831L)"),
        field(&C::pulse_length, "pulse_length", "", "10 us (881A), 1 us (852, 831L); not 253"),
        field(&C::minimum_profile_range, "minimum_profile_range", "0.1 m", "0 to 250; 831L: cm"),
        field(&C::reserved16, "reserved16", "", "0"), field(&C::reserved17, "reserved17", "", "0"),
        field(&C::trigger, "trigger", "", "852 with the option only; 872: 0 port, 2 starboard")
            .bits(trigger_names),
        field(&C::data_points, "data_points", "10", "25 or 50"),
        field(&C::data_bits, "data_bits", "", "4, 8 or 16; 0 (852)"),
        field(&C::reply_baud, "reply_baud", "",
              "6 is 115200; not yet available; 831L: 1 reads, 255 calibrates pitch and roll")
            .hex(),
        field(&C::profile, "profile", "", "1: no echo data"),
        field(&C::calibrate, "calibrate", "", "1: move to 0 deg"),
        field(&C::switch_delay, "switch_delay", "2 ms", "not 253"),
        field(&C::frequency, "frequency", "5 kHz",
              "100 is 675 kHz (881A), 2250 kHz (831L, 80 to 120); 0 (852)"),
        wire::constant<std::uint8_t>(0xFD, "end", "nowhere else in a command"));
}

constexpr auto wire_layout(Tag<AzimuthCommand>) {
    using C = AzimuthCommand;
    using wire::field;
    return wire::make_layout<C>(
        {"AzimuthCommand", "moves the azimuth drive", ByteOrder::little},
        wire::constant<std::uint8_t>(0xFE, "start", ""), wire::constant<std::uint8_t>(0x44, "start2", ""),
        wire::constant<std::uint8_t>(azimuth_head_id, "head_id", ""),
        field(&C::reserved3, "reserved3", "", "0"), field(&C::reserved4, "reserved4", "", "0"),
        field(&C::motion, "motion", "", "hold only").bits(motion_names),
        field(&C::mode, "mode", "", "43").bits(mode_names), field(&C::reserved7, "reserved7", "", "0"),
        field(&C::angle, "angle", "0.3 deg", "0 to 1199, 600 is 0 deg"),
        field(&C::reserved13, "reserved13", "", "0"), field(&C::reply_baud, "reply_baud", "", "6").hex(),
        field(&C::reserved22, "reserved22", "", "0"), field(&C::calibrate, "calibrate", "", "1: find 0 deg"),
        field(&C::switch_delay, "switch_delay", "2 ms", "not 253"),
        field(&C::reserved25, "reserved25", "", "0"),
        wire::constant<std::uint8_t>(0xFD, "end", "nowhere else in a command"));
}

constexpr auto wire_layout(Tag<Reply>) {
    using R = Reply;
    using wire::field;
    return wire::make_layout<R>(
        {"Reply", "IMX, IGX or IPX: one ping", ByteOrder::little}, wire::magic("I", "first_letter", ""),
        field(&R::kind, "kind", "", "second letter of the name"), wire::magic("X", "third_letter", ""),
        field(&R::head_id, "head_id", "", "").hex(),
        field(&R::status, "status", "", "bit 0: V5 firmware (881A), sounder (852)").bits(status_names),
        field(&R::head_position, "head_position", "0.3 deg",
              "0 to 1200, 600 is 0 deg; bit 13: clockwise; 872: 128 starboard, 256 port"),
        field(&R::range, "range", "m", "as commanded"),
        field(&R::profile_range, "profile_range", "",
              "2 mm below 5 m, else 10 mm (881A), 10 mm (852); 0: none"),
        wire::count(&R::data_bytes, "data", "data_bytes", "B", "0, 128, 250, 252, 500; 1000 (872)"),
        wire::counted(&R::data, "data", "data", "", "nearest first; two of 4 bits, one of 8, half of 16"),
        wire::constant<std::uint8_t>(0xFC, "end", ""));
}

constexpr auto wire_layout(Tag<PipeReply>) {
    using R = PipeReply;
    using wire::field;
    return wire::make_layout<R>(
        {"PipeReply", "IMX or IPX of an 831L: one ping", ByteOrder::little},
        wire::magic("I", "first_letter", ""), field(&R::kind, "kind", "", "second letter of the name"),
        wire::magic("X", "third_letter", ""),
        field(&R::sonar_type, "sonar_type", "", "0 scanning, 1 fixed; other heads have 10 to 1F here"),
        field(&R::status, "status", "", "another public reader has the bits in the reverse order")
            .bits(pipe_status_names),
        field(&R::head_position, "head_position", "0.3 deg", "0 to 1200, 600 is 0 deg; bit 13: clockwise"),
        field(&R::range_code, "range_code", "",
              "2, 4, 6, 8: 0.125, 0.25, 0.5, 0.75 m; 10, 20, 30, 40, 50, 60: tenths of a metre"),
        field(&R::profile_range, "profile_range", "0.5 mm", "one public driver takes it for cm; 0: none"),
        wire::count(&R::data_bytes, "data", "data_bytes", "B", "250, 0"),
        field(&R::reserved12, "reserved12", "", "0"), field(&R::roll, "roll", "0.025 deg", ""),
        field(&R::pitch, "pitch", "0.025 deg", ""),
        field(&R::roll_acceleration, "roll_acceleration", "0.24414 mg", "gravity included"),
        field(&R::pitch_acceleration, "pitch_acceleration", "0.24414 mg", "gravity included"),
        field(&R::reserved24, "reserved24", "", "0"),
        wire::counted(&R::data, "data", "data", "", "nearest first, 0 to 127"),
        wire::constant<std::uint8_t>(0xFC, "end", ""));
}

constexpr auto wire_layout(Tag<AzimuthReply>) {
    using R = AzimuthReply;
    using wire::field;
    return wire::make_layout<R>(
        {"AzimuthReply", "IAX: where the azimuth drive is", ByteOrder::little},
        wire::magic("IAX", "name", ""), wire::constant<std::uint8_t>(azimuth_head_id, "head_id", ""),
        field(&R::status, "status", "", "").bits(status_names),
        field(&R::azimuth, "azimuth", "0.3 deg", "0 to 1199, 600 is 0 deg"),
        field(&R::reserved7, "reserved7", "", "0"), wire::constant<std::uint8_t>(0xFC, "end", ""));
}

}  // namespace echoloop::imagenex
