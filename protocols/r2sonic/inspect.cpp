#include "protocols/r2sonic/inspect.h"

#include <bit>

#include "protocols/r2sonic/codec.h"
#include "protocols/r2sonic/commands.h"
#include "protocols/r2sonic/layouts.h"
#include "protocols/wire/visit.h"

namespace echoloop::r2sonic {

namespace {

void add_fields(inspect::Message& message, const auto& packet) {
    wire::visit_fields(
        packet, [&](const wire::FieldView& view) { message.fields.push_back(inspect::to_field(view, 0)); });
}

/// A setting under its own name, read as the number that the name says.
inspect::Field setting(const Command& command, std::size_t offset) {
    const CommandInfo* info = find_command(command.name.view());
    wire::FieldView view{.name = "", .unit = info != nullptr ? info->unit : "", .offset = offset, .size = 8};
    view.value = std::string(command.name.view());
    view.name = value_text(view);
    view.value = info != nullptr && info->real ? wire::Value(wire::readable(command.as_f32()))
                                               : wire::Value(std::uint64_t{command.raw});
    return inspect::to_field(view, 0);
}

/// The snippets behind the first one carry their place in the datagram.
void add_fields(inspect::Message& message, const Sni0& packet) {
    const auto add = [&](const wire::FieldView& view) {
        message.fields.push_back(inspect::to_field(view, 0));
    };
    wire::visit_fields(packet, add);
    std::size_t number = 0;
    for (const S1& other : packet.others) {
        const std::string prefix = "s1[" + std::to_string(++number) + "].";
        wire::visit_fields(other, [&](wire::FieldView view) {
            view.name = prefix + view.name;
            add(view);
        });
    }
}

void add_fields(inspect::Message& message, const Cmd0& packet) {
    std::size_t offset = 4;
    for (const Command& command : packet.commands) {
        message.fields.push_back(setting(command, offset));
        offset += 8;
    }
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    inspect::Message out{.size = bytes.size()};
    const auto packet = parse(bytes);
    if (packet) {
        out.name = name_of(*packet);
        std::visit([&](const auto& p) { add_fields(out, p); }, *packet);
    } else {
        out.reason = packet.error().what();
    }
    return {out};
}

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<Bth0>(),     table_of<Aid0Head>(),   table_of<Aid0Data>(),
            table_of<Wcd0Head>(), table_of<Wcd0Data>(),   table_of<Sni0>(),
            table_of<Tpx0>(),     table_of<H0>(),         table_of<LongH0>(),
            table_of<R0>(),       table_of<A0>(),         table_of<A2>(),
            table_of<A1>(),       table_of<I1>(),         table_of<G0>(),
            table_of<G1>(),       table_of<Gate>(),       table_of<Q0>(),
            table_of<M0>(),       table_of<M1>(),         table_of<M2>(),
            table_of<S1>(),       table_of<D0>(),         table_of<D1>(),
            table_of<SidePair>(), table_of<AngledPair>(), table_of<MagnitudePhase>(),
            table_of<Sth0>(),     table_of<Sts0>(),       table_of<Ser3>(),
            table_of<Prt3>(),     table_of<Mdl3>(),       table_of<Fwv6>(),
            table_of<Fwt6>(),     table_of<Prj9>(),       table_of<Opt1>(),
            table_of<SenA>(),     table_of<Sen7>(),       table_of<Adc3>(),
            table_of<Adc2>(),     table_of<Eth6>(),       table_of<Tim2>(),
            table_of<Led1>(),     table_of<R2ds>(),       table_of<R2dd>(),
            table_of<R2di>(),     table_of<R2dc>(),       table_of<Cmd0>(),
            table_of<Command>(),  command_table()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    const auto packet = parse(bytes);
    return packet ? serialise(*packet) : wire::Bytes{};
}

}  // namespace echoloop::r2sonic
