#include "protocols/wayfinder/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/wayfinder/codec.h"
#include "protocols/wayfinder/layouts.h"
#include "protocols/wire/read.h"

namespace echoloop::wayfinder {
namespace {

inspect::Message packet_of(const wire::Bytes& bytes, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = "Packet"};
    const auto packet = parse(bytes);
    if (!packet) {
        out.reason = packet.error().what();
        return out;
    }
    const auto header = wire::parse<Header>(wire::ByteView(bytes).first(header_size));
    if (header) inspect::add_fields(out, *header);
    std::visit(
        [&]<class M>(const M& body) {
            out.name = wire::layout<M>.name;
            inspect::add_fields(out, body);
        },
        packet->body);
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, packet_of);
}

bool recognise(wire::ByteView bytes) { return inspect::recognise_stream<Framer>(bytes); }

std::vector<wire::Table> tables() {
    return {wire::table_of<Header>(),
            wire::table_of<Command>(),
            wire::table_of<SetTime>(),
            wire::table_of<Clock>(),
            wire::table_of<SetSetup>(),
            wire::table_of<Setup>(),
            wire::table_of<SetOlderSetup>(),
            wire::table_of<OlderSetup>(),
            wire::table_of<SetSoundSpeed>(),
            wire::table_of<Response>(),
            wire::table_of<Refusal>(),
            wire::table_of<TimeResponse>(),
            wire::table_of<SetupResponse>(),
            wire::table_of<SystemResponse>(),
            wire::table_of<FeaturesResponse>(),
            wire::table_of<TestsResponse>(),
            wire::table_of<ComponentsResponse>(),
            wire::table_of<Data>(),
            wire::table_of<Other>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const wire::Bytes& frame) {
        const auto packet = parse(frame);
        return packet ? encode(*packet) : wire::Bytes{};
    });
}

std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    std::vector<ChecksumPlace> places;
    while (const auto frame = framer.next())
        places.push_back({framer.frame_offset() + frame->size() - 2, 2, false});
    return places;
}

}  // namespace echoloop::wayfinder
