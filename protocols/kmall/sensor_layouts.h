// The field tables of sensors' datagrams, of #CHE and #FCF. Tables only; offsets count from the start of each
// struct.
#pragma once

#include "protocols/kmall/layouts.h"
#include "protocols/kmall/sensor_parts.h"

namespace echoloop::kmall {

constexpr auto wire_layout(Tag<SensorInfo>) {
    using S = SensorInfo;
    return make_layout<S>(
        part_of("SensorInfo", "begins #SPO, #CPO, #SPE, #SPD, #SCL, #SDE, #SHI, #SHA and #SSM"),
        field(&S::size, "size", "B", "of this struct, 8"),
        field(&S::system, "system", "", "0: POSI_1, ATTI_1, ...; #SCL: bits of its inputs"),
        field(&S::status, "status", "",
              "bits: 0 active, #SCL 1PPS; 2 reduced; 4 invalid; 6 own velocity; 9 own time; "
              "10 motion corrected; 11 operator's quality check"),
        field(&S::padding, "padding", "", ""));
}
constexpr auto wire_layout(Tag<Position>) {
    using P = Position;
    return make_layout<P>(
        part_of("Position", "#SPO, #CPO: behind SensorInfo; the sensor's sentence follows"),
        field(&P::seconds, "seconds", "s", "Unix time of the sensor"),
        field(&P::nanoseconds, "nanoseconds", "ns", ""), field(&P::fix_quality, "fix_quality", "m", ""),
        field(&P::latitude, "latitude", "deg", "200: not known"),
        field(&P::longitude, "longitude", "deg", "200: not known"),
        field(&P::speed, "speed", "m/s", "over ground"), field(&P::course, "course", "deg", "over ground"),
        field(&P::height, "height", "m", "of the reference point above the ellipsoid"));
}
constexpr auto wire_layout(Tag<PositionError>) {
    using P = PositionError;
    return make_layout<P>(part_of("PositionError", "#SPE: behind SensorInfo; the sensor's sentence follows"),
                          field(&P::seconds, "seconds", "s", "Unix time of the sensor"),
                          field(&P::nanoseconds, "nanoseconds", "ns", ""), field(&P::rms, "rms", "m", ""),
                          field(&P::major_axis, "major_axis", "m", ""),
                          field(&P::minor_axis, "minor_axis", "m", ""),
                          field(&P::orientation, "orientation", "deg", "of the error ellipse"),
                          field(&P::latitude, "latitude", "m", ""),
                          field(&P::longitude, "longitude", "m", ""), field(&P::height, "height", "m", ""));
}
constexpr auto wire_layout(Tag<Datum>) {
    using D = Datum;
    return make_layout<D>(part_of("Datum", "#SPD: behind SensorInfo; the sensor's sentence follows"),
                          field(&D::name, "name", "", ""), field(&D::subname, "subname", "", ""),
                          field(&D::latitude_offset, "latitude_offset", "deg", ""),
                          field(&D::longitude_offset, "longitude_offset", "deg", ""),
                          field(&D::altitude_offset, "altitude_offset", "m", ""),
                          field(&D::reference, "reference", "", ""));
}
constexpr auto wire_layout(Tag<Clock>) {
    return make_layout<Clock>(part_of("Clock", "#SCL: behind SensorInfo; the sensor's sentence follows"),
                              field(&Clock::offset, "offset", "s", "set by the operator"),
                              field(&Clock::deviation, "deviation", "ns", "from 1PPS"));
}
constexpr auto wire_layout(Tag<DepthSensor0>) {
    using D = DepthSensor0;
    return make_layout<D>(part_of("DepthSensor0", "#SDE version 0: behind SensorInfo; a sentence follows"),
                          field(&D::depth, "depth", "m", "in use"), field(&D::offset, "offset", "m", ""),
                          field(&D::scale, "scale", "", ""),
                          field(&D::latitude, "latitude", "deg", "200: not known"),
                          field(&D::longitude, "longitude", "deg", "200: not known"));
}
constexpr auto wire_layout(Tag<DepthSensor>) {
    using D = DepthSensor;
    return make_layout<D>(
        part_of("DepthSensor", "#SDE from version 1 on: behind SensorInfo; a sentence follows"),
        field(&D::depth, "depth", "m", "in use"), field(&D::raw_depth, "raw_depth", "m", ""),
        field(&D::offset, "offset", "m", ""), field(&D::scale, "scale", "", ""),
        field(&D::latitude, "latitude", "deg", "200: not known"),
        field(&D::longitude, "longitude", "deg", "200: not known"));
}
constexpr auto wire_layout(Tag<Height>) {
    return make_layout<Height>(part_of("Height", "#SHI: behind SensorInfo; the sensor's sentence follows"),
                               field(&Height::sensor_type, "sensor_type", "", ""),
                               field(&Height::height, "height", "m", ""));
}
constexpr auto wire_layout(Tag<SoundSpeedManager>) {
    using S = SoundSpeedManager;
    return make_layout<S>(
        part_of("SoundSpeedManager", "#SSM: behind SensorInfo"),
        field(&S::sound_speed, "sound_speed", "m/s", "at the transducer"),
        field(&S::transducer_depth, "transducer_depth", "m", ""), field(&S::unknown0, "unknown0", "", ""),
        field(&S::mean_depth, "mean_depth", "m", ""), field(&S::unknown1, "unknown1", "", ""),
        field(&S::latitude, "latitude", "deg", ""), field(&S::longitude, "longitude", "deg", ""));
}
constexpr auto wire_layout(Tag<HeadingsInfo>) {
    using H = HeadingsInfo;
    return make_layout<H>(part_of("HeadingsInfo", "#SHA: behind SensorInfo; samples follow"),
                          field(&H::size, "size", "B", "of this struct, 8"),
                          field(&H::samples, "samples", "", "number of them"),
                          field(&H::bytes_per_sample, "bytes_per_sample", "B", ""),
                          field(&H::text_bytes, "text_bytes", "B", "of the sentence in each sample"));
}
constexpr auto wire_layout(Tag<HeadingSample>) {
    using H = HeadingSample;
    return make_layout<H>(part_of("HeadingSample", "#SHA: a sample; the sensor's sentence follows"),
                          field(&H::nanoseconds, "nanoseconds", "ns", "after the header's time"),
                          field(&H::heading, "heading", "deg", ""));
}
constexpr auto wire_layout(Tag<SoundSpeedInfo>) {
    using S = SoundSpeedInfo;
    return make_layout<S>(
        part_of("SoundSpeedInfo", "#SVT: begins it; samples follow"),
        field(&S::size, "size", "B", "of this struct, 20"),
        field(&S::status, "status", "", "as in SensorInfo"),
        field(&S::format, "format", "", "1 AML NMEA to 8 miniSVS"),
        field(&S::samples, "samples", "", "number of them"),
        field(&S::bytes_per_sample, "bytes_per_sample", "B", "24"),
        field(&S::contents, "contents", "", "bits: 0 speed, 1 temperature, 2 pressure, 3 salinity"),
        field(&S::filter, "filter", "s", ""), field(&S::offset, "offset", "m/s", ""));
}
constexpr auto wire_layout(Tag<SoundSpeedSample>) {
    using S = SoundSpeedSample;
    return make_layout<S>(
        part_of("SoundSpeedSample", "#SVT: a sample; what is not measured is -9999"),
        field(&S::seconds, "seconds", "s", "Unix time"), field(&S::nanoseconds, "nanoseconds", "ns", ""),
        field(&S::sound_speed, "sound_speed", "m/s", ""), field(&S::temperature, "temperature", "deg C", ""),
        field(&S::pressure, "pressure", "Pa", ""), field(&S::salinity, "salinity", "PSU", ""));
}
constexpr auto wire_layout(Tag<MotionInfo>) {
    using M = MotionInfo;
    return make_layout<M>(
        part_of("MotionInfo", "#SKM: begins it; samples follow"),
        field(&M::size, "size", "B", "of this struct, 12"), field(&M::system, "system", "", "0: ATTI_1, ..."),
        field(&M::status, "status", "", "as in SensorInfo"),
        field(&M::format, "format", "",
              "1 KM binary, 2 EM attitude, 3 Sagem, 4 to 6 Seapath 11, 23, 26, 7 POS MV, 8 MCOM"),
        field(&M::samples, "samples", "", "number of them"),
        field(&M::bytes_per_sample, "bytes_per_sample", "B", "132"),
        field(&M::contents, "contents", "",
              "bits: 0 position, 1 roll and pitch, 2 heading, 3 heave, 4 acceleration, 5 errors, 6 delayed "
              "heave"));
}
constexpr auto wire_layout(Tag<MotionSample>) {
    using M = MotionSample;
    return make_layout<M>(
        part_of("MotionSample", "#SKM: a sample, as the sensor gives it"),
        field(&M::mark, "mark", "", "#KMB"), field(&M::size, "size", "B", "132"),
        field(&M::version, "version", "", "1"), field(&M::seconds, "seconds", "s", "Unix time"),
        field(&M::nanoseconds, "nanoseconds", "ns", ""),
        field(&M::status, "status", "", "bits 0 to 6 invalid, 16 to 22 reduced, in the order of contents"),
        field(&M::latitude, "latitude", "deg", ""), field(&M::longitude, "longitude", "deg", ""),
        field(&M::height, "height", "m", "above the ellipsoid"), field(&M::roll, "roll", "deg", ""),
        field(&M::pitch, "pitch", "deg", ""), field(&M::heading, "heading", "deg", ""),
        field(&M::heave, "heave", "m", "down"), field(&M::roll_rate, "roll_rate", "deg/s", ""),
        field(&M::pitch_rate, "pitch_rate", "deg/s", ""), field(&M::yaw_rate, "yaw_rate", "deg/s", ""),
        field(&M::velocity_north, "velocity_north", "m/s", ""),
        field(&M::velocity_east, "velocity_east", "m/s", ""),
        field(&M::velocity_down, "velocity_down", "m/s", ""),
        field(&M::errors, "errors", "",
              "of latitude, longitude, height m; roll, pitch, heading deg; heave m"),
        field(&M::acceleration_north, "acceleration_north", "m/s2", ""),
        field(&M::acceleration_east, "acceleration_east", "m/s2", ""),
        field(&M::acceleration_down, "acceleration_down", "m/s2", ""),
        field(&M::delayed_seconds, "delayed_seconds", "s", "of the delayed heave; 0: there is none"),
        field(&M::delayed_nanoseconds, "delayed_nanoseconds", "ns", ""),
        field(&M::delayed_heave, "delayed_heave", "m", ""));
}
constexpr auto wire_layout(Tag<Heave>) {
    return make_layout<Heave>(part_of("Heave", "#CHE: behind the body of its ping"),
                              field(&Heave::heave, "heave", "m", "down, at the transducer"));
}
constexpr auto wire_layout(Tag<FileInfo>) {
    using F = FileInfo;
    return make_layout<F>(
        part_of("FileInfo", "#FCF: behind the partition; the file's bytes follow"),
        field(&F::size, "size", "B", "of this struct, 72"),
        field(&F::status, "status", "", "-1 no file, 0 whole, 1 cut"), field(&F::padding, "padding", "", ""),
        field(&F::file_bytes, "file_bytes", "B", "of the whole file"), field(&F::name, "name", "", ""));
}

}  // namespace echoloop::kmall
