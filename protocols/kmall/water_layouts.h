// The field tables of the water column #MWC. Tables only; offsets count from the start of each struct.
#pragma once

#include "protocols/kmall/layouts.h"
#include "protocols/kmall/water_parts.h"

namespace echoloop::kmall {

constexpr auto wire_layout(Tag<WaterTx>) {
    return make_layout<WaterTx>(part_of("WaterTx", "#MWC: the transmission"),
                                field(&WaterTx::size, "size", "B", "of this struct, 12"),
                                field(&WaterTx::sectors, "sectors", "", "number of them"),
                                field(&WaterTx::bytes_per_sector, "bytes_per_sector", "B", "16"),
                                field(&WaterTx::padding, "padding", "", ""),
                                field(&WaterTx::heave, "heave", "m", "at the reference point"));
}
constexpr auto wire_layout(Tag<WaterSector>) {
    return make_layout<WaterSector>(part_of("WaterSector", "#MWC: a transmit sector"),
                                    field(&WaterSector::tilt, "tilt", "deg", "along track"),
                                    field(&WaterSector::frequency, "frequency", "Hz", "centre"),
                                    field(&WaterSector::beam_width, "beam_width", "deg", "along track"),
                                    field(&WaterSector::number, "number", "", "from 0"),
                                    field(&WaterSector::padding, "padding", "", ""));
}
constexpr auto wire_layout(Tag<WaterRx>) {
    return make_layout<WaterRx>(
        part_of("WaterRx", "#MWC: the receiver"), field(&WaterRx::size, "size", "B", "of this struct, 16"),
        field(&WaterRx::beams, "beams", "", "number of them"),
        field(&WaterRx::bytes_per_beam, "bytes_per_beam", "B", "without samples, 16"),
        field(&WaterRx::phase, "phase", "", "0 none, 1 one byte a sample, 2 two bytes"),
        field(&WaterRx::tvg, "tvg", "", "X of X log R + 2 alpha R"),
        field(&WaterRx::tvg_offset, "tvg_offset", "dB", ""),
        field(&WaterRx::sample_rate, "sample_rate", "Hz", ""),
        field(&WaterRx::sound_speed, "sound_speed", "m/s", ""));
}
constexpr auto wire_layout(Tag<WaterBeamInfo>) {
    return make_layout<WaterBeamInfo>(
        part_of("WaterBeamInfo", "#MWC: a beam; amplitudes and phases follow it"),
        field(&WaterBeamInfo::angle, "angle", "deg", "re vertical, positive to port"),
        field(&WaterBeamInfo::start, "start", "", "number of the first sample"),
        field(&WaterBeamInfo::detected, "detected", "", "the bottom, samples; 0: none"),
        field(&WaterBeamInfo::sector, "sector", "", "that lit it"),
        field(&WaterBeamInfo::samples, "samples", "", "number of them"),
        field(&WaterBeamInfo::detected_fine, "detected_fine", "", "the bottom, samples"));
}

}  // namespace echoloop::kmall
