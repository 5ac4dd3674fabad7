// The field tables of the packets of a Wayfinder. Tables only. Layouts behind the header start at byte 9.
#pragma once

#include "protocols/wayfinder/names.h"
#include "protocols/wire/layout.h"

namespace echoloop::wayfinder {

using namespace wire;

inline constexpr std::size_t header_size = 9;  ///< bytes

/// In front of each packet: that of the line, then that of what it carries.
struct Header {
    std::uint16_t size = 0;
    Kind kind = Kind::command;
    std::uint16_t inner_size = 0;
    friend bool operator==(const Header&, const Header&) = default;
};

constexpr Heading body_of(std::string_view name, std::string_view help) {
    return {name, help, ByteOrder::little, header_size};
}
constexpr auto id_of(CommandId id) { return constant(static_cast<std::uint32_t>(id), "command", ""); }
constexpr auto structure(std::uint8_t id) { return constant(id, "structure", ""); }

constexpr auto wire_layout(Tag<Header>) {
    using M = Header;
    return make_layout<M>(
        {"Header", "in front of each packet, behind which a sum of all bytes before it stands",
         ByteOrder::little},
        constant<std::uint8_t>(0xAA, "start", ""), constant<std::uint8_t>(0x10, "line_version", ""),
        constant<std::uint8_t>(0x01, "line_kind", ""), field(&M::size, "size", "B", "of the whole packet"),
        constant<std::uint8_t>(0x02, "packet_version", ""), field(&M::kind, "kind", "", "what follows"),
        field(&M::inner_size, "inner_size", "B", "of what follows, with four bytes before"));
}

constexpr auto wire_layout(Tag<Clock>) {
    using M = Clock;
    return make_layout<M>({"Clock", "date and time", ByteOrder::little}, structure(0x23),
                          field(&M::version, "version", "", "").hex(),
                          field(&M::size, "size", "B", "of the structure"),
                          field(&M::year, "year", "", "of the century"), field(&M::month, "month", "", ""),
                          field(&M::day, "day", "", ""), field(&M::hour, "hour", "h", ""),
                          field(&M::minute, "minute", "min", ""), field(&M::second, "second", "s", ""));
}

template <class M, class... More>
constexpr auto setup_layout(std::string_view name, std::string_view help, More... more) {
    return make_layout<M>(
        {name, help, ByteOrder::little}, structure(0x22), field(&M::version, "version", "", "").hex(),
        field(&M::size, "size", "B", "of the structure"),
        field(&M::trigger, "trigger", "", "1: it pings when it is told"),
        field(&M::baud, "baud", "", "3: 9600, 7: 115200 bit/s"),
        field(&M::sound_speed, "sound_speed", "m/s", ""),
        field(&M::most_range, "most_range", "m", "at which it looks for the bottom"), more...);
}
constexpr auto wire_layout(Tag<Setup>) {
    return setup_layout<Setup>(
        "Setup", "what a host can set",
        field(&Setup::most_vertical_range, "most_vertical_range", "m", "of a vertical beam"));
}
constexpr auto wire_layout(Tag<OlderSetup>) {
    return setup_layout<OlderSetup>("OlderSetup", "what a host can set, version 0x10");
}

constexpr auto wire_layout(Tag<Command>) {
    using M = Command;
    return make_layout<M>(body_of("Command", "without parameters, or with such that do not fit it"),
                          field(&M::command, "command", "", ""),
                          rest(&M::parameters, {}, "parameters", "", ""));
}
constexpr auto wire_layout(Tag<SetTime>) {
    return make_layout<SetTime>(body_of("SetTime", "command 0x1F000002"), id_of(CommandId::set_time),
                                field(&SetTime::clock, "clock", "", ""));
}
constexpr auto wire_layout(Tag<SetSetup>) {
    return make_layout<SetSetup>(body_of("SetSetup", "command 0x87000002"), id_of(CommandId::set_setup),
                                 field(&SetSetup::setup, "setup", "", ""));
}
constexpr auto wire_layout(Tag<SetOlderSetup>) {
    return make_layout<SetOlderSetup>(body_of("SetOlderSetup", "command 0x87000002, version 0x10"),
                                      id_of(CommandId::set_setup),
                                      field(&SetOlderSetup::setup, "setup", "", ""));
}
constexpr auto wire_layout(Tag<SetSoundSpeed>) {
    return make_layout<SetSoundSpeed>(body_of("SetSoundSpeed", "command 0x86000003"),
                                      id_of(CommandId::set_sound_speed),
                                      field(&SetSoundSpeed::sound_speed, "sound_speed", "m/s", ""));
}

constexpr auto wire_layout(Tag<Response>) {
    using M = Response;
    return make_layout<M>(body_of("Response", "how a command went"), field(&M::command, "command", "", ""),
                          field(&M::outcome, "outcome", "", ""), rest(&M::more, {}, "more", "", ""));
}
constexpr auto wire_layout(Tag<Refusal>) {
    using M = Refusal;
    return make_layout<M>(body_of("Refusal", "how a command went, and which parameter is to blame"),
                          field(&M::command, "command", "", ""), field(&M::outcome, "outcome", "", ""),
                          field(&M::wrong, "wrong", "", "parameter"));
}
template <class M, class... Fields>
constexpr auto response_layout(std::string_view name, std::string_view help, CommandId id, Fields... fields) {
    return make_layout<M>(body_of(name, help), id_of(id), field(&M::outcome, "outcome", "", ""),
                          field(&M::wrong, "wrong", "", "parameter; 0"), fields...);
}
constexpr auto wire_layout(Tag<TimeResponse>) {
    return response_layout<TimeResponse>("TimeResponse", "to 0x1D000001", CommandId::get_time,
                                         field(&TimeResponse::clock, "clock", "", ""));
}
constexpr auto wire_layout(Tag<SetupResponse>) {
    return response_layout<SetupResponse>("SetupResponse", "to 0x85000001", CommandId::get_setup,
                                          field(&SetupResponse::setup, "setup", "", ""));
}
constexpr auto wire_layout(Tag<SystemResponse>) {
    using M = SystemResponse;
    return response_layout<M>(
        "SystemResponse", "to 0x81000001", CommandId::get_system, structure(0x21),
        field(&M::version, "version", "", "").hex(), field(&M::size, "size", "B", "of the structure"),
        field(&M::frequency, "frequency", "Hz", ""),
        field(&M::firmware, "firmware", "", "major, minor, patch, build"),
        field(&M::fpga, "fpga", "", "version").hex(), field(&M::system_id, "system_id", "", "").hex(),
        field(&M::transducer, "transducer", "", "type"), field(&M::beam_angle, "beam_angle", "deg", ""),
        field(&M::vertical_beam, "vertical_beam", "", "1: it has one"),
        field(&M::reserved, "reserved", "", ""), field(&M::type, "type", "", "76: Wayfinder"),
        field(&M::subtype, "subtype", "", ""));
}
constexpr auto wire_layout(Tag<FeaturesResponse>) {
    using M = FeaturesResponse;
    return response_layout<M>("FeaturesResponse", "to 0x10000001", CommandId::get_features, structure(0x26),
                              field(&M::version, "version", "", "").hex(),
                              field(&M::size, "size", "B", "of the structure"),
                              field(&M::base_accuracy, "base_accuracy", "", "0: the high one"));
}
constexpr auto wire_layout(Tag<TestsResponse>) {
    using M = TestsResponse;
    return response_layout<M>(
        "TestsResponse", "to 0x19000001", CommandId::get_tests, structure(0x24),
        field(&M::version, "version", "", "").hex(), field(&M::size, "size", "B", "of the structure"),
        field(&M::tests, "tests", "", "SDRAM, FRAM, clock, EEPROM, flash, converter: 1 passed, 0 failed"));
}
constexpr auto wire_layout(Tag<ComponentsResponse>) {
    using M = ComponentsResponse;
    constexpr std::string_view board = "part number, revision, serial number, a NUL behind each";
    return response_layout<M>(
        "ComponentsResponse", "to 0x81000003", CommandId::get_components, structure(0x29),
        field(&M::version, "version", "", "").hex(), field(&M::size, "size", "B", "of the structure"),
        field(&M::count, "count", "", "of boards"), field(&M::board_1, "board_1", "", board),
        field(&M::board_2, "board_2", "", board), field(&M::board_3, "board_3", "", board),
        field(&M::board_4, "board_4", "", board));
}

constexpr auto wire_layout(Tag<Data>) {
    using M = Data;
    return make_layout<M>(
        body_of("Data", "a ping, version 0x11"), structure(0xAA), constant<std::uint8_t>(0x11, "version", ""),
        field(&M::data_size, "data_size", "B", "with the sum"), field(&M::type, "type", "", "76: Wayfinder"),
        field(&M::subtype, "subtype", "", ""),
        field(&M::firmware, "firmware", "", "major, minor, patch, build"),
        field(&M::year, "year", "", "of the century"), field(&M::month, "month", "", ""),
        field(&M::day, "day", "", ""), field(&M::hour, "hour", "h", ""),
        field(&M::minute, "minute", "min", ""), field(&M::second, "second", "s", ""),
        field(&M::millisecond, "millisecond", "ms", ""),
        field(&M::frame, "frame", "", "0 beam, 1 instrument, 2 ship, 3 earth"),
        field(&M::velocity, "velocity", "m/s", "x, y, z, error; NaN is none"),
        field(&M::range, "range", "m", "of beams 1 to 4; NaN is none"),
        field(&M::mean_range, "mean_range", "m", "NaN is none"),
        field(&M::sound_speed, "sound_speed", "m/s", "by which it was measured"),
        field(&M::status, "status", "", "").hex(),
        field(&M::test_errors, "test_errors", "", "of built-in tests"),
        field(&M::test_code, "test_code", "", "").hex(), field(&M::voltage, "voltage", "V", ""),
        field(&M::transmit_voltage, "transmit_voltage", "V", ""), field(&M::current, "current", "A", ""),
        field(&M::serial_number, "serial_number", "", ""), field(&M::reserved, "reserved", "", ""),
        field(&M::checksum, "checksum", "", "sum of the data before it").hex());
}

constexpr auto wire_layout(Tag<Other>) {
    return make_layout<Other>(body_of("Other", "what has no table"),
                              rest(&Other::values, {}, "values", "", ""));
}

}  // namespace echoloop::wayfinder
