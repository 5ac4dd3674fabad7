#include "protocols/aris/codec.h"

#include "protocols/aris/command_layouts.h"
#include "protocols/aris/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::aris {
namespace {

namespace protobuf = wire::protobuf;

template <class M>
std::optional<M> parsed(wire::ByteView bytes) {
    std::optional<M> message(std::in_place);
    if (!protobuf::read(bytes, *message)) message.reset();
    return message;
}

bool has_its_part(const Command& c) {
    switch (static_cast<CommandType>(c.type)) {
        case CommandType::set_date_time:
            return c.date_time.has_value();
        case CommandType::set_receiver:
            return c.receiver.has_value();
        case CommandType::set_stream:
            return c.stream.has_value();
        case CommandType::set_acoustics:
            return c.acoustics.has_value();
        case CommandType::set_salinity:
            return c.salinity.has_value();
        case CommandType::set_telephoto:
            return c.telephoto.has_value();
        case CommandType::set_focus:
            return c.focus.has_value();
        case CommandType::force_focus:
            return c.focus_force.has_value();
        case CommandType::home_focus:
        case CommandType::ping:
            return true;
        case CommandType::set_mount:
            return c.mount.has_value();
        case CommandType::set_velocity:
            return c.velocity.has_value();
        case CommandType::set_acceleration:
            return c.acceleration.has_value();
        case CommandType::set_position:
            return c.position.has_value();
        case CommandType::stop_rotator:
            return c.stop.has_value();
        case CommandType::set_syslog:
            return c.syslog.has_value();
    }
    return false;
}

}  // namespace

wire::Bytes encode(const Availability& message) { return protobuf::write(message); }
wire::Bytes encode(const FramePart& message) { return protobuf::write(message); }
wire::Bytes encode(const FramePartAck& message) { return protobuf::write(message); }

wire::Bytes encode(const Command& message) {
    const wire::Bytes body = protobuf::write(message);
    wire::Bytes out;
    out.reserve(length_bytes + body.size());
    out.resize(length_bytes);
    wire::store<wire::ByteOrder::big>(static_cast<std::uint32_t>(body.size()), out.data());
    out.insert(out.end(), body.begin(), body.end());
    return out;
}

wire::Bytes encode(const FrameHeader& header) { return wire::serialise(header); }

std::optional<Availability> parse_availability(wire::ByteView bytes) { return parsed<Availability>(bytes); }
std::optional<FramePart> parse_frame_part(wire::ByteView bytes) { return parsed<FramePart>(bytes); }
std::optional<FramePartAck> parse_frame_part_ack(wire::ByteView bytes) { return parsed<FramePartAck>(bytes); }

std::optional<Command> parse_command(wire::ByteView bytes) {
    auto command = parsed<Command>(bytes);
    if (command && !has_its_part(*command)) command.reset();
    return command;
}

std::optional<FrameHeader> parse_frame_header(wire::ByteView bytes) {
    if (bytes.size() < header_bytes) return std::nullopt;
    const auto header = wire::parse<FrameHeader>(bytes.first(header_bytes));
    return header ? std::optional(*header) : std::nullopt;
}

}  // namespace echoloop::aris
