// The field tables of the messages that a SeaNet sonar sends. Tables only.
#pragma once

#include "protocols/seanet/command_layouts.h"

namespace echoloop::seanet {

constexpr auto wire_layout(Tag<Alive>) {
    return make_layout<Alive>(
        payload_of("Alive", "sent once a second"),
        field(&Alive::will_send, "will_send", "", "0x80 while without parameters, else 0").hex(),
        field(&Alive::time_ms, "time_ms", "ms", "since power-up, or as set by SendData"),
        field(&Alive::motor_position, "motor_position", "1/16 grad", "0..6399, 3200 ahead"),
        field(&Alive::head_inf, "head_inf", "", "state of the head").bits(head_inf_names));
}

constexpr auto wire_layout(Tag<VersionData>) {
    return make_layout<VersionData>(
        payload_of("VersionData", "answer to SendVersion"),
        field(&VersionData::software_version, "software_version", "",
              "or a frequency code; sources disagree"),
        field(&VersionData::info_bits, "info_bits", "", "low nibble: board type").hex(),
        field(&VersionData::serial_number, "serial_number", "", ""),
        field(&VersionData::program_length, "program_length", "B", ""),
        field(&VersionData::checksum, "checksum", "", "of the program").hex(),
        field(&VersionData::node, "node", "", "node of the sonar"));
}

constexpr auto wire_layout(Tag<BBPort>) {
    return make_layout<BBPort>(
        {"BBPort", "line settings of one port"},
        field(&BBPort::baud_low, "baud_low", "", "1..7: 2400, 4800, 9600, 19200, 38400, 57600, 115200"),
        field(&BBPort::baud_high, "baud_high", "", "same"),
        field(&BBPort::parity_low, "parity_low", "", "0 none"),
        field(&BBPort::parity_high, "parity_high", "", "0 none"),
        field(&BBPort::data_bits_low, "data_bits_low", "", "0 is 8 bits"),
        field(&BBPort::data_bits_high, "data_bits_high", "", "0 is 8 bits"));
}

constexpr auto wire_layout(Tag<BBUserData>) {
    return make_layout<BBUserData>(
        payload_of("BBUserData", "answer to SendBBUser"),
        field(&BBUserData::surface_control, "surface_control", "", "255").hex(),
        field(&BBUserData::reserved14, "reserved14", "", ""),
        field(&BBUserData::clock, "clock", "", "").hex(),
        field(&BBUserData::length, "length", "B", "of the user block"),
        field(&BBUserData::device_marker, "device_marker", "", "0x0F DST, else not").hex(),
        field(&BBUserData::reserved20, "reserved20", "", ""),
        field(&BBUserData::reserved21, "reserved21", "", ""),
        field(&BBUserData::lan_baud_low, "lan_baud_low", "", "0..5: 25, 125, 625, 312, 156, 78 kbit/s"),
        field(&BBUserData::lan_baud_high, "lan_baud_high", "", "same"),
        field(&BBUserData::lan_sensitivity_low, "lan_sensitivity_low", "", "2 neutral"),
        field(&BBUserData::lan_sensitivity_high, "lan_sensitivity_high", "", "2 neutral"),
        field(&BBUserData::lan_timeout, "lan_timeout", "", "3 usual"),
        field(&BBUserData::a0, "a0", "", "main port"), field(&BBUserData::a1, "a1", "", "AUX port"),
        field(&BBUserData::block1, "block1", "", "by family"),
        field(&BBUserData::half_duplex, "half_duplex", "", "not DST: 1 half duplex"),
        field(&BBUserData::block2, "block2", "", "by family"),
        field(&BBUserData::half_duplex_dst, "half_duplex_dst", "", "DST: 1 half duplex"),
        rest(&BBUserData::rest, {116, 27}, "rest", "", "by family; 116 bytes, 27 in the older form"));
}

constexpr auto wire_layout(Tag<FpgaCalData>) {
    return make_layout<FpgaCalData>(payload_of("FpgaCalData", "sent by a DST after BBUserData"),
                                    field(&FpgaCalData::content, "content", "", "unknown"));
}
constexpr auto wire_layout(Tag<FpgaVersionData>) {
    return make_layout<FpgaVersionData>(payload_of("FpgaVersionData", "sent by a DST after FpgaCalData"),
                                        field(&FpgaVersionData::content, "content", "", "unknown"));
}

constexpr auto wire_layout(Tag<HeadData>) {
    return make_layout<HeadData>(
        payload_of("HeadData", "one line of echoes"),
        count<std::uint16_t>("bins", 31, "total_count", "B", "data_bytes + 31"),
        field(&HeadData::device_type, "device_type", "", "0x11 DST").hex(),
        field(&HeadData::head_status, "head_status", "", "").bits(head_status_names),
        field(&HeadData::sweep_code, "sweep_code", "", "where in the sector"),
        field(&HeadData::hd_ctrl, "hd_ctrl", "", "echo of the command").bits(hd_ctrl_names),
        field(&HeadData::range_scale, "range_scale", "0.1 unit", "echo"),
        field(&HeadData::tx_n, "tx_n", "32 MHz / 2^32", "echo; no meaning on DST"),
        field(&HeadData::gain, "gain", "1/210", ""), field(&HeadData::slope, "slope", "", ""),
        field(&HeadData::ad_span, "ad_span", "80/255 dB", "echo"),
        field(&HeadData::ad_low, "ad_low", "80/255 dB", "echo"),
        field(&HeadData::heading_offset, "heading_offset", "1/16 grad", "0"),
        field(&HeadData::ad_interval, "ad_interval", "640 ns", "echo; two-way time per bin"),
        field(&HeadData::left_limit, "left_limit", "1/16 grad", "echo"),
        field(&HeadData::right_limit, "right_limit", "1/16 grad", "echo"),
        field(&HeadData::step_size, "step_size", "1/16 grad", "echo"),
        field(&HeadData::bearing, "bearing", "1/16 grad", "of this line, 3200 ahead, clockwise"),
        count<std::uint16_t>("bins", 0, "data_bytes", "B", "Dbytes"),
        counted(&HeadData::bins, "bins", "bins", "", "nearest first; one per byte, or two of 4 bits"));
}

constexpr auto wire_layout(Tag<AuxData>) {
    return make_layout<AuxData>(payload_of("AuxData", "bytes from the AUX port"),
                                count<std::uint16_t>("data", 0, "count", "B", "number of bytes"),
                                counted(&AuxData::data, "data", "data", "", "as received"));
}

}  // namespace echoloop::seanet
