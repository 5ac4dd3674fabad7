// The field tables of R2Sonic's datagrams. Tables only; offsets count from the start of the datagram.
#pragma once

#include "protocols/r2sonic/messages.h"
#include "protocols/r2sonic/section_layouts.h"
#include "protocols/r2sonic/status_layouts.h"
#include "protocols/r2sonic/water_layouts.h"

namespace echoloop::r2sonic {

constexpr Heading packet_of(std::string_view name, std::string_view help) {
    return {name, help, ByteOrder::big, 0};
}
constexpr auto packet_name(std::string_view name) { return magic(name, "name", "name of the packet"); }
constexpr auto packet_size() { return total_size<std::uint32_t>("packet_size", "of the datagram"); }

constexpr auto wire_layout(Tag<Bth0>) {
    return make_layout<Bth0>(
        packet_of("BTH0", "bathymetry, one datagram a ping"), packet_name("BTH0"), packet_size(),
        field(&Bth0::stream_id, "stream_id", "", "0"), section(&Bth0::h0, "h0", "settings"),
        section(&Bth0::r0, "r0", "ranges"), section(&Bth0::angles, "angles", "one of both"),
        section(&Bth0::i1, "i1", "intensities, if BIE0 is 1"), section(&Bth0::g0, "g0", "depth gate"),
        section(&Bth0::g1, "g1", "gates, if verbose"), section(&Bth0::q0, "q0", "quality"));
}
constexpr auto wire_layout(Tag<Aid0Head>) {
    return make_layout<Aid0Head>(
        packet_of("AID0 head", "first datagram of an acoustic image"), packet_name("AID0"), packet_size(),
        field(&Aid0Head::stream_id, "stream_id", "", "0"), section(&Aid0Head::h0, "h0", "settings"),
        section(&Aid0Head::a1, "a1", "beam angles"));
}
constexpr auto wire_layout(Tag<Aid0Data>) {
    return make_layout<Aid0Data>(packet_of("AID0 data", "part of an acoustic image"), packet_name("AID0"),
                                 packet_size(), field(&Aid0Data::stream_id, "stream_id", "", "0"),
                                 section(&Aid0Data::m0, "m0", "samples"));
}
constexpr auto wire_layout(Tag<Wcd0Head>) {
    return make_layout<Wcd0Head>(
        packet_of("WCD0 head", "first datagram of a water column"), packet_name("WCD0"), packet_size(),
        field(&Wcd0Head::stream_id, "stream_id", "", "0"), section(&Wcd0Head::h0, "h0", "settings"),
        section(&Wcd0Head::a1, "a1", "beam angles"));
}
constexpr auto wire_layout(Tag<Wcd0Data>) {
    return make_layout<Wcd0Data>(packet_of("WCD0 data", "part of a water column"), packet_name("WCD0"),
                                 packet_size(), field(&Wcd0Data::stream_id, "stream_id", "", "0"),
                                 section(&Wcd0Data::samples, "samples", "one of both"));
}
constexpr auto wire_layout(Tag<Sni0>) {
    return make_layout<Sni0>(packet_of("SNI0", "snippets"), packet_name("SNI0"), packet_size(),
                             field(&Sni0::stream_id, "stream_id", "", "0"),
                             section(&Sni0::h0, "h0", "settings, in the first datagram of a ping"),
                             section(&Sni0::s1, "s1", "one snippet or more"));
}
constexpr auto wire_layout(Tag<Tpx0>) {
    return make_layout<Tpx0>(packet_of("TPX0", "part of a TruePix ping"), packet_name("TPX0"), packet_size(),
                             field(&Tpx0::stream_id, "stream_id", "", "0"),
                             section(&Tpx0::h0, "h0", "settings, in the first datagram of a ping"),
                             section(&Tpx0::samples, "samples", "one of both"));
}
constexpr auto wire_layout(Tag<Sth0>) {
    return make_layout<Sth0>(packet_of("STH0", "status of the head"), packet_name("STH0"), packet_size(),
                             field(&Sth0::stream_id, "stream_id", "", "0"),
                             tagged_list(&Sth0::sections, "sections", "in any order"));
}
constexpr auto wire_layout(Tag<Sts0>) {
    return make_layout<Sts0>(packet_of("STS0", "status of the SIM"), packet_name("STS0"), packet_size(),
                             field(&Sts0::stream_id, "stream_id", "", "0"),
                             tagged_list(&Sts0::sections, "sections", "in any order"));
}

constexpr auto wire_layout(Tag<R2ds>) {
    return make_layout<R2ds>(packet_of("R2DS", "short status, every 1.3 s"), packet_name("R2DS"),
                             field(&R2ds::serial, "serial", "", ""),
                             field(&R2ds::config_id, "config_id", "", "from the latest R2DC"),
                             field(&R2ds::reserved, "reserved", "", "0"));
}
constexpr auto wire_layout(Tag<R2dd>) {
    return make_layout<R2dd>(packet_of("R2DD", "discovery request"), packet_name("R2DD"),
                             field(&R2dd::gui_ip, "gui_ip", "", "who asks").ipv4(),
                             field(&R2dd::gui_port, "gui_port", "", "GUI base port"),
                             field(&R2dd::reserved10, "reserved10", "", "0"),
                             field(&R2dd::reserved12, "reserved12", "", "0"));
}
constexpr auto wire_layout(Tag<R2di>) {
    return make_layout<R2di>(packet_of("R2DI", "discovery answer"), packet_name("R2DI"),
                             field(&R2di::serial, "serial", "", ""), field(&R2di::part, "part", "", ""),
                             field(&R2di::model, "model", "", ""),
                             field(&R2di::reserved, "reserved", "", "0"));
}
constexpr auto wire_layout(Tag<R2dc>) {
    return make_layout<R2dc>(
        packet_of("R2DC", "network configuration"), packet_name("R2DC"),
        field(&R2dc::serial, "serial", "", "who is meant"),
        field(&R2dc::config_id, "config_id", "", "copied to R2DS"), field(&R2dc::mask, "mask", "", "").ipv4(),
        field(&R2dc::gateway, "gateway", "", "").ipv4(), field(&R2dc::gui_ip, "gui_ip", "", "").ipv4(),
        field(&R2dc::gui_port, "gui_port", "", "base port"),
        field(&R2dc::system_index, "system_index", "", ""), field(&R2dc::head_ip, "head_ip", "", "").ipv4(),
        field(&R2dc::head_port, "head_port", "", "base ports"), field(&R2dc::sim_ip, "sim_ip", "", "").ipv4(),
        field(&R2dc::sim_port, "sim_port", "", "base ports"),
        field(&R2dc::daq_ip, "daq_ip", "", "data acquisition hosts").ipv4(),
        field(&R2dc::daq_port, "daq_port", "", "base ports"), field(&R2dc::reserved, "reserved", "", "0"));
}

constexpr auto wire_layout(Tag<Command>) {
    return make_layout<Command>({"Command", "one setting", ByteOrder::big},
                                field(&Command::name, "name", "", "e.g. RNG0"),
                                field(&Command::raw, "raw", "", "u32 or f32, by the name").hex());
}
constexpr auto wire_layout(Tag<Cmd0>) {
    return make_layout<Cmd0>(packet_of("CMD0", "settings, no acknowledge"), packet_name("CMD0"),
                             list(&Cmd0::commands, "commands", "any number"));
}

}  // namespace echoloop::r2sonic
