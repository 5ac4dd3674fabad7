// The field tables of the packets of a Norbit WBMS. Tables only. Payload layouts start at byte 24.
#pragma once

#include "protocols/norbit/messages.h"
#include "protocols/norbit/names.h"
#include "protocols/wire/layout.h"

namespace echoloop::norbit {

using namespace wire;

inline constexpr std::size_t header_bytes = 24;

constexpr Heading payload_of(std::string_view name, std::string_view help) {
    return {name, help, ByteOrder::little, header_bytes};
}

constexpr auto wire_layout(Tag<Header>) {
    return make_layout<Header>(
        {"Header", "before every packet"}, constant(0xDEADBEEFU, "start", "always the same"),
        field(&Header::type, "type", "", "what follows"),
        field(&Header::size, "size", "B", "of the packet, with this header"),
        field(&Header::version, "version", "", "4 in the document; one reader refuses others"),
        field(&Header::reserved, "reserved", "", "0"),
        field(&Header::crc, "crc", "", "CRC-32 of what follows; reserved in types 4 and 5").hex());
}

constexpr auto wire_layout(Tag<Point>) {
    return make_layout<Point>(
        {"Point", "a sounding; range = sample x sound_speed / (2 x sample_rate)"},
        field(&Point::sample, "sample", "", "two-way time"),
        field(&Point::angle, "angle", "rad", "from nadir"),
        field(&Point::upper_gate, "upper_gate", "samples", "the bottom is looked for from here"),
        field(&Point::lower_gate, "lower_gate", "samples", "to here"),
        field(&Point::intensity, "intensity", "", "of the echo"),
        field(&Point::flags, "flags", "", "not used in the document; newer: method").bits(flag_names),
        field(&Point::quality, "quality", "", "3: good").bits(quality_names),
        field(&Point::snr, "snr", "", "sqrt(16 x signal / noise): 0 dB 4, 20 dB 13"));
}

constexpr auto wire_layout(Tag<Bathymetry>) {
    using B = Bathymetry;
    return make_layout<B>(
        payload_of("Bathymetry", "soundings of one ping, TCP port 2210"),
        field(&B::sound_speed, "sound_speed", "m/s", "used"),
        field(&B::sample_rate, "sample_rate", "Hz", "of the points' samples"),
        count<std::uint32_t>("points", 0, "point_count", "", "number of points"),
        field(&B::ping, "ping", "", "1 more each ping"),
        field(&B::transmit_time, "transmit_time", "s", "of the transmission"),
        field(&B::send_time, "send_time", "s", "of this packet"), field(&B::ping_rate, "ping_rate", "Hz", ""),
        field(&B::data_type, "data_type", "", "4"), field(&B::beam_mode, "beam_mode", "", ""),
        field(&B::sonar_mode, "sonar_mode", "", ""),
        field(&B::time_uncertainty, "time_uncertainty", "s", "newer"),
        field(&B::multi_pings, "multi_pings", "", "newer: in a multi-ping"),
        field(&B::multi_ping, "multi_ping", "", "newer: number of this one"),
        field(&B::tx_angle, "tx_angle", "rad", ""), field(&B::intensity_gain, "intensity_gain", "", ""),
        field(&B::frequency, "frequency", "Hz", ""), field(&B::bandwidth, "bandwidth", "Hz", ""),
        field(&B::pulse, "pulse", "s", ""), field(&B::raw_sound_speed, "raw_sound_speed", "m/s", "newer"),
        field(&B::tx_voltage, "tx_voltage", "V", "NaN: none"),
        field(&B::swath_direction, "swath_direction", "rad", ""),
        field(&B::swath_opening, "swath_opening", "rad", ""), field(&B::gate_tilt, "gate_tilt", "rad", ""),
        counted(&B::points, "points", "points", "", "one a beam"));
}

constexpr auto wire_layout(Tag<WaterColumn>) {
    using W = WaterColumn;
    return make_layout<W>(
        payload_of("WaterColumn",
                   "an image, TCP port 2211; range = (t0 + row) x sound_speed / (2 x sample_rate)"),
        field(&W::sound_speed, "sound_speed", "m/s", "used"),
        field(&W::sample_rate, "sample_rate", "Hz", "of the rows"), field(&W::beams, "beams", "", "columns"),
        field(&W::samples, "samples", "", "rows"),
        field(&W::transmit_time, "transmit_time", "s", "of the transmission"),
        field(&W::sample, "sample", "", "type of a sample"),
        field(&W::t0, "t0", "samples", "of the first row"), field(&W::gain, "gain", "dB", ""),
        field(&W::spare1, "spare1", "", "0"), field(&W::swath_direction, "swath_direction", "rad", ""),
        field(&W::swath_opening, "swath_opening", "rad", ""),
        field(&W::frequency, "frequency", "kHz or Hz", "kHz in the document, Hz in newer readers"),
        field(&W::bandwidth, "bandwidth", "kHz or Hz", "as the frequency"),
        field(&W::pulse, "pulse", "s", ""), field(&W::amplitude, "amplitude", "", "0 to 15"),
        field(&W::spare2, "spare2", "", "0"), field(&W::ping_rate, "ping_rate", "Hz", ""),
        field(&W::spare3, "spare3", "", "0"), field(&W::ping, "ping", "", "1 more each ping"),
        field(&W::send_time, "send_time", "s", "of this packet"),
        field(&W::beamformer_beams, "beamformer_beams", "", ""),
        field(&W::t1, "t1", "samples", "up to here the gain is g1"),
        field(&W::g1, "g1", "dB", "f32 in the document, s32 in newer readers").hex(),
        field(&W::t2, "t2", "samples", "from here the gain is g2, linear between"),
        field(&W::g2, "g2", "dB", "as g1").hex(), field(&W::spare4, "spare4", "", "0"),
        field(&W::tx_angle, "tx_angle", "rad", ""), field(&W::tx_voltage, "tx_voltage", "V", "NaN: none"),
        field(&W::beam_mode, "beam_mode", "", ""), field(&W::sonar_mode, "sonar_mode", "", ""),
        field(&W::spare5, "spare5", "", "0"), field(&W::gate_tilt, "gate_tilt", "rad", ""),
        field(&W::spare6, "spare6", "", "0"),
        rest(&W::tail, {}, "tail", "",
             "samples x beams of the type above, then f32 angles in rad, one a beam"));
}

}  // namespace echoloop::norbit
