#include "protocols/seanet/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/seanet/codec.h"
#include "protocols/seanet/framer.h"
#include "protocols/seanet/layouts.h"

namespace echoloop::seanet {

namespace {

using inspect::add_fields;

inspect::Message inspected(const Frame& frame, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = name_of(frame.header.id)};
    add_fields(out, frame.header);
    if (const auto message = parse(frame)) {
        std::visit(
            [&]<class M>(const M& m) {
                out.name = wire::layout<M>.name;
                add_fields(out, m);
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

bool recognise(wire::ByteView bytes) { return inspect::recognise_stream<Framer>(bytes); }

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<Frame>(),
            table_of<Header>(),
            table_of<ReBoot>(),
            table_of<SendVersion>(),
            table_of<SendBBUser>(),
            table_of<StopAlives>(),
            table_of<SendData>(),
            table_of<HeadCommand>(),
            table_of<HeadCommandDual>(),
            table_of<HeadCommandReverse>(),
            table_of<HeadCommandGain>(),
            table_of<HeadParameters>(),
            table_of<V3B>(),
            table_of<Alive>(),
            table_of<VersionData>(),
            table_of<BBUserData>(),
            table_of<BBPort>(),
            table_of<FpgaCalData>(),
            table_of<FpgaVersionData>(),
            table_of<HeadData>(),
            table_of<AuxData>(),
            table_of<ProfilerCommand>(),
            table_of<ProfilerGainCommand>(),
            table_of<ProfilerParameters>(),
            table_of<ProfilerGains>(),
            table_of<ProfilerData>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const Frame& frame) -> wire::Bytes {
        const auto message = parse(frame);
        return message ? encode(*message) : wire::Bytes{};
    });
}

}  // namespace echoloop::seanet
