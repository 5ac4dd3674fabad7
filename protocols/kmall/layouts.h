// The field tables of all KMALL datagrams and of #MRZ. Tables only; offsets count from the start of each
// struct.
#pragma once

#include "protocols/kmall/parts.h"
#include "protocols/wire/layout.h"

namespace echoloop::kmall {

using wire::field;
using wire::make_layout;
using wire::Tag;

constexpr wire::Heading part_of(std::string_view name, std::string_view help) {
    return {name, help, wire::ByteOrder::little, 0};
}

constexpr auto wire_layout(Tag<Header>) {
    return make_layout<Header>(
        part_of("Header", "begins every datagram"),
        field(&Header::size, "size", "B", "of the datagram; stands again at its end"),
        field(&Header::type, "type", "", "e.g. #MRZ"),
        field(&Header::version, "version", "", "of this type of datagram"),
        field(&Header::system_id, "system_id", "", "tells systems with the same sounder apart"),
        field(&Header::sounder, "sounder", "", "e.g. 2040"),
        field(&Header::seconds, "seconds", "s", "Unix time"),
        field(&Header::nanoseconds, "nanoseconds", "ns", ""));
}
constexpr auto wire_layout(Tag<Partition>) {
    return make_layout<Partition>(part_of("Partition", "which part of a divided datagram this is"),
                                  field(&Partition::parts, "parts", "", "of the whole; 1 in files"),
                                  field(&Partition::part, "part", "", "from 1"));
}
constexpr auto wire_layout(Tag<Body>) {
    return make_layout<Body>(part_of("Body", "which fan of which ping this is"),
                             field(&Body::size, "size", "B", "of this struct, 12"),
                             field(&Body::ping, "ping", "", "counts transmissions"),
                             field(&Body::fans_per_ping, "fans_per_ping", "", ""),
                             field(&Body::fan, "fan", "", "from 0, aft and port first"),
                             field(&Body::swaths_per_ping, "swaths_per_ping", "", ""),
                             field(&Body::swath, "swath", "", "from 0, aft first"),
                             field(&Body::tx_transducer, "tx_transducer", "", "from 0"),
                             field(&Body::rx_transducer, "rx_transducer", "", "from 0"),
                             field(&Body::rx_transducers, "rx_transducers", "", ""),
                             field(&Body::algorithm, "algorithm", "", "0"));
}
constexpr auto wire_layout(Tag<PingInfo>) {
    return make_layout<PingInfo>(
        part_of("PingInfo", "#MRZ: the ping"), field(&PingInfo::size, "size", "B", "of this struct"),
        field(&PingInfo::padding0, "padding0", "", ""), field(&PingInfo::ping_rate, "ping_rate", "Hz", ""),
        field(&PingInfo::beam_spacing, "beam_spacing", "", "0 equidistant, 1 equiangle, 2 high density"),
        field(&PingInfo::depth_mode, "depth_mode", "", "0 very shallow to 7; 100 more: chosen by hand"),
        field(&PingInfo::sub_depth_mode, "sub_depth_mode", "", ""),
        field(&PingInfo::swath_distance, "swath_distance", "%", "achieved of wanted; 0: not used"),
        field(&PingInfo::detection_mode, "detection_mode", "", "0 normal; 100 more: simulator"),
        field(&PingInfo::pulse_form, "pulse_form", "", "0 CW, 1 mix, 2 FM"),
        field(&PingInfo::padding1, "padding1", "", ""),
        field(&PingInfo::frequency, "frequency", "Hz", "frequency mode"),
        field(&PingInfo::lowest_frequency, "lowest_frequency", "Hz",
              "lowest centre frequency of the sectors"),
        field(&PingInfo::highest_frequency, "highest_frequency", "Hz",
              "highest centre frequency of the sectors"),
        field(&PingInfo::pulse_length, "pulse_length", "s", "longest, in all"),
        field(&PingInfo::effective_pulse_length, "effective_pulse_length", "s", "longest, -3 dB"),
        field(&PingInfo::bandwidth, "bandwidth", "Hz", "greatest, -3 dB"),
        field(&PingInfo::absorption, "absorption", "dB/km", ""),
        field(&PingInfo::port_edge, "port_edge", "deg", "of the sector"),
        field(&PingInfo::starboard_edge, "starboard_edge", "deg", "of the sector"),
        field(&PingInfo::port_coverage, "port_coverage", "deg", "achieved"),
        field(&PingInfo::starboard_coverage, "starboard_coverage", "deg", "achieved"),
        field(&PingInfo::port_coverage_m, "port_coverage_m", "m", "achieved"),
        field(&PingInfo::starboard_coverage_m, "starboard_coverage_m", "m", "achieved"),
        field(&PingInfo::stabilisation, "stabilisation", "", "bits"),
        field(&PingInfo::filter1, "filter1", "", "bits"),
        field(&PingInfo::filter2, "filter2", "", "four filters of 4 bits"),
        field(&PingInfo::pipe_tracking, "pipe_tracking", "", ""),
        field(&PingInfo::transmit_array, "transmit_array", "deg", "along track"),
        field(&PingInfo::receive_array, "receive_array", "deg", "across track"),
        field(&PingInfo::power, "power", "dB", "re the greatest"),
        field(&PingInfo::ramp_up, "ramp_up", "%", "time left of a soft start"),
        field(&PingInfo::padding2, "padding2", "", ""), field(&PingInfo::yaw, "yaw", "deg", "correction"),
        field(&PingInfo::tx_sectors, "tx_sectors", "", "number of them"),
        field(&PingInfo::bytes_per_sector, "bytes_per_sector", "B", "36, from version 1 on 48"),
        field(&PingInfo::heading, "heading", "deg", "of the vessel"),
        field(&PingInfo::sound_speed, "sound_speed", "m/s", "at the transducer"),
        field(&PingInfo::transducer_depth, "transducer_depth", "m", "below the water line"),
        field(&PingInfo::water_level, "water_level", "m",
              "of the water line below the reference point; negative above"),
        field(&PingInfo::x_offset, "x_offset", "m", "from the older reference point"),
        field(&PingInfo::y_offset, "y_offset", "m", "from the older reference point"),
        field(&PingInfo::position_info, "position_info", "", "0 last, 1 interpolated, 2 processed"),
        field(&PingInfo::position_status, "position_status", "", "0 valid, 1 invalid"),
        field(&PingInfo::attitude_status, "attitude_status", "", "0 valid, 1 invalid"),
        field(&PingInfo::padding3, "padding3", "", ""),
        field(&PingInfo::latitude, "latitude", "deg", "of the reference point"),
        field(&PingInfo::longitude, "longitude", "deg", "of the reference point"),
        field(&PingInfo::height, "height", "m", "of the reference point above the ellipsoid"),
        field(&PingInfo::bs_offset, "bs_offset", "dB", "from version 1 on"),
        field(&PingInfo::lambert, "lambert", "", "from version 1 on"),
        field(&PingInfo::ice_window, "ice_window", "", "from version 1 on"),
        field(&PingInfo::active_modes, "active_modes", "", "from version 2 on"));
}
constexpr auto wire_layout(Tag<TxSector>) {
    return make_layout<TxSector>(
        part_of("TxSector", "#MRZ: a transmit sector"), field(&TxSector::number, "number", "", "from 0"),
        field(&TxSector::array, "array", "", "from 0"),
        field(&TxSector::sub_array, "sub_array", "", "0 port, 1 middle, 2 starboard"),
        field(&TxSector::padding0, "padding0", "", ""),
        field(&TxSector::delay, "delay", "s", "after the first pulse"),
        field(&TxSector::tilt, "tilt", "deg", "along track, of the array"),
        field(&TxSector::source_level, "source_level", "dB re 1 uPa at 1 m", "nominal"),
        field(&TxSector::focus_range, "focus_range", "m", "0: none"),
        field(&TxSector::frequency, "frequency", "Hz", "centre"),
        field(&TxSector::bandwidth, "bandwidth", "Hz", "CW: 1 / effective pulse length"),
        field(&TxSector::pulse_length, "pulse_length", "s", "in all"),
        field(&TxSector::shading, "shading", "%", "of the pulse in time"),
        field(&TxSector::wave_form, "wave_form", "", "0 CW, 1 FM up, 2 FM down"),
        field(&TxSector::padding1, "padding1", "", ""),
        field(&TxSector::voltage, "voltage", "dB", "from version 1 on"),
        field(&TxSector::tracking, "tracking", "dB", "from version 1 on"),
        field(&TxSector::effective_pulse_length, "effective_pulse_length", "s", "from version 1 on"));
}
constexpr auto wire_layout(Tag<RxInfo>) {
    return make_layout<RxInfo>(
        part_of("RxInfo", "#MRZ: the receiver"), field(&RxInfo::size, "size", "B", "of this struct, 32"),
        field(&RxInfo::soundings, "soundings", "", "of the bottom, at most"),
        field(&RxInfo::valid, "valid", "", "of them"),
        field(&RxInfo::bytes_per_sounding, "bytes_per_sounding", "B", "120"),
        field(&RxInfo::water_column_rate, "water_column_rate", "Hz", "samples"),
        field(&RxInfo::seabed_image_rate, "seabed_image_rate", "Hz", "samples"),
        field(&RxInfo::bs_normal, "bs_normal", "dB", "backscatter at normal incidence"),
        field(&RxInfo::bs_oblique, "bs_oblique", "dB", "backscatter at oblique incidence"),
        field(&RxInfo::alarm, "alarm", "", "of extra detections"),
        field(&RxInfo::extra_detections, "extra_detections", "",
              "soundings in the water column, behind those of the bottom"),
        field(&RxInfo::classes, "classes", "", "of extra detections"),
        field(&RxInfo::bytes_per_class, "bytes_per_class", "B", "4"));
}
constexpr auto wire_layout(Tag<DetectionClass>) {
    return make_layout<DetectionClass>(part_of("DetectionClass", "#MRZ: a class of extra detections"),
                                       field(&DetectionClass::detections, "detections", "", "in this class"),
                                       field(&DetectionClass::padding, "padding", "", ""),
                                       field(&DetectionClass::alarm, "alarm", "", "0, 1"));
}
constexpr auto wire_layout(Tag<Sounding>) {
    return make_layout<Sounding>(
        part_of("Sounding", "#MRZ: one beam"), field(&Sounding::index, "index", "", "from 0"),
        field(&Sounding::sector, "sector", "", "that lit it"),
        field(&Sounding::type, "type", "", "0 normal, 1 extra, 2 rejected"),
        field(&Sounding::method, "method", "", "0 none, 1 amplitude, 2 phase"),
        field(&Sounding::rejection1, "rejection1", "", ""),
        field(&Sounding::rejection2, "rejection2", "", ""),
        field(&Sounding::post_processing, "post_processing", "", ""),
        field(&Sounding::detection_class, "detection_class", "", "of extra detections"),
        field(&Sounding::confidence, "confidence", "", ""), field(&Sounding::padding, "padding", "", ""),
        field(&Sounding::range_factor, "range_factor", "%", "100 for the bottom"),
        field(&Sounding::quality, "quality", "%", "standard deviation in parts of the depth"),
        field(&Sounding::vertical_uncertainty, "vertical_uncertainty", "m", ""),
        field(&Sounding::horizontal_uncertainty, "horizontal_uncertainty", "m", ""),
        field(&Sounding::window, "window", "s", "length of the detection window"),
        field(&Sounding::echo_length, "echo_length", "s", ""),
        field(&Sounding::water_beam, "water_beam", "", "its beam in #MWC"),
        field(&Sounding::water_range, "water_range", "", "its bottom there, samples"),
        field(&Sounding::water_angle, "water_angle", "deg", "of that beam re vertical"),
        field(&Sounding::absorption, "absorption", "dB/km", "mean, for the time-varied gain"),
        field(&Sounding::reflectivity1, "reflectivity1", "dB", "with the maker's time-varied gain"),
        field(&Sounding::reflectivity2, "reflectivity2", "dB", "with X log R + 2 alpha R"),
        field(&Sounding::sensitivity, "sensitivity", "dB", "of the receiver"),
        field(&Sounding::source_level, "source_level", "dB re 1 uPa at 1 m", "as applied"),
        field(&Sounding::bs_calibration, "bs_calibration", "dB", ""),
        field(&Sounding::tvg, "tvg", "dB", "as applied"),
        field(&Sounding::angle, "angle", "deg", "re the receiver, positive to port"),
        field(&Sounding::angle_correction, "angle_correction", "deg", ""),
        field(&Sounding::time, "time", "s", "two-way"),
        field(&Sounding::time_correction, "time_correction", "s", "two-way"),
        field(&Sounding::delta_latitude, "delta_latitude", "deg", "from the reference point"),
        field(&Sounding::delta_longitude, "delta_longitude", "deg", "from the reference point"),
        field(&Sounding::z, "z", "m", "below the reference point"),
        field(&Sounding::y, "y", "m", "to starboard of it"), field(&Sounding::x, "x", "m", "ahead of it"),
        field(&Sounding::incidence, "incidence", "deg", "adjustment of the angle of incidence"),
        field(&Sounding::cleaning, "cleaning", "", ""),
        field(&Sounding::image_start, "image_start", "",
              "first sample of the seabed image, from the transducer"),
        field(&Sounding::image_centre, "image_centre", "", "its sample at the bottom"),
        field(&Sounding::image_samples, "image_samples", "", "of this beam"));
}

}  // namespace echoloop::kmall
