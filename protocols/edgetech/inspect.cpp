#include "protocols/edgetech/inspect.h"

#include "protocols/edgetech/codec.h"
#include "protocols/edgetech/layouts.h"
#include "protocols/inspect_stream.h"

namespace echoloop::edgetech {
namespace {

const char* fault_of(const SonarData& data) {
    return data.data.empty() || !levels(data).empty() ? "" : "samples, format and size contradict each other";
}

inspect::Message inspected(const wire::Bytes& bytes, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = "Message"};
    const auto message = parse(bytes);
    if (!message) {
        out.reason = message.error().what();
        return out;
    }
    out.name = name_of(message->header);
    inspect::add_fields(out, message->header);
    std::visit(
        [&](const auto& body) {
            inspect::add_fields(out, body);
            if constexpr (requires { fault_of(body); }) out.reason = fault_of(body);
        },
        message->body);
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

/// A header of a known type is a sure sign; a whole message may be longer than what is looked at.
bool recognise(wire::ByteView bytes) {
    for (; bytes.size() >= header_bytes; bytes = bytes.subspan(1)) {
        if (bytes[0] != 0x01) continue;
        const auto header = plausible_header(bytes);
        if (header && is_known(header->type)) return true;
    }
    return false;
}

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<Header>(),      table_of<SonarData>(), table_of<SystemTime>(),
            table_of<Setting>(),     table_of<Coupling>(),  table_of<PitchRoll>(),
            table_of<Pressure>(),    table_of<NmeaText>(),  table_of<SystemInformation>(),
            table_of<OldSideScan>(), table_of<Unread>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const wire::Bytes& frame) {
        const auto message = parse(frame);
        return message ? encode(*message) : wire::Bytes{};
    });
}

}  // namespace echoloop::edgetech
