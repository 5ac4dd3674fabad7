#include "protocols/oculus/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/oculus/codec.h"
#include "protocols/oculus/framer.h"
#include "protocols/oculus/layouts.h"

namespace echoloop::oculus {
namespace {

template <class M>
const char* fault_of(const M& message) {
    if constexpr (requires { image_of(message); }) {
        if (!image_of(message)) return "the image's offset and sizes contradict each other";
    }
    return "";
}

inspect::Message inspected(const Frame& frame, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size};
    out.name = name_of(frame);
    inspect::add_fields(out, frame.header);
    if (const auto message = parse(frame)) {
        std::visit(
            [&](const auto& m) {
                inspect::add_fields(out, m);
                out.reason = fault_of(m);
            },
            *message);
    } else {
        out.reason = message.error().what();
    }
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

/// A header is a sure sign; a whole image may be longer than what is looked at.
bool recognise(wire::ByteView bytes) {
    for (; bytes.size() >= header_bytes; bytes = bytes.subspan(1))
        if (bytes[0] == 'S' && plausible_header(bytes)) return true;
    return false;
}

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<Header>(),     table_of<Fire>(),    table_of<FireV2>(),  table_of<ResultV1>(),
            table_of<ResultV2>(),   table_of<Status>(),  table_of<Version>(), table_of<FullResult>(),
            table_of<UserConfig>(), table_of<LogText>(), table_of<Dummy>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const Frame& frame) -> wire::Bytes {
        const auto message = parse(frame);
        return message ? encode(*message, frame.header.source, frame.header.destination) : wire::Bytes{};
    });
}

}  // namespace echoloop::oculus
