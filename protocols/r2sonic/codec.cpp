#include "protocols/r2sonic/codec.h"

#include "protocols/r2sonic/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::r2sonic {

namespace {

template <class P>
Result<Packet> parse_as(ByteView datagram) {
    auto packet = wire::parse<P>(datagram);
    if (!packet) return packet.error();
    return Packet(*std::move(packet));
}

bool has_text(ByteView bytes, std::size_t offset, std::string_view text) {
    return bytes.size() >= offset + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + offset);
}

struct Row {
    std::string_view name;
    std::string_view section;  ///< that stands at byte 12, if the name alone does not tell
    Result<Packet> (*parse)(ByteView);
};
constexpr Row rows[] = {{"BTH0", "", parse_as<Bth0>},     {"AID0", "H0", parse_as<Aid0Head>},
                        {"AID0", "", parse_as<Aid0Data>}, {"STH0", "", parse_as<Sth0>},
                        {"STS0", "", parse_as<Sts0>},     {"R2DS", "", parse_as<R2ds>},
                        {"R2DD", "", parse_as<R2dd>},     {"R2DI", "", parse_as<R2di>},
                        {"R2DC", "", parse_as<R2dc>},     {"CMD0", "", parse_as<Cmd0>}};

bool is_of(const Row& row, ByteView datagram) {
    return has_text(datagram, 0, row.name) && (row.section.empty() || has_text(datagram, 12, row.section));
}

}  // namespace

bool recognise(wire::ByteView bytes) {
    return std::any_of(std::begin(rows), std::end(rows), [&](const Row& row) { return is_of(row, bytes); });
}

wire::Result<Packet> parse(wire::ByteView datagram) {
    for (const Row& row : rows) {
        if (is_of(row, datagram)) return row.parse(datagram);
    }
    return wire::Error{"R2Sonic", "name", 0,
                       datagram.size() < 4 ? wire::Reason::truncated : wire::Reason::unknown_message};
}

wire::Bytes serialise(const Packet& packet) {
    return std::visit([](const auto& p) { return wire::serialise(p); }, packet);
}

std::string_view name_of(const Packet& packet) {
    return std::visit([]<class P>(const P&) { return wire::layout<P>.name.substr(0, 4); }, packet);
}

}  // namespace echoloop::r2sonic
