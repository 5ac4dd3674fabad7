#include "protocols/r2sonic/codec.h"

#include "protocols/r2sonic/known_sections.h"
#include "protocols/r2sonic/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::r2sonic {

namespace {

bool has_text(ByteView bytes, std::size_t offset, std::string_view text) {
    return bytes.size() >= offset + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + offset);
}

template <class P>
Result<Packet> parse_as(ByteView datagram) {
    auto packet = wire::parse<P>(datagram);
    if (!packet) return packet.error();
    return Packet(*std::move(packet));
}

/// The layout knows the first snippet; others may follow.
template <>
Result<Packet> parse_as<Sni0>(ByteView datagram) {
    wire::Reader reader{.bytes = datagram};
    Sni0 packet;
    if (!read_fields(reader, packet)) return reader.error;
    while (reader.left() > 0) {
        reader.counts = {};  // each snippet has its own number of samples
        S1 snippet;
        if (!starts_with(reader, wire::layout<S1>.tag)) {
            reader.fail(wire::Reason::wrong_section, "SNI0", "s1");
            return reader.error;
        }
        if (!read_section(reader, snippet)) return reader.error;
        packet.others.push_back(std::move(snippet));
    }
    return Packet(std::move(packet));
}

/// The manual prints the head's sensors as "SENa"; firmware may well write all names in capitals.
wire::Bytes with_usual_names(ByteView datagram) {
    constexpr std::string_view capitals = "SENA";
    constexpr std::size_t header = 12, name = 4;
    wire::Bytes out(datagram.begin(), datagram.end());
    for (std::size_t at = header; at + name <= out.size();) {
        const std::size_t words = wire::tagged_words(static_cast<char>(out[at + name - 1]));
        if (has_text(out, at, capitals)) out[at + name - 1] = 'a';
        if (words == 0) break;
        at += name + 4 * words;
    }
    return out;
}

template <class P>
Result<Packet> parse_status(ByteView datagram) {
    return parse_as<P>(with_usual_names(datagram));
}

wire::Bytes bytes_of(const auto& packet) { return wire::serialise(packet); }

wire::Bytes bytes_of(const Sni0& packet) {
    wire::Writer writer;
    writer.counts.message(packet);
    write_fields(writer, packet);
    for (const S1& snippet : packet.others) {
        writer.counts = {};
        writer.counts.message(snippet);
        write_section(writer, snippet);
    }
    writer.set_size(writer.out, writer.size_at);
    return std::move(writer.out);
}

struct Row {
    std::string_view name;
    std::string_view section;  ///< that stands at byte 12, if the name alone does not tell
    Result<Packet> (*parse)(ByteView);
};
constexpr Row rows[] = {
    {"BTH0", "", parse_as<Bth0>},       {"AID0", "H0", parse_as<Aid0Head>}, {"AID0", "", parse_as<Aid0Data>},
    {"WCD0", "H0", parse_as<Wcd0Head>}, {"WCD0", "", parse_as<Wcd0Data>},   {"SNI0", "", parse_as<Sni0>},
    {"TPX0", "", parse_as<Tpx0>},       {"STH0", "", parse_status<Sth0>},   {"STS0", "", parse_status<Sts0>},
    {"R2DS", "", parse_as<R2ds>},       {"R2DD", "", parse_as<R2dd>},       {"R2DI", "", parse_as<R2di>},
    {"R2DC", "", parse_as<R2dc>},       {"CMD0", "", parse_as<Cmd0>}};

bool is_of(const Row& row, ByteView datagram) {
    return has_text(datagram, 0, row.name) && (row.section.empty() || has_text(datagram, 12, row.section));
}

/// Sections in the usual order, no others among them.
Result<Packet> parse_as_it_stands(ByteView datagram) {
    for (const Row& row : rows) {
        if (is_of(row, datagram)) return row.parse(datagram);
    }
    return wire::Error{"R2Sonic", "name", 0,
                       datagram.size() < 4 ? wire::Reason::truncated : wire::Reason::unknown_message};
}

}  // namespace

bool recognise(wire::ByteView bytes) {
    return std::any_of(std::begin(rows), std::end(rows), [&](const Row& row) { return is_of(row, bytes); });
}

wire::Result<Packet> parse(wire::ByteView datagram) {
    auto packet = parse_as_it_stands(datagram);
    if (packet) return packet;
    const auto known = known_sections(datagram);
    if (!known) return packet;
    auto of_known = parse_as_it_stands(*known);
    return of_known ? of_known : packet;
}

wire::Bytes serialise(const Packet& packet) {
    return std::visit([](const auto& p) { return bytes_of(p); }, packet);
}

std::string_view name_of(const Packet& packet) {
    return std::visit([]<class P>(const P&) { return wire::layout<P>.name.substr(0, 4); }, packet);
}

}  // namespace echoloop::r2sonic
