// The fields of the protobuf messages of an ARIS: number, member, name, unit and meaning. Tables only.
#pragma once

#include "protocols/aris/messages.h"
#include "protocols/wire/protobuf.h"

namespace echoloop::aris {

using wire::Tag;
using wire::protobuf::Field;
using wire::protobuf::make_message;

constexpr auto protobuf_layout(Tag<SoftwareVersion>) {
    using M = SoftwareVersion;
    return make_message("SoftwareVersion", "of the sonar", Field{1, &M::major, "major", "", ""},
                        Field{2, &M::minor, "minor", "", ""}, Field{3, &M::build, "build", "", ""});
}
constexpr auto protobuf_layout(Tag<Names>) {
    return make_message(
        "Names", "what is enabled",
        Field{1, &Names::enabled, "enabled", "", "KA TCP keep-alive; DF Defender, VG Voyager"});
}
constexpr auto protobuf_layout(Tag<Availability>) {
    using M = Availability;
    return make_message(
        "Availability", "beacon, UDP 56124",

        Field{1, &M::serial, "serial", "", "serial number"},
        Field{2, &M::system_type, "system_type", "", "0 ARIS 1800, 1 ARIS 3000, 2 ARIS 1200", true},
        Field{3, &M::version, "version", "", "of the software"},
        Field{4, &M::state, "state", "", "0 available, 1 busy", true},
        Field{5, &M::capabilities, "capabilities", "", ""},
        Field{7, &M::link, "link", "", "0 HomePlug, 1 Ethernet"},
        Field{8, &M::cpu_temperature, "cpu_temperature", "degC", ""},
        Field{9, &M::power_down, "power_down", "", "reason: 0 over-temperature"},
        Field{10, &M::temperature_limit, "temperature_limit", "degC", "where it powers down"},
        Field{11, &M::limit_seconds, "limit_seconds", "s", "above that limit"},
        Field{12, &M::diver_held, "diver_held", "", "1: held by a diver"},
        Field{13, &M::variants, "variants", "", ""});
}
constexpr auto protobuf_layout(Tag<SetDateTime>) {
    return make_message("SetDateTime", "clock of the sonar",
                        Field{1, &SetDateTime::text, "text", "", "2014-Jan-31 23:58:15"});
}
constexpr auto protobuf_layout(Tag<SetReceiver>) {
    return make_message("SetReceiver", "where frames go", Field{1, &SetReceiver::port, "port", "", "UDP"},
                        Field{2, &SetReceiver::ip, "ip", "", "absent: who is connected; 0.0.0.0: stop"});
}
constexpr auto protobuf_layout(Tag<PacketDelay>) {
    return make_message("PacketDelay", "between the parts of a frame",
                        Field{1, &PacketDelay::enable, "enable", "", "1: on"},
                        Field{2, &PacketDelay::period, "period", "us", ""});
}
constexpr auto protobuf_layout(Tag<SetStream>) {
    return make_message("SetStream", "how frames go", Field{1, &SetStream::delay, "delay", "", ""},
                        Field{2, &SetStream::loss_policy, "loss_policy", "", "unused"});
}
constexpr auto protobuf_layout(Tag<SetAcoustics>) {
    using M = SetAcoustics;
    return make_message("SetAcoustics", "what to send and to hear",
                        Field{1, &M::cookie, "cookie", "", "comes back in the frame header; increases"},
                        Field{2, &M::frame_rate, "frame_rate", "Hz", "1 to 15"},
                        Field{3, &M::samples, "samples", "", "of a beam, 128 to 4096"},
                        Field{4, &M::start_delay, "start_delay", "us", "930 to 60000"},
                        Field{5, &M::cycle_period, "cycle_period", "us", "of a ping, 1802 to 150000"},
                        Field{6, &M::sample_period, "sample_period", "us", "4 to 100"},
                        Field{7, &M::pulse_width, "pulse_width", "us", "5 to 80"},
                        Field{8, &M::ping_mode, "ping_mode", "", "1 48, 3 96, 6 64, 9 128 beams"},
                        Field{9, &M::transmit, "transmit", "", "1: on"},
                        Field{10, &M::frequency, "frequency", "", "0 low, 1 high"},
                        Field{11, &M::volts_150, "volts_150", "", "1: full power"},
                        Field{12, &M::gain, "gain", "dB", "0 to 24"});
}
constexpr auto protobuf_layout(Tag<SetSalinity>) {
    return make_message("SetSalinity", "of the water",
                        Field{1, &SetSalinity::salinity, "salinity", "ppt", "0 fresh, 15 brackish, 35 salt"});
}
constexpr auto protobuf_layout(Tag<SetTelephoto>) {
    return make_message("SetTelephoto", "a lens before the sonar",
                        Field{1, &SetTelephoto::telephoto, "telephoto", "", "1: it is there"});
}
constexpr auto protobuf_layout(Tag<SetFocus>) {
    return make_message("SetFocus", "of the lens", Field{1, &SetFocus::position, "position", "", "obsolete"},
                        Field{2, &SetFocus::range, "range", "m", ""});
}
constexpr auto protobuf_layout(Tag<ForceFocus>) {
    return make_message("ForceFocus", "moves the lens",
                        Field{1, &ForceFocus::direction, "direction", "", "1 forward, 2 reverse"});
}
constexpr auto protobuf_layout(Tag<Nothing>) { return make_message("Nothing", "without fields"); }
constexpr auto protobuf_layout(Tag<SetMount>) {
    return make_message("SetMount", "of the rotator",
                        Field{1, &SetMount::mount, "mount", "", "0 pole, 1 tripod, 2 ROV"});
}
constexpr auto protobuf_layout(Tag<AxisValue>) {
    return make_message("AxisValue", "for one axis of the rotator",
                        Field{1, &AxisValue::axis, "axis", "", "0 pan, 1 roll, 2 tilt"},
                        Field{2, &AxisValue::value, "value", "", ""});
}
constexpr auto protobuf_layout(Tag<SetSyslog>) {
    return make_message("SetSyslog", "where the log goes", Field{1, &SetSyslog::ip, "ip", "", ""});
}
constexpr auto protobuf_layout(Tag<Command>) {
    using M = Command;
    return make_message(
        "Command",
        "TCP 56888, behind its length as u32 big-endian; the type names the one part that is there",

        Field{1, &M::type, "type", "", "0 date_time .. 14 ping, 15 syslog, in the order of the parts"},
        Field{2, &M::date_time, "date_time", "", ""}, Field{3, &M::receiver, "receiver", "", ""},
        Field{4, &M::stream, "stream", "", ""}, Field{5, &M::acoustics, "acoustics", "", ""},
        Field{6, &M::salinity, "salinity", "", ""}, Field{7, &M::telephoto, "telephoto", "", ""},
        Field{8, &M::focus, "focus", "", ""}, Field{9, &M::focus_force, "focus_force", "", ""},
        Field{10, &M::focus_home, "focus_home", "", ""}, Field{11, &M::mount, "mount", "", ""},
        Field{12, &M::velocity, "velocity", "", ""}, Field{13, &M::acceleration, "acceleration", "", ""},
        Field{14, &M::position, "position", "", ""}, Field{15, &M::stop, "stop", "", ""},
        Field{16, &M::ping, "ping", "", "once a second"}, Field{17, &M::syslog, "syslog", "", ""});
}
constexpr auto protobuf_layout(Tag<FramePart>) {
    using M = FramePart;
    return make_message(
        "FramePart", "UDP to the receiver, in order",

        Field{1, &M::frame_index, "frame_index", "", "from 1"},
        Field{2, &M::total_data_size, "total_data_size", "B", "beams x samples"},
        Field{3, &M::header, "header", "", "in the first part: a FrameHeader"},
        Field{4, &M::data, "data", "", "samples"},
        Field{5, &M::data_offset, "data_offset", "B", "of the first sample here; 0 in the first part"},
        Field{6, &M::ack_port, "ack_port", "", "unused"});
}
constexpr auto protobuf_layout(Tag<FramePartAck>) {
    using M = FramePartAck;
    return make_message("FramePartAck", "optional, without effect",
                        Field{1, &M::frame_index, "frame_index", "", ""},
                        Field{2, &M::data_offset, "data_offset", "B", "expected next"});
}

}  // namespace echoloop::aris
