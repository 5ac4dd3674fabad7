// Field tables of the records of Teledyne Reson 7k sonars, by the 7k data format definition 3.12 as the
// specification notes give it. Offsets count from the record's content, behind the record frame.
#pragma once

#include "protocols/reson7k/names.h"
#include "protocols/reson7k/sensor_layouts.h"
#include "protocols/wire/layout.h"

namespace echoloop::reson7k {

using wire::count;
using wire::counted;
using wire::field;
using wire::Heading;
using wire::list;
using wire::make_layout;
using wire::rest;
using wire::Tag;

constexpr auto wire_layout(Tag<NetworkFrame>) {
    using N = NetworkFrame;
    return make_layout<N>(
        {"NetworkFrame", "before every packet of a record; only the first packet holds the record frame"},
        field(&N::version, "version", "", "5"), field(&N::offset, "offset", "B", "to the data: 36"),
        field(&N::packets, "packets", "", "of this record"), field(&N::records, "records", "", "1"),
        field(&N::transmission, "transmission", "", "the same in all packets of a record"),
        field(&N::packet_size, "packet_size", "B", "with this frame; at most 60000"),
        field(&N::total_size, "total_size", "B", "of the record"),
        field(&N::sequence, "sequence", "", "from 0"),
        field(&N::destination_device, "destination_device", "", ""),
        field(&N::destination_enumerator, "destination_enumerator", "", ""),
        field(&N::source_enumerator, "source_enumerator", "", ""),
        field(&N::source_device, "source_device", "", ""));
}

constexpr auto wire_layout(Tag<Time7k>) {
    using T = Time7k;
    return make_layout<T>({"Time7k", "UTC"}, field(&T::year, "year", "", ""),
                          field(&T::day, "day", "", "of the year, from 1"),
                          field(&T::seconds, "seconds", "s", ""), field(&T::hours, "hours", "h", ""),
                          field(&T::minutes, "minutes", "min", ""));
}

constexpr auto wire_layout(Tag<RecordFrame>) {
    using R = RecordFrame;
    return make_layout<R>(
        {"RecordFrame", "before every record; behind it a u32 checksum, the sum of all bytes before it"},
        field(&R::version, "version", "", "5"),
        field(&R::offset, "offset", "B", "from the sync word to the record: 60; some hosts have 64"),
        field(&R::sync, "sync", "", "").hex(), field(&R::size, "size", "B", "with frame and checksum"),
        field(&R::optional_offset, "optional_offset", "B", "of optional data; 0: none"),
        field(&R::optional_id, "optional_id", "", ""),
        field(&R::time, "time", "", "of ping records: the end of the transmission"),
        field(&R::record_version, "record_version", "", "1"), field(&R::type, "type", "", "of the record"),
        field(&R::device, "device", "", "7125, 50, 20; 7000: the centre"),
        field(&R::reserved1, "reserved1", "", ""), field(&R::enumerator, "enumerator", "", ""),
        field(&R::reserved2, "reserved2", "", ""), field(&R::flags, "flags", "", "").bits(record_flag_names),
        field(&R::reserved3, "reserved3", "", ""));
}

constexpr auto wire_layout(Tag<Settings>) {
    using S = Settings;
    return make_layout<S>(
        {"Settings", "what 7000 and 7503 share"}, field(&S::frequency, "frequency", "Hz", ""),
        field(&S::sample_rate, "sample_rate", "Hz", ""),
        field(&S::receiver_bandwidth, "receiver_bandwidth", "Hz", ""), field(&S::pulse, "pulse", "s", ""),
        field(&S::pulse_type, "pulse_type", "", "0 CW, 1 linear chirp"),
        field(&S::envelope, "envelope", "", "0 tapered rectangular"),
        field(&S::envelope_parameter, "envelope_parameter", "", ""),
        field(&S::pulse_mode, "pulse_mode", "", "1: single ping"), field(&S::reserved, "reserved", "", ""),
        field(&S::max_rate, "max_rate", "Hz", "the most pings"),
        field(&S::period, "period", "s", "since the last ping"), field(&S::range, "range", "m", "setting"),
        field(&S::power, "power", "dB", "re 1 uPa at 1 m"), field(&S::gain, "gain", "dB", ""),
        field(&S::control, "control", "", "bits 27-28: time state, 3 ok").bits(control_names),
        field(&S::projector, "projector", "", ""),
        field(&S::steering_vertical, "steering_vertical", "rad", ""),
        field(&S::steering_horizontal, "steering_horizontal", "rad", ""),
        field(&S::tx_width_vertical, "tx_width_vertical", "rad", "-3 dB, along the track"),
        field(&S::tx_width_horizontal, "tx_width_horizontal", "rad", "-3 dB, across the track"),
        field(&S::focus, "focus", "m", ""), field(&S::tx_window, "tx_window", "", ""),
        field(&S::tx_window_parameter, "tx_window_parameter", "", ""),
        field(&S::transmit_flags, "transmit_flags", "", "").hex(),
        field(&S::hydrophone, "hydrophone", "", ""), field(&S::rx_window, "rx_window", "", ""),
        field(&S::rx_window_parameter, "rx_window_parameter", "", ""),
        field(&S::receive_flags, "receive_flags", "", "bit 0: roll compensated").hex());
}

constexpr auto wire_layout(Tag<Conditions>) {
    using F = Conditions;
    return make_layout<F>({"Conditions", "what 7000 and 7503 share behind Settings"},
                          field(&F::min_range, "min_range", "m", "bottom filter"),
                          field(&F::max_range, "max_range", "m", "bottom filter"),
                          field(&F::min_depth, "min_depth", "m", "bottom filter"),
                          field(&F::max_depth, "max_depth", "m", "bottom filter"),
                          field(&F::absorption, "absorption", "dB/km", ""),
                          field(&F::sound_speed, "sound_speed", "m/s", ""),
                          field(&F::spreading, "spreading", "dB", "per decade of range"));
}

constexpr auto wire_layout(Tag<SonarSettings>) {
    using S = SonarSettings;
    return make_layout<S>(
        {"SonarSettings", "7000, with every ping"}, field(&S::serial, "serial", "", ""),
        field(&S::ping, "ping", "", "from 1"), field(&S::multi_ping, "multi_ping", "", "0: no multi-ping"),
        field(&S::settings, "settings", "", ""), field(&S::rx_width, "rx_width", "rad", "of a receive beam"),
        field(&S::conditions, "conditions", "", ""), field(&S::reserved, "reserved", "", ""));
}

constexpr auto wire_layout(Tag<Configuration>) {
    using C = Configuration;
    return make_layout<C>(
        {"Configuration", "7001, on request: what the sonar is; of one device"},
        field(&C::serial, "serial", "", ""), field(&C::devices, "devices", "", "that follow; 1 is read"),
        field(&C::device, "device", "", ""), field(&C::description, "description", "", ""),
        field(&C::card, "card", "", "").hex(), field(&C::device_serial, "device_serial", "", ""),
        count(&C::info_size, "info", "info_size", "B", ""),
        counted(&C::info, "info", "info", "", "XML with a 0 at its end"));
}

constexpr auto wire_layout(Tag<BeamGeometry>) {
    using B = BeamGeometry;
    return make_layout<B>(
        {"BeamGeometry", "7004, with every ping: where the beams look"}, field(&B::serial, "serial", "", ""),
        count(&B::beams, "beams", "beams", "", ""),
        counted(&B::along, "beams", "along", "rad", "along the track"),
        counted(&B::across, "beams", "across", "rad", "positive to starboard; beam 0 is the port-most"),
        counted(&B::width_y, "beams", "width_y", "rad", "of the receive beam, -3 dB, along the track"),
        counted(&B::width_x, "beams", "width_x", "rad", "-3 dB, across"),
        rest(&B::delays, {}, "delays", "", "nothing, or f32 samples of each beam"));
}

constexpr auto wire_layout(Tag<Image>) {
    using I = Image;
    return make_layout<I>(
        {"Image", "7011, with every ping: a picture of all beams"}, field(&I::ping, "ping", "", ""),
        field(&I::multi_ping, "multi_ping", "", ""), field(&I::width, "width", "", "beams"),
        field(&I::height, "height", "", "rows"), field(&I::depth, "depth", "B", "of a pixel: 1, 2 or 4"),
        field(&I::reserved1, "reserved1", "", ""), field(&I::compression, "compression", "", ""),
        field(&I::samples, "samples", "", "before compression into rows"),
        field(&I::flags, "flags", "", "bit 0: in dB; 1: not stabilised").hex(),
        field(&I::rx_delay, "rx_delay", "samples", ""), field(&I::reserved2, "reserved2", "", ""),
        rest(&I::pixels, {}, "pixels", "", "rows, nearest first, each of all beams left to right"));
}

constexpr auto wire_layout(Tag<Beamformed>) {
    using B = Beamformed;
    return make_layout<B>(
        {"Beamformed", "7018, with every ping: all samples of all beams"},
        field(&B::serial, "serial", "", ""), field(&B::ping, "ping", "", ""),
        field(&B::multi_ping, "multi_ping", "", ""), count(&B::beams, "beams", "beams", "", ""),
        count(&B::samples, "samples", "samples", "", "per beam; sample 0 is range 0"),
        field(&B::reserved, "reserved", "", ""),
        counted(&B::data, {"samples", "beams"}, "data", "",
                "u16 amplitude, s16 phase in rad x 10430; all beams of a sample, sample by sample"));
}

constexpr auto wire_layout(Tag<Detection>) {
    using D = Detection;
    return make_layout<D>({"Detection", "a point of RawDetections"}, field(&D::beam, "beam", "", "from 0"),
                          field(&D::sample, "sample", "samples", "from the transmission, with fractions"),
                          field(&D::angle, "angle", "rad", "positive to starboard"),
                          field(&D::flags, "flags", "", "").bits(detection_names),
                          field(&D::quality, "quality", "", "").bits(quality_names),
                          field(&D::uncertainty, "uncertainty", "", ""),
                          field(&D::intensity, "intensity", "",
                                "0 to 65535 with gain and time-varied gain, as amplitudes in 7018"),
                          field(&D::gate_min, "gate_min", "samples", ""),
                          field(&D::gate_max, "gate_max", "samples", ""));
}

constexpr auto wire_layout(Tag<RawDetections>) {
    using R = RawDetections;
    return make_layout<R>(
        {"RawDetections", "7027, with every ping: the bottom"}, field(&R::serial, "serial", "", ""),
        field(&R::ping, "ping", "", ""), field(&R::multi_ping, "multi_ping", "", ""),
        count(&R::points, "points", "points", "", ""),
        field(&R::point_size, "point_size", "B", "34; others are not read"),
        field(&R::algorithm, "algorithm", "", "2: G2"), field(&R::flags, "flags", "", "").hex(),
        field(&R::sample_rate, "sample_rate", "Hz", ""), field(&R::tx_angle, "tx_angle", "rad", ""),
        field(&R::roll, "roll", "rad", "applied to the gates"), field(&R::reserved, "reserved", "", ""),
        counted(&R::detections, "points", "detections", "", ""));
}

constexpr auto wire_layout(Tag<WaterColumn>) {
    using W = WaterColumn;
    return make_layout<W>(
        {"WaterColumn", "7042, with every ping: samples of all beams, compressed as command 7042 says"},
        field(&W::serial, "serial", "", ""), field(&W::ping, "ping", "", ""),
        field(&W::multi_ping, "multi_ping", "", ""), field(&W::beams, "beams", "", ""),
        field(&W::samples, "samples", "", "of the range, all of them"),
        field(&W::compressed_samples, "compressed_samples", "", "of the beam that has most"),
        field(&W::flags, "flags", "", "bits 4-7: divisor, 8-11: 0 none, 1 middle, 2 peak, 3 mean")
            .bits(water_column_names),
        field(&W::first_sample, "first_sample", "", "of each beam"),
        field(&W::sample_rate, "sample_rate", "Hz", "of those that are left"),
        field(&W::factor, "factor", "", "of 8-bit amplitudes, if flag 13 is set; else 40"),
        field(&W::reserved, "reserved", "", ""),
        rest(&W::data, {}, "data", "",
             "of each beam: u16 number, u32 samples, samples: u16 amplitude and s16 phase, or the one, or 8 "
             "bits of each"));
}

constexpr auto wire_layout(Tag<RemoteControl>) {
    using R = RemoteControl;
    return make_layout<R>({"RemoteControl", "7500, to the sonar: a command"},
                          field(&R::command, "command", "", ""),
                          field(&R::ticket, "ticket", "", "comes back in the answer"),
                          field(&R::tracking, "tracking", "", "comes back too"),
                          rest(&R::parameters, {}, "parameters", "", "one byte of 0 if there are none"));
}

constexpr auto wire_layout(Tag<Acknowledge>) {
    using A = Acknowledge;
    return make_layout<A>({"Acknowledge", "7501: a command is taken"}, field(&A::ticket, "ticket", "", ""),
                          field(&A::tracking, "tracking", "", ""));
}

constexpr auto wire_layout(Tag<NotAcknowledge>) {
    using N = NotAcknowledge;
    return make_layout<N>({"NotAcknowledge", "7502: a command is refused"},
                          field(&N::ticket, "ticket", "", ""), field(&N::tracking, "tracking", "", ""),
                          field(&N::error, "error", "", ""));
}

constexpr auto wire_layout(Tag<RemoteExtras>) {
    using R = RemoteExtras;
    return make_layout<R>(
        {"RemoteExtras", "what 7503 has behind Conditions"}, field(&R::vernier_mode, "vernier_mode", "", ""),
        field(&R::search_window, "search_window", "%", "of the depth"),
        field(&R::tx_offset, "tx_offset", "m", "of the projector from the receive array: x, y, z"),
        field(&R::head_tilt, "head_tilt", "rad", "about x, y, z"),
        field(&R::ping_state, "ping_state", "", "0 off, 1 on, 2 external trigger"),
        field(&R::beam_spacing, "beam_spacing", "", "1 equi-angle, 2 equi-distant, 3 flex, 4 intermediate"),
        field(&R::mode, "mode", "", "0 normal, 1 auto pilot, 2 calibration"),
        field(&R::adaptive_gate, "adaptive_gate", "m", "least and greatest depth"),
        field(&R::trigger_out, "trigger_out", "", "length and offset"),
        field(&R::projector_81xx, "projector_81xx", "", ""), field(&R::reserved1, "reserved1", "", ""),
        field(&R::other_gain, "other_gain", "dB", "of the method that is not selected; 81xx only"),
        field(&R::vernier_filter, "vernier_filter", "", ""), field(&R::reserved2, "reserved2", "", ""),
        field(&R::custom_beams, "custom_beams", "", "number of beams"),
        field(&R::coverage, "coverage", "rad", "of the swath"),
        field(&R::coverage_mode, "coverage_mode", "", ""),
        field(&R::quality_filter, "quality_filter", "", "bit 0: on").hex(),
        field(&R::rx_steering, "rx_steering", "rad", "positive to starboard"),
        field(&R::flex_sector, "flex_sector", "rad", "coverage and steering"),
        field(&R::constant_spacing, "constant_spacing", "m", ""),
        field(&R::beam_mode, "beam_mode", "", "of those in 7001, from 0"),
        field(&R::gate_tilt, "gate_tilt", "rad", "of the depth filter, positive to starboard"),
        field(&R::applied_frequency, "applied_frequency", "Hz", ""),
        field(&R::element, "element", "", "of record 7049"));
}

constexpr auto wire_layout(Tag<RemoteSettings>) {
    using R = RemoteSettings;
    return make_layout<R>({"RemoteSettings", "7503, with every ping and on request"},
                          field(&R::serial, "serial", "", ""), field(&R::ping, "ping", "", "0: on request"),
                          field(&R::settings, "settings", "", "as in 7000"),
                          field(&R::conditions, "conditions", "",
                                "as in 7000, but without the width of a receive beam before it"),
                          field(&R::extras, "extras", "", ""),
                          rest(&R::more, {}, "more", "", "later versions add to the 260 bytes"));
}

constexpr auto wire_layout(Tag<AbsorptionLoss>) {
    return make_layout<AbsorptionLoss>({"AbsorptionLoss", "7611, to the sonar: for its time-varied gain"},
                                       field(&AbsorptionLoss::loss, "loss", "dB/km", ""));
}

constexpr auto wire_layout(Tag<SpreadingLoss>) {
    return make_layout<SpreadingLoss>({"SpreadingLoss", "7612, to the sonar: for its time-varied gain"},
                                      field(&SpreadingLoss::loss, "loss", "dB", "per decade of range"));
}

constexpr auto wire_layout(Tag<FileDevice>) {
    return make_layout<FileDevice>({"FileDevice", "of FileHeader"},
                                   field(&FileDevice::device, "device", "", ""),
                                   field(&FileDevice::enumerator, "enumerator", "", ""));
}

constexpr auto wire_layout(Tag<FileHeader>) {
    using F = FileHeader;
    return make_layout<F>(
        {"FileHeader", "7200, the first record of a file"}, field(&F::file_id, "file_id", "", ""),
        field(&F::version, "version", "", ""), field(&F::reserved, "reserved", "", ""),
        field(&F::session_id, "session_id", "", ""), field(&F::data_size, "data_size", "B", ""),
        count(&F::count, "devices", "count", "", ""), field(&F::name, "name", "", ""),
        field(&F::program, "program", "", ""), field(&F::user, "user", "", ""),
        field(&F::notes, "notes", "", ""), counted(&F::devices, "devices", "devices", "", ""),
        rest(&F::optional, {}, "optional", "", "nothing, or u32 size and u64 offset of the catalog"));
}

constexpr auto wire_layout(Tag<CatalogueEntry>) {
    using E = CatalogueEntry;
    return make_layout<E>({"CatalogueEntry", "of FileCatalogue: one record of the file"},
                          field(&E::size, "size", "B", ""), field(&E::offset, "offset", "B", "in the file"),
                          field(&E::record_type, "record_type", "", ""), field(&E::device, "device", "", ""),
                          field(&E::enumerator, "enumerator", "", ""), field(&E::time, "time", "", ""),
                          field(&E::records, "records", "", ""), field(&E::reserved, "reserved", "", ""));
}
constexpr auto wire_layout(Tag<FileCatalogue>) {
    using F = FileCatalogue;
    return make_layout<F>({"FileCatalogue", "7300, the last record of a file"},
                          field(&F::header_size, "header_size", "B", "of what stands before the entries, 14"),
                          field(&F::version, "version", "", ""), count(&F::count, "entries", "count", "", ""),
                          field(&F::reserved, "reserved", "", ""),
                          counted(&F::entries, "entries", "entries", "", ""));
}

}  // namespace echoloop::reson7k
