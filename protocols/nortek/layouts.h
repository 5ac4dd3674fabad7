// The field tables of Nortek's frames. Tables only.
#pragma once

#include "protocols/nortek/messages.h"
#include "protocols/wire/layout.h"

namespace echoloop::nortek {

using namespace wire;

/// In front of the data of each frame.
struct Header {
    std::uint8_t id = 0, family = nucleus_family;
    std::uint16_t size = 0, data_checksum = 0, checksum = 0;
    friend bool operator==(const Header&, const Header&) = default;
};

constexpr auto wire_layout(Tag<Header>) {
    using M = Header;
    return make_layout<M>(
        {"Header", "in front of the data of each frame", ByteOrder::little},
        constant<std::uint8_t>(0xA5, "start", ""), constant<std::uint8_t>(10, "header_size", ""),
        field(&M::id, "id", "", "of the data").hex(),
        field(&M::family, "family", "", "0x20: Nucleus, 0x10: DVL").hex(),
        field(&M::size, "size", "B", "of the data"),
        field(&M::data_checksum, "data_checksum", "", "sum of 16-bit words from 0xB58C on").hex(),
        field(&M::checksum, "checksum", "", "of the 8 bytes before").hex());
}

constexpr auto wire_layout(Tag<Track>) {
    using M = Track;
    return make_layout<M>(
        {"Track", "bottom track (0xB4) or water track (0xBE)", ByteOrder::little},
        field(&M::version, "version", "", ""), field(&M::offset, "offset", "B", "of what is measured"),
        field(&M::flags, "flags", "", "bit 0: Unix time").hex(), field(&M::seconds, "seconds", "s", ""),
        field(&M::microseconds, "microseconds", "us", ""),
        field(&M::status, "status", "",
              "valid: bits 0-2 beam velocities, 3-5 distances, 6-8 their merit, 9-11 velocities, 12-14 merit")
            .hex(),
        field(&M::serial_number, "serial_number", "", ""), field(&M::error, "error", "", "").hex(),
        field(&M::sound_speed, "sound_speed", "m/s", ""), field(&M::temperature, "temperature", "degC", ""),
        field(&M::pressure, "pressure", "bar", ""),
        field(&M::beam_velocity, "beam_velocity", "m/s", "-32.768: none"),
        field(&M::distance, "distance", "m", "0: none"),
        field(&M::beam_merit, "beam_merit", "m/s", "10: none"), field(&M::beam_delay, "beam_delay", "s", ""),
        field(&M::beam_duration, "beam_duration", "s", ""),
        field(&M::velocity, "velocity", "m/s", "x, y, z; -32.768: none"),
        field(&M::merit, "merit", "m/s", "10: none"), field(&M::delay, "delay", "s", ""),
        field(&M::duration, "duration", "s", ""));
}

constexpr auto wire_layout(Tag<Altimeter>) {
    using M = Altimeter;
    return make_layout<M>(
        {"Altimeter", "straight down (0xAA)", ByteOrder::little}, field(&M::version, "version", "", ""),
        field(&M::offset, "offset", "B", "of what is measured"),
        field(&M::flags, "flags", "", "bit 0: Unix time").hex(), field(&M::seconds, "seconds", "s", ""),
        field(&M::microseconds, "microseconds", "us", ""),
        field(&M::status, "status", "", "valid: bits 0 distance, 1 quality, 16 pressure, 17 temperature")
            .hex(),
        field(&M::serial_number, "serial_number", "", ""), field(&M::error, "error", "", "").hex(),
        field(&M::sound_speed, "sound_speed", "m/s", ""), field(&M::temperature, "temperature", "degC", ""),
        field(&M::pressure, "pressure", "bar", ""), field(&M::distance, "distance", "m", "0: none"),
        field(&M::quality, "quality", "", ""));
}

constexpr auto wire_layout(Tag<Ahrs>) {
    using M = Ahrs;
    return make_layout<M>(
        {"Ahrs", "attitude (0xD2), version 2", ByteOrder::little}, field(&M::version, "version", "", ""),
        field(&M::offset, "offset", "B", "of what is measured"),
        field(&M::flags, "flags", "", "bit 0: Unix time").hex(), field(&M::seconds, "seconds", "s", ""),
        field(&M::microseconds, "microseconds", "us", ""), field(&M::status, "status", "", "").hex(),
        field(&M::serial_number, "serial_number", "", ""), field(&M::error, "error", "", "").hex(),
        field(&M::mode, "mode", "", "2: running"), field(&M::spare, "spare", "", ""),
        field(&M::merit, "merit", "", ""), field(&M::calibration_merit, "calibration_merit", "", ""),
        field(&M::roll, "roll", "deg", ""), field(&M::pitch, "pitch", "deg", ""),
        field(&M::heading, "heading", "deg", ""), field(&M::quaternion, "quaternion", "", "w, x, y, z"),
        field(&M::matrix, "matrix", "", "row by row"), field(&M::declination, "declination", "deg", ""),
        field(&M::depth, "depth", "m", ""));
}

constexpr auto wire_layout(Tag<Imu>) {
    using M = Imu;
    return make_layout<M>(
        {"Imu", "accelerometer and gyroscope (0x82)", ByteOrder::little},
        field(&M::version, "version", "", ""), field(&M::offset, "offset", "B", "of what is measured"),
        field(&M::flags, "flags", "", "bit 0: Unix time").hex(), field(&M::seconds, "seconds", "s", ""),
        field(&M::microseconds, "microseconds", "us", ""),
        field(&M::status, "status", "", "bit 0: valid").hex(),
        field(&M::acceleration, "acceleration", "m/s^2", ""), field(&M::rotation, "rotation", "rad/s", ""),
        field(&M::temperature, "temperature", "degC", ""));
}

constexpr auto wire_layout(Tag<DvlTrack>) {
    using M = DvlTrack;
    return make_layout<M>(
        {"DvlTrack", "of a DVL: bottom track (0x1B, DF21) or water track (0x1D, DF22)", ByteOrder::little},
        field(&M::version, "version", "", ""), field(&M::offset, "offset", "B", "of what is measured"),
        field(&M::serial_number, "serial_number", "", ""), field(&M::year, "year", "", "since 1900"),
        field(&M::month, "month", "", "0: January"), field(&M::day, "day", "", ""),
        field(&M::hour, "hour", "", ""), field(&M::minute, "minute", "", ""),
        field(&M::second, "second", "", ""), field(&M::fraction, "fraction", "100 us", "of the second"),
        field(&M::beams, "beams", "", ""), field(&M::error, "error", "", "").hex(),
        field(
            &M::status, "status", "",
            "valid: bits 0-3 beam velocities, 4-7 distances, 8-11 their merit, 12-15 x, y, z1, z2, 16-19 "
            "their merit; 20-22 the processor idles less than 3, 6, 12 %; 28-31 woken by 1 power, 2 break, 3 "
            "clock")
            .hex(),
        field(&M::sound_speed, "sound_speed", "m/s", ""), field(&M::temperature, "temperature", "degC", ""),
        field(&M::pressure, "pressure", "bar", ""),
        field(&M::beam_velocity, "beam_velocity", "m/s", "-32.768: none"),
        field(&M::distance, "distance", "m", "vertical; 0: none"),
        field(&M::beam_merit, "beam_merit", "m/s", "10: none"),
        field(&M::beam_from_trigger, "beam_from_trigger", "s",
              "from the trigger to the middle of the echo, DT1"),
        field(&M::beam_from_output, "beam_from_output", "s", "from the start of the report, DT2"),
        field(&M::beam_duration, "beam_duration", "s", "of the estimate"),
        field(&M::velocity, "velocity", "m/s", "x, y, z of beams 1 and 3, z of beams 2 and 4; -32.768: none"),
        field(&M::merit, "merit", "m/s", "10: none"), field(&M::from_trigger, "from_trigger", "s", "DT1"),
        field(&M::from_output, "from_output", "s", "DT2"), field(&M::duration, "duration", "s", ""));
}

constexpr auto wire_layout(Tag<Other>) {
    return make_layout<Other>({"Other", "data that have no table", ByteOrder::little},
                              rest(&Other::values, {}, "values", "", ""));
}

}  // namespace echoloop::nortek
