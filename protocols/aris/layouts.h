// The field table of the header of an ARIS frame. Table only.
#pragma once

#include "protocols/aris/header.h"
#include "protocols/wire/layout.h"

namespace echoloop::aris {

using namespace wire;

constexpr auto wire_layout(Tag<FrameHeader>) {
    using M = FrameHeader;
    return make_layout<M>(
        {"FrameHeader", "in the first part of each frame, and 1024 bytes long in files", ByteOrder::little},
        field(&M::index, "index", "", "of the frame in a file"),
        field(&M::timestamp, "timestamp", "us", "since 1970, the sonar's clock; FrameTime of the maker"),
        field(&M::version, "version", "", "always 0x05464444").hex(), field(&M::status, "status", "", ""),
        field(&M::sonar_time, "sonar_time", "us", "the same; hosts put their own there"),
        field(&M::reserved_28, "reserved_28", "", "day to hundredths, transmit mode"),
        field(&M::window_start, "window_start", "m", ""), field(&M::window_length, "window_length", "m", ""),
        field(&M::reserved_60, "reserved_60", "", "threshold, intensity"),
        field(&M::gain, "gain", "dB", "0 to 24"), field(&M::temperature1, "temperature1", "degC", ""),
        field(&M::temperature2, "temperature2", "degC", ""), field(&M::humidity, "humidity", "", ""),
        field(&M::focus, "focus", "", "asked for, 0 to 1000"), field(&M::battery, "battery", "", "unused"),
        field(&M::user, "user", "", "free"),
        field(&M::velocity, "velocity", "", "from here to heading_rate: of the vehicle, if somebody says so"),
        field(&M::depth, "depth", "", ""), field(&M::altitude, "altitude", "", ""),
        field(&M::pitch, "pitch", "", ""), field(&M::pitch_rate, "pitch_rate", "", ""),
        field(&M::roll, "roll", "", ""), field(&M::roll_rate, "roll_rate", "", ""),
        field(&M::heading, "heading", "", ""), field(&M::heading_rate, "heading_rate", "", ""),
        field(&M::compass_heading, "compass_heading", "deg", "of the sonar, clockwise from north"),
        field(&M::compass_pitch, "compass_pitch", "deg", "nose up"),
        field(&M::compass_roll, "compass_roll", "deg", "starboard down"),
        field(&M::latitude, "latitude", "", ""), field(&M::longitude, "longitude", "", ""),
        field(&M::reserved_188, "reserved_188", "", "position, target, flags"),
        field(&M::water_temperature, "water_temperature", "degC", ""),
        field(&M::reserved_228, "reserved_228", "", "position, vehicle time, GPS, offsets, matrix"),
        field(&M::sample_rate, "sample_rate", "Hz", "1e6 / sample_period"),
        field(&M::acceleration, "acceleration", "g", "level: 0, 0, -1"),
        field(&M::ping_mode, "ping_mode", "", "1 48, 3 96, 6 64, 9 128 beams"),
        field(&M::frequency, "frequency", "", "0 low, 1 high"),
        field(&M::pulse_width, "pulse_width", "us", "as in the settings"),
        field(&M::cycle_period, "cycle_period", "us", ""),
        field(&M::sample_period, "sample_period", "us", ""), field(&M::transmit, "transmit", "", "1: on"),
        field(&M::frame_rate, "frame_rate", "Hz", ""), field(&M::sound_speed, "sound_speed", "m/s", ""),
        field(&M::samples, "samples", "", "of a beam"),
        field(&M::volts_150, "volts_150", "", "1: full power"),
        field(&M::start_delay, "start_delay", "us", "to the first sample"),
        field(&M::large_lens, "large_lens", "", "1: telephoto lens"),
        field(&M::system_type, "system_type", "", "0 ARIS 1800, 1 ARIS 3000, 2 ARIS 1200"),
        field(&M::serial, "serial", "", ""),
        field(&M::reserved_492, "reserved_492", "", "faults, missed packets"),
        field(&M::version_build, "version_build", "", "of the software"),
        field(&M::reserved_512, "reserved_512", "", ""),
        field(&M::reordered, "reordered", "", "0: samples in the sonar's order; 1: range after range"),
        field(&M::salinity, "salinity", "ppt", "0, 15 or 35"),
        field(&M::pressure, "pressure", "psi", "absolute"),
        field(&M::reserved_528, "reserved_528", "", "voltages"),
        field(&M::focus_moving, "focus_moving", "", "1: on its way"),
        field(&M::reserved_544, "reserved_544", "", "faults"),
        field(&M::focus_position, "focus_position", "", "where it is, 0 to 1000"),
        field(&M::reserved_608, "reserved_608", "", "rotator"),
        field(&M::applied, "applied", "", "cookie of the last settings that were taken as they were"),
        field(&M::constrained, "constrained", "", "cookie of the last settings that were made to fit"),
        field(&M::invalid, "invalid", "", "cookie of the last settings that were refused"),
        field(&M::delay_enabled, "delay_enabled", "", "1: between parts"),
        field(&M::delay_period, "delay_period", "us", ""), field(&M::uptime, "uptime", "s", ""),
        field(&M::version_major, "version_major", "", ""), field(&M::version_minor, "version_minor", "", ""),
        field(&M::go_time, "go_time", "us", "of the first ping, the sonar's clock"),
        field(&M::reserved_716, "reserved_716", "", "rotator, GPS"),
        field(&M::variant, "variant", "", "bit 0 Defender, bit 1 Voyager"),
        field(&M::reserved_736, "reserved_736", "", "compass"));
}
static_assert(fixed_size<FrameHeader>() == header_bytes);

}  // namespace echoloop::aris
