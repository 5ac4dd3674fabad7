// The fields of the protobuf messages of an ARIS: number, member, name, unit and meaning. Tables only; the
// codec, `echoloop inspect` and the documentation walk them.
#pragma once

#include <string_view>
#include <tuple>

#include "protocols/aris/messages.h"

namespace echoloop::aris {

/// The member's type gives the wire type. `always`: written even when 0, for readers that test presence.
template <class M, class T>
struct Field {
    std::uint32_t number;
    T M::*member;
    std::string_view name, unit, help;
    bool always = false;
};

template <class M, class T>
Field(std::uint32_t, T M::*, std::string_view, std::string_view, std::string_view, bool = false)
    -> Field<M, T>;

template <class M>
struct Fields;

template <>
struct Fields<SoftwareVersion> {
    using M = SoftwareVersion;
    static constexpr std::string_view name = "SoftwareVersion", help = "of the sonar";
    static constexpr auto rows =
        std::tuple(Field{1, &M::major, "major", "", ""}, Field{2, &M::minor, "minor", "", ""},
                   Field{3, &M::build, "build", "", ""});
};
template <>
struct Fields<Names> {
    static constexpr std::string_view name = "Names", help = "what is enabled";
    static constexpr auto rows =
        std::tuple(Field{1, &Names::enabled, "enabled", "", "KA TCP keep-alive; DF Defender, VG Voyager"});
};
template <>
struct Fields<Availability> {
    using M = Availability;
    static constexpr std::string_view name = "Availability", help = "beacon, UDP 56124";
    static constexpr auto rows = std::tuple(
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
};
template <>
struct Fields<SetDateTime> {
    static constexpr std::string_view name = "SetDateTime", help = "clock of the sonar";
    static constexpr auto rows = std::tuple(Field{1, &SetDateTime::text, "text", "", "2014-Jan-31 23:58:15"});
};
template <>
struct Fields<SetReceiver> {
    static constexpr std::string_view name = "SetReceiver", help = "where frames go";
    static constexpr auto rows =
        std::tuple(Field{1, &SetReceiver::port, "port", "", "UDP"},
                   Field{2, &SetReceiver::ip, "ip", "", "absent: who is connected; 0.0.0.0: stop"});
};
template <>
struct Fields<PacketDelay> {
    static constexpr std::string_view name = "PacketDelay", help = "between the parts of a frame";
    static constexpr auto rows = std::tuple(Field{1, &PacketDelay::enable, "enable", "", "1: on"},
                                            Field{2, &PacketDelay::period, "period", "us", ""});
};
template <>
struct Fields<SetStream> {
    static constexpr std::string_view name = "SetStream", help = "how frames go";
    static constexpr auto rows = std::tuple(Field{1, &SetStream::delay, "delay", "", ""},
                                            Field{2, &SetStream::loss_policy, "loss_policy", "", "unused"});
};
template <>
struct Fields<SetAcoustics> {
    using M = SetAcoustics;
    static constexpr std::string_view name = "SetAcoustics", help = "what to send and to hear";
    static constexpr auto rows =
        std::tuple(Field{1, &M::cookie, "cookie", "", "comes back in the frame header; increases"},
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
};
template <>
struct Fields<SetSalinity> {
    static constexpr std::string_view name = "SetSalinity", help = "of the water";
    static constexpr auto rows =
        std::tuple(Field{1, &SetSalinity::salinity, "salinity", "ppt", "0 fresh, 15 brackish, 35 salt"});
};
template <>
struct Fields<SetTelephoto> {
    static constexpr std::string_view name = "SetTelephoto", help = "a lens before the sonar";
    static constexpr auto rows =
        std::tuple(Field{1, &SetTelephoto::telephoto, "telephoto", "", "1: it is there"});
};
template <>
struct Fields<SetFocus> {
    static constexpr std::string_view name = "SetFocus", help = "of the lens";
    static constexpr auto rows = std::tuple(Field{1, &SetFocus::position, "position", "", "obsolete"},
                                            Field{2, &SetFocus::range, "range", "m", ""});
};
template <>
struct Fields<ForceFocus> {
    static constexpr std::string_view name = "ForceFocus", help = "moves the lens";
    static constexpr auto rows =
        std::tuple(Field{1, &ForceFocus::direction, "direction", "", "1 forward, 2 reverse"});
};
template <>
struct Fields<Nothing> {
    static constexpr std::string_view name = "Nothing", help = "without fields";
    static constexpr auto rows = std::tuple();
};
template <>
struct Fields<SetMount> {
    static constexpr std::string_view name = "SetMount", help = "of the rotator";
    static constexpr auto rows =
        std::tuple(Field{1, &SetMount::mount, "mount", "", "0 pole, 1 tripod, 2 ROV"});
};
template <>
struct Fields<AxisValue> {
    static constexpr std::string_view name = "AxisValue", help = "for one axis of the rotator";
    static constexpr auto rows = std::tuple(Field{1, &AxisValue::axis, "axis", "", "0 pan, 1 roll, 2 tilt"},
                                            Field{2, &AxisValue::value, "value", "", ""});
};
template <>
struct Fields<SetSyslog> {
    static constexpr std::string_view name = "SetSyslog", help = "where the log goes";
    static constexpr auto rows = std::tuple(Field{1, &SetSyslog::ip, "ip", "", ""});
};
template <>
struct Fields<Command> {
    using M = Command;
    static constexpr std::string_view name = "Command",
                                      help =
                                          "TCP 56888, behind its length as u32 big-endian; the type names "
                                          "the one part that is there";
    static constexpr auto rows = std::tuple(
        Field{1, &M::type, "type", "", "0 date_time .. 14 ping, 15 syslog, in the order of the parts"},
        Field{2, &M::date_time, "date_time", "", ""}, Field{3, &M::receiver, "receiver", "", ""},
        Field{4, &M::stream, "stream", "", ""}, Field{5, &M::acoustics, "acoustics", "", ""},
        Field{6, &M::salinity, "salinity", "", ""}, Field{7, &M::telephoto, "telephoto", "", ""},
        Field{8, &M::focus, "focus", "", ""}, Field{9, &M::focus_force, "focus_force", "", ""},
        Field{10, &M::focus_home, "focus_home", "", ""}, Field{11, &M::mount, "mount", "", ""},
        Field{12, &M::velocity, "velocity", "", ""}, Field{13, &M::acceleration, "acceleration", "", ""},
        Field{14, &M::position, "position", "", ""}, Field{15, &M::stop, "stop", "", ""},
        Field{16, &M::ping, "ping", "", "once a second"}, Field{17, &M::syslog, "syslog", "", ""});
};
template <>
struct Fields<FramePart> {
    using M = FramePart;
    static constexpr std::string_view name = "FramePart", help = "UDP to the receiver, in order";
    static constexpr auto rows = std::tuple(
        Field{1, &M::frame_index, "frame_index", "", "from 1"},
        Field{2, &M::total_data_size, "total_data_size", "B", "beams x samples"},
        Field{3, &M::header, "header", "", "in the first part: a FrameHeader"},
        Field{4, &M::data, "data", "", "samples"},
        Field{5, &M::data_offset, "data_offset", "B", "of the first sample here; 0 in the first part"},
        Field{6, &M::ack_port, "ack_port", "", "unused"});
};
template <>
struct Fields<FramePartAck> {
    using M = FramePartAck;
    static constexpr std::string_view name = "FramePartAck", help = "optional, without effect";
    static constexpr auto rows = std::tuple(Field{1, &M::frame_index, "frame_index", "", ""},
                                            Field{2, &M::data_offset, "data_offset", "B", "expected next"});
};

}  // namespace echoloop::aris
