#include "protocols/aris/inspect.h"

#include "protocols/aris/command_layouts.h"
#include "protocols/aris/framer.h"
#include "protocols/aris/layouts.h"
#include "protocols/inspect_protobuf.h"
#include "protocols/inspect_stream.h"

namespace echoloop::aris {
namespace {

template <class M>
inspect::Message inspected(const M& message, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = std::string(wire::protobuf::layout<M>.name)};
    inspect::ProtobufFields(out, 0, size).add_all(message);
    return out;
}

inspect::Message inspected_part(const FramePart& part, std::size_t size) {
    inspect::Message out = inspected(part, 0, size);
    if (part.header.empty()) return out;
    const auto header = parse_frame_header(part.header);
    if (!header) {
        out.reason = "the frame header is too short";
        return out;
    }
    wire::visit_fields(*header, [&](const wire::FieldView& view) {
        out.fields.push_back(inspect::to_field(view, 0));
        out.fields.back().name = "header." + view.name;
    });
    return out;
}

/// Protobuf has no mark of its own: a beacon says who it is and fits its version, and has nothing else.
std::optional<Availability> sure_beacon(wire::ByteView bytes) {
    auto beacon = parse_availability(bytes);
    const bool sure = beacon && beacon->serial != 0 && beacon->version &&
                      beacon->system_type <= system_type::aris1200 &&
                      beacon->state <= connection_state::busy && encode(*beacon).size() == bytes.size();
    return sure ? beacon : std::nullopt;
}

/// Of the first part the header is the sign; of others that the samples lie within the frame.
std::optional<FramePart> sure_part(wire::ByteView bytes) {
    auto part = parse_frame_part(bytes);
    if (!part || part->frame_index == 0 || part->data.empty()) return std::nullopt;
    const bool fits = part->data_offset <= part->total_data_size &&
                      part->data.size() <= part->total_data_size - part->data_offset;
    const auto header = parse_frame_header(part->header);
    const bool first = part->data_offset == 0;
    const bool sure = first ? header && header->version == header_version : part->header.empty();
    return fits && sure ? part : std::nullopt;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    if (const auto beacon = sure_beacon(bytes)) return {inspected(*beacon, 0, bytes.size())};
    if (const auto part = sure_part(bytes)) return {inspected_part(*part, bytes.size())};
    return inspect::decode_stream<Framer>(bytes, inspected<Command>);
}

/// A stream is one if it begins with a command.
bool recognise(wire::ByteView bytes) {
    if (sure_beacon(bytes) || sure_part(bytes)) return true;
    Framer framer;
    framer.feed(bytes.first(std::min(bytes.size(), length_bytes + longest_command)));
    return framer.next() && framer.frame_offset() == 0;
}

std::vector<wire::Table> tables() {
    using inspect::protobuf_table_of;
    return {protobuf_table_of<Availability>(), protobuf_table_of<SoftwareVersion>(),
            protobuf_table_of<Names>(),        protobuf_table_of<Command>(),
            protobuf_table_of<SetDateTime>(),  protobuf_table_of<SetReceiver>(),
            protobuf_table_of<SetStream>(),    protobuf_table_of<PacketDelay>(),
            protobuf_table_of<SetAcoustics>(), protobuf_table_of<SetSalinity>(),
            protobuf_table_of<SetTelephoto>(), protobuf_table_of<SetFocus>(),
            protobuf_table_of<ForceFocus>(),   protobuf_table_of<SetMount>(),
            protobuf_table_of<AxisValue>(),    protobuf_table_of<SetSyslog>(),
            protobuf_table_of<FramePart>(),    protobuf_table_of<FramePartAck>(),
            wire::table_of<FrameHeader>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    if (const auto frame = framer.next()) return encode(*frame);
    const auto part = parse_frame_part(bytes);
    if (part && !part->data.empty()) {
        FramePart again = *part;
        if (const auto header = parse_frame_header(part->header)) again.header = encode(*header);
        return encode(again);
    }
    const auto beacon = parse_availability(bytes);
    return beacon ? encode(*beacon) : wire::Bytes{};
}

}  // namespace echoloop::aris
