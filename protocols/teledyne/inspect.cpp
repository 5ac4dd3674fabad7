#include "protocols/teledyne/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/teledyne/codec.h"
#include "protocols/teledyne/layouts.h"
#include "protocols/waterlinked/inspect.h"
#include "protocols/waterlinked/pd4.h"

namespace echoloop::teledyne {
namespace {

using inspect::Message;
using Kind = Piece::Kind;

void add_ensemble(Message& out, const wire::Bytes& bytes) {
    out.name = "Ensemble";
    const auto ensemble = parse_ensemble(bytes);
    if (!ensemble) {
        out.reason = ensemble.error().what();
        return;
    }
    const auto contents = read_contents(bytes);
    for (std::size_t i = 0; i < ensemble->sections.size(); ++i)
        std::visit(
            [&]<class M>(const M& section) {
                wire::visit_fields(section, [&](wire::FieldView view) {
                    view.name = std::string(wire::layout<M>.name) + '.' + view.name;
                    out.fields.push_back(inspect::to_field(view, out.offset + contents->offsets[i]));
                });
            },
            ensemble->sections[i]);
}

template <class M>
void add_block(Message& out, const wire::Result<M>& block) {
    out.name = wire::layout<M>.name;
    if (block)
        inspect::add_fields(out, *block);
    else
        out.reason = block.error().what();
}

Message inspected(const Piece& piece, std::size_t offset, std::size_t size) {
    Message out{.offset = offset, .size = size};
    switch (piece.kind) {
        case Kind::ensemble:
            add_ensemble(out, piece.bytes);
            break;
        case Kind::pd4:
            add_block(out, waterlinked::parse_pd4(piece.bytes));
            break;
        case Kind::pd5:
            add_block(out, parse_pd5(piece.bytes));
            break;
        case Kind::line:
            if (const std::string text(piece.bytes.begin(), piece.bytes.end()); waterlinked::is_pd6(text)) {
                waterlinked::add_pd6(out, text);
                break;
            }
            out.name = "Console";
            out.fields.push_back({.name = "text",
                                  .text = {piece.bytes.begin(), piece.bytes.end()},
                                  .offset = offset,
                                  .size = piece.bytes.size()});
            break;
    }
    return out;
}

}  // namespace

std::vector<Message> decode(wire::ByteView bytes) { return inspect::decode_stream<Framer>(bytes, inspected); }

/// Anybody says lines.
bool recognise(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    while (const auto piece = framer.next())
        if (piece->kind != Kind::line) return true;
    return false;
}

std::vector<wire::Table> tables() {
    std::vector<wire::Table> all{
        wire::table_of<FixedLeader>(), wire::table_of<VariableLeader>(),  wire::table_of<Velocity>(),
        wire::table_of<Cell>(),        wire::table_of<Correlation>(),     wire::table_of<Intensity>(),
        wire::table_of<PercentGood>(), wire::table_of<BottomTrack>(),     wire::table_of<Other>(),
        wire::table_of<Pd5>(),         wire::table_of<waterlinked::Pd4>()};
    for (wire::Table& table : waterlinked::pd6_tables()) all.push_back(std::move(table));
    return all;
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const Piece& piece) -> wire::Bytes {
        if (piece.kind == Kind::ensemble) {
            const auto ensemble = parse_ensemble(piece.bytes);
            return ensemble ? encode(*ensemble) : wire::Bytes{};
        }
        if (piece.kind == Kind::pd5) {
            const auto block = parse_pd5(piece.bytes);
            return block ? encode(*block) : wire::Bytes{};
        }
        if (piece.kind == Kind::pd4) {
            const auto block = waterlinked::parse_pd4(piece.bytes);
            return block ? waterlinked::encode(*block) : wire::Bytes{};
        }
        wire::Bytes line = piece.bytes;
        line.insert(line.end(), piece.line_end.begin(), piece.line_end.end());
        return line;
    });
}

std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    std::vector<ChecksumPlace> places;
    while (const auto piece = framer.next())
        if (piece->kind != Kind::line)
            places.push_back({framer.frame_offset() + piece->bytes.size() - 2, 2, false});
    return places;
}

}  // namespace echoloop::teledyne
