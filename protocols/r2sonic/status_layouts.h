// The field tables of R2Sonic's status sections. Tables only; offsets count from the start of the section.
#pragma once

#include "protocols/r2sonic/names.h"
#include "protocols/r2sonic/status.h"
#include "protocols/wire/layout.h"

namespace echoloop::r2sonic {

using namespace wire;

constexpr Heading status_of(std::string_view tag, std::string_view help) {
    return {tag, help, ByteOrder::big, 4, tag};
}

constexpr auto wire_layout(Tag<Ser3>) {
    return make_layout<Ser3>(status_of("SER3", "serial number"), field(&Ser3::serial, "serial", "", ""));
}
constexpr auto wire_layout(Tag<Prt3>) {
    return make_layout<Prt3>(status_of("PRT3", "part number"), field(&Prt3::part, "part", "", ""));
}
constexpr auto wire_layout(Tag<Mdl3>) {
    return make_layout<Mdl3>(status_of("MDL3", "model number"), field(&Mdl3::model, "model", "", ""));
}
constexpr auto wire_layout(Tag<Fwv6>) {
    return make_layout<Fwv6>(status_of("FWV6", "firmware of the controller"),
                             field(&Fwv6::firmware, "firmware", "", "date and time"));
}
constexpr auto wire_layout(Tag<Fwt6>) {
    return make_layout<Fwt6>(status_of("FWT6", "firmware of the transmitter, head only"),
                             field(&Fwt6::firmware, "firmware", "", "date and time"));
}
constexpr auto wire_layout(Tag<Prj9>) {
    return make_layout<Prj9>(status_of("PRJ9", "projector, head only"),
                             field(&Prj9::serial, "serial", "", ""), field(&Prj9::part, "part", "", ""),
                             field(&Prj9::model, "model", "", ""));
}
constexpr auto wire_layout(Tag<Opt1>) {
    return make_layout<Opt1>(status_of("OPT1", "options, head only"),
                             field(&Opt1::options, "options", "", "").bits(option_names));
}
constexpr auto wire_layout(Tag<SenA>) {
    return make_layout<SenA>(
        status_of("SENa", "sensors, head only"), field(&SenA::gps_seconds, "gps_seconds", "s", ""),
        field(&SenA::gps_fraction, "gps_fraction", "2^-32 s", ""), field(&SenA::pitch, "pitch", "rad", ""),
        field(&SenA::roll, "roll", "rad", ""), field(&SenA::heave, "heave", "m", ""),
        field(&SenA::heading, "heading", "", "not implemented"),
        field(&SenA::sound_speed, "sound_speed", "m/s", ""),
        field(&SenA::depth_uncalibrated, "depth_uncalibrated", "", ""),
        field(&SenA::depth, "depth", "m", "calibrated"),
        field(&SenA::fpga_temperature, "fpga_temperature", "C", ""));
}
constexpr auto wire_layout(Tag<Sen7>) {
    return make_layout<Sen7>(
        status_of("SEN7", "sensors, SIM only"), field(&Sen7::gps_seconds, "gps_seconds", "s", ""),
        field(&Sen7::gps_fraction, "gps_fraction", "2^-32 s", ""), field(&Sen7::pitch, "pitch", "rad", ""),
        field(&Sen7::roll, "roll", "rad", ""), field(&Sen7::heave, "heave", "m", ""),
        field(&Sen7::reserved, "reserved", "", "0"), field(&Sen7::sound_speed, "sound_speed", "m/s", ""));
}
constexpr auto wire_layout(Tag<Adc3>) {
    return make_layout<Adc3>(status_of("ADC3", "supply, head only"),
                             field(&Adc3::supply_voltage, "supply_voltage", "V", "nominal 48"),
                             field(&Adc3::supply_current, "supply_current", "A", ""),
                             field(&Adc3::transmitter_voltage, "transmitter_voltage", "V", ""));
}
constexpr auto wire_layout(Tag<Adc2>) {
    return make_layout<Adc2>(status_of("ADC2", "supply, SIM only"),
                             field(&Adc2::supply_voltage, "supply_voltage", "V", "nominal 48"),
                             field(&Adc2::supply_current, "supply_current", "A", ""));
}
constexpr auto wire_layout(Tag<Eth6>) {
    return make_layout<Eth6>(status_of("ETH6", "Ethernet"), field(&Eth6::link, "link", "Mbit/s", ""),
                             field(&Eth6::rx_packets, "rx_packets", "", ""),
                             field(&Eth6::tx_packets, "tx_packets", "", ""),
                             field(&Eth6::rx_overflows, "rx_overflows", "", ""),
                             field(&Eth6::mac, "mac", "", "the last 6 bytes are used"));
}
constexpr auto wire_layout(Tag<Tim2>) {
    return make_layout<Tim2>(status_of("TIM2", "timing"),
                             field(&Tim2::round_trip, "round_trip", "s", "head to SIM and back, below 3 ms"),
                             field(&Tim2::spare, "spare", "", ""));
}
constexpr auto wire_layout(Tag<Led1>) {
    return make_layout<Led1>(
        status_of("LED1", "lamps, SIM only"),
        field(&Led1::lamps, "lamps", "",
              "2 bits each: gps, motion, heading, svp, 4 alternates, pps, sync in, out, head")
            .hex());
}

}  // namespace echoloop::r2sonic
