// The field tables of the SeaNet frame and of the messages that a host sends. Tables only.
// Payload layouts start at byte 13 of the frame.
#pragma once

#include "protocols/seanet/messages.h"
#include "protocols/seanet/names.h"
#include "protocols/wire/layout.h"

namespace echoloop::seanet {

using namespace wire;

constexpr Heading payload_of(std::string_view name, std::string_view help) {
    return {name, help, ByteOrder::little, 13};
}

constexpr auto wire_layout(Tag<Header>) {
    return make_layout<Header>(
        {"Header", "nodes, id and sequence", ByteOrder::little, 7},
        field(&Header::tx_node, "tx_node", "", "sender: 255 host, 2 imaging sonar, 20 profiler"),
        field(&Header::rx_node, "rx_node", "", "receiver"),
        field(&Header::remaining, "remaining", "B", "length - 5; 0 in HeadData"),
        field(&Header::id, "id", "", "message id"),
        field(&Header::sequence, "sequence", "", "bit 7 last packet, bits 0-6 number").hex(),
        field(&Header::node, "node", "", "tx_node in replies, rx_node in commands"));
}

constexpr auto wire_layout(Tag<Frame>) {
    return make_layout<Frame>(
        {"Frame", "one frame from '@' to LF"}, constant<std::uint8_t>('@', "start", "always '@'"),
        count<HexDigits4>("payload", 8, "length_hex", "B", "length as upper-case hex digits"),
        count<std::uint16_t>("payload", 8, "length", "B", "frame bytes - 6"),
        field(&Frame::header, "header", "", "bytes 7 to 12"),
        counted(&Frame::payload, "payload", "payload", "", "the message"),
        constant<std::uint8_t>('\n', "end", "always LF"));
}

constexpr auto wire_layout(Tag<ReBoot>) {
    return make_layout<ReBoot>(payload_of("ReBoot", "restart; no reply"));
}
constexpr auto wire_layout(Tag<SendVersion>) {
    return make_layout<SendVersion>(payload_of("SendVersion", "asks for VersionData"));
}
constexpr auto wire_layout(Tag<SendBBUser>) {
    return make_layout<SendBBUser>(payload_of("SendBBUser", "asks for BBUserData"));
}
constexpr auto wire_layout(Tag<StopAlives>) {
    return make_layout<StopAlives>(payload_of("StopAlives", "no alives until reboot"));
}
constexpr auto wire_layout(Tag<SendData>) {
    return make_layout<SendData>(payload_of("SendData", "asks for HeadData"),
                                 field(&SendData::time_ms, "time_ms", "ms", "time of day, often 0"));
}

constexpr auto wire_layout(Tag<HeadParameters>) {
    return make_layout<HeadParameters>(
        {"HeadParameters", "settings of the head", ByteOrder::little, 14},
        field(&HeadParameters::hd_ctrl, "hd_ctrl", "", "control word").bits(hd_ctrl_names),
        field(&HeadParameters::hd_type, "hd_type", "", "2 imaging, 3 sidescan, 5 profiler, 17 DST").hex(),
        field(&HeadParameters::tx_n1, "tx_n1", "32 MHz / 2^32", "transmit frequency, channel 1; not DST"),
        field(&HeadParameters::tx_n2, "tx_n2", "32 MHz / 2^32", "transmit frequency, channel 2; not DST"),
        field(&HeadParameters::rx_n1, "rx_n1", "32 MHz / 2^32",
              "transmit frequency + 455 kHz, channel 1; not DST"),
        field(&HeadParameters::rx_n2, "rx_n2", "32 MHz / 2^32",
              "transmit frequency + 455 kHz, channel 2; not DST"),
        field(&HeadParameters::tx_pulse, "tx_pulse", "us", "pulse length"),
        field(&HeadParameters::range_scale, "range_scale", "0.1 unit",
              "bits 0-13 range, bits 14-15 m, ft, fathom, yd; informational"),
        field(&HeadParameters::left_limit, "left_limit", "1/16 grad",
              "sector start; ignored in continuous mode"),
        field(&HeadParameters::right_limit, "right_limit", "1/16 grad", "sector end"),
        field(&HeadParameters::ad_span, "ad_span", "80/255 dB", "dynamic range of 4-bit bins"),
        field(&HeadParameters::ad_low, "ad_low", "80/255 dB", "level of the lowest 4-bit bin"),
        field(&HeadParameters::initial_gain1, "initial_gain1", "1/210", "gain, channel 1"),
        field(&HeadParameters::initial_gain2, "initial_gain2", "1/210", "gain, channel 2"),
        field(&HeadParameters::slope1, "slope1", "", "gain slope, channel 1; not DST"),
        field(&HeadParameters::slope2, "slope2", "", "gain slope, channel 2; not DST"),
        field(&HeadParameters::motor_time, "motor_time", "10 us", "per motor step"),
        field(&HeadParameters::step_size, "step_size", "1/16 grad", "angle between lines"),
        field(&HeadParameters::ad_interval, "ad_interval", "640 ns", "two-way time per bin"),
        field(&HeadParameters::bins, "bins", "", "range bins per line"),
        field(&HeadParameters::max_ad_buffer, "max_ad_buffer", "", "500 usual"),
        field(&HeadParameters::lockout, "lockout", "us", "nothing is recorded before"),
        field(&HeadParameters::minor_axis_direction, "minor_axis_direction", "1/16 grad", "1600 usual"),
        field(&HeadParameters::major_axis_pan, "major_axis_pan", "", "1 usual"),
        field(&HeadParameters::ctl2, "ctl2", "", "0").hex(),
        field(&HeadParameters::scan_z, "scan_z", "", "0"));
}

constexpr auto wire_layout(Tag<V3B>) {
    return make_layout<V3B>({"V3B", "gain block of two channels", ByteOrder::little, 14},
                            field(&V3B::ad_span1, "ad_span1", "80/255 dB", "channel 1"),
                            field(&V3B::ad_span2, "ad_span2", "80/255 dB", "channel 2"),
                            field(&V3B::ad_low1, "ad_low1", "80/255 dB", "channel 1"),
                            field(&V3B::ad_low2, "ad_low2", "80/255 dB", "channel 2"),
                            field(&V3B::initial_gain1, "initial_gain1", "1/210", "channel 1"),
                            field(&V3B::initial_gain2, "initial_gain2", "1/210", "channel 2"),
                            field(&V3B::adc_set_point1, "adc_set_point1", "", "channel 1"),
                            field(&V3B::adc_set_point2, "adc_set_point2", "", "channel 2"),
                            field(&V3B::adv_slope1, "adv_slope1", "", "channel 1"),
                            field(&V3B::adv_slope2, "adv_slope2", "", "channel 2"),
                            field(&V3B::slope_delay1, "slope_delay1", "", "channel 1"),
                            field(&V3B::slope_delay2, "slope_delay2", "", "channel 2"));
}

constexpr auto wire_layout(Tag<HeadCommand>) {
    return make_layout<HeadCommand>(payload_of("HeadCommand", "parameters of the head, type 0x01"),
                                    constant(HeadCommandType::normal, "type", "0x01"),
                                    field(&HeadCommand::parameters, "parameters", "", "settings"));
}
constexpr auto wire_layout(Tag<HeadCommandDual>) {
    return make_layout<HeadCommandDual>(
        payload_of("HeadCommandDual", "parameters for two channels, type 0x1D"),
        constant(HeadCommandType::dual, "type", "0x1D"),
        field(&HeadCommandDual::parameters, "parameters", "", "settings"),
        field(&HeadCommandDual::v3b, "v3b", "", "gain block"));
}
constexpr auto wire_layout(Tag<HeadCommandReverse>) {
    return make_layout<HeadCommandReverse>(
        payload_of("HeadCommandReverse", "turn the scan direction, type 0x0F"),
        constant(HeadCommandType::reverse, "type", "0x0F"));
}
constexpr auto wire_layout(Tag<HeadCommandGain>) {
    return make_layout<HeadCommandGain>(payload_of("HeadCommandGain", "gain block only, type 0x1E"),
                                        constant(HeadCommandType::gain, "type", "0x1E"),
                                        field(&HeadCommandGain::v3b, "v3b", "", "gain block"));
}

}  // namespace echoloop::seanet
