#include "protocols/seanet/inspect.h"

#include "protocols/seanet/codec.h"
#include "protocols/seanet/framer.h"
#include "protocols/seanet/layouts.h"
#include "protocols/wire/visit.h"

namespace echoloop::seanet {

namespace {

constexpr std::size_t chunk = 4096;

void add_fields(inspect::Message& message, const auto& part) {
    wire::visit_fields(part, [&](const wire::FieldView& view) {
        message.fields.push_back(inspect::to_field(view, message.offset));
    });
}

inspect::Message inspected(const Frame& frame, std::size_t offset) {
    inspect::Message out;
    out.offset = offset;
    out.size = frame.payload.size() + min_frame_bytes;
    out.name = name_of(frame.header.id);
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

inspect::Message noise(std::size_t from, std::size_t to) {
    return {.offset = from, .size = to - from, .name = "", .fields = {}, .reason = "no complete frame"};
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    std::vector<inspect::Message> out;
    Framer framer;
    std::size_t covered = 0;
    const auto take = [&] {
        while (const auto frame = framer.next()) {
            const std::size_t at = framer.frame_offset();
            if (at > covered) out.push_back(noise(covered, at));
            out.push_back(inspected(*frame, at));
            covered = at + out.back().size;
        }
    };
    for (std::size_t from = 0; from < bytes.size(); from += chunk) {
        framer.feed(bytes.subspan(from, std::min(chunk, bytes.size() - from)));
        take();
    }
    framer.finish();
    take();
    if (covered < bytes.size()) out.push_back(noise(covered, bytes.size()));
    return out;
}

bool recognise(wire::ByteView bytes) {
    Framer framer;
    for (std::size_t from = 0; from < bytes.size(); from += chunk) {
        framer.feed(bytes.subspan(from, std::min(chunk, bytes.size() - from)));
        if (framer.next()) return true;
    }
    framer.finish();
    return framer.next().has_value();
}

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
            table_of<AuxData>()};
}

}  // namespace echoloop::seanet
