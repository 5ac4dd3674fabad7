#include "protocols/teledyne/codec.h"

#include <algorithm>
#include <numeric>

#include "protocols/teledyne/layouts.h"
#include "protocols/waterlinked/pd4.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::teledyne {
namespace {

constexpr std::uint8_t mark = 0x7F, block_mark = 0x7D;
constexpr std::size_t header_size = 6, checksum_size = 2;
using Found = wire::Found<Piece>;

std::size_t word_at(wire::ByteView bytes, std::size_t at) { return bytes[at] + 256U * bytes[at + 1]; }

void put_word(wire::Bytes& bytes, std::size_t at, std::size_t value) {
    bytes[at] = static_cast<std::uint8_t>(value);
    bytes[at + 1] = static_cast<std::uint8_t>(value >> 8);
}

template <class M>
std::optional<wire::Error> add(std::vector<Section>& out, wire::ByteView bytes) {
    auto section = wire::parse<M>(bytes);
    if (!section) return section.error();
    out.push_back(*std::move(section));
    return std::nullopt;
}

std::optional<wire::Error> add_section(std::vector<Section>& out, wire::ByteView bytes) {
    switch (word_at(bytes, 0)) {
        case fixed_leader_id:
            return add<FixedLeader>(out, bytes);
        case variable_leader_id:
            return add<VariableLeader>(out, bytes);
        case velocity_id:
            return add<Velocity>(out, bytes);
        case correlation_id:
            return add<Correlation>(out, bytes);
        case intensity_id:
            return add<Intensity>(out, bytes);
        case percent_good_id:
            return add<PercentGood>(out, bytes);
        case bottom_track_id:
            return add<BottomTrack>(out, bytes);
        default:
            return add<Other>(out, bytes);
    }
}

/// Whether all bytes that are there may begin an ensemble.
bool may_begin(wire::ByteView pending) {
    if (pending.size() > 1 && pending[1] != mark) return false;
    if (pending.size() > 3 && (word_at(pending, 2) <= header_size || word_at(pending, 2) > longest_ensemble))
        return false;
    if (pending.size() < header_size) return true;
    const std::size_t begin = header_size + 2 * std::size_t{pending[5]};
    return pending[5] > 0 && begin < word_at(pending, 2) &&
           (pending.size() < header_size + 2 || word_at(pending, header_size) == begin) &&
           (pending.size() < begin || read_contents(pending).has_value());
}

Found noise(wire::ByteView pending) {
    const auto begins = [](std::uint8_t c) { return c == mark || c == block_mark || c == '\r' || c == '\n'; };
    const auto at = std::find_if(pending.begin() + 1, pending.end(), begins);
    return {static_cast<std::size_t>(at - pending.begin())};
}

Found whole(Piece::Kind kind, wire::ByteView bytes, std::string line_end = "") {
    const std::size_t size = bytes.size() + line_end.size();
    return {0, size, Piece{kind, wire::Bytes(bytes.begin(), bytes.end()), std::move(line_end)}};
}

Found find_ensemble(wire::ByteView pending, bool finished) {
    if (!may_begin(pending)) return {1};
    const auto contents = read_contents(pending);
    const bool here = contents && pending.size() >= contents->size + checksum_size;
    if (!here) return finished ? Found{1} : Found{};
    const auto bytes = pending.first(contents->size + checksum_size);
    return sum(bytes.first(contents->size)) == word_at(bytes, contents->size)
               ? whole(Piece::Kind::ensemble, bytes)
               : Found{1};
}

Found find_block(wire::ByteView pending, bool finished) {
    for (const auto& [kind, structure, size] :
         {std::tuple{Piece::Kind::pd4, 0, waterlinked::pd4_size}, {Piece::Kind::pd5, 1, pd5_size}}) {
        const std::uint8_t head[] = {block_mark, static_cast<std::uint8_t>(structure),
                                     static_cast<std::uint8_t>(size - checksum_size), 0};
        const std::size_t seen = std::min(pending.size(), std::size(head));
        if (!std::equal(head, head + seen, pending.begin())) continue;
        if (pending.size() < size) return finished ? Found{1} : Found{};
        const auto bytes = pending.first(size);
        if (sum(bytes.first(size - checksum_size)) == word_at(bytes, size - checksum_size))
            return whole(kind, bytes);
    }
    return {1};
}

bool printable(std::uint8_t c) { return c >= ' ' && c <= '~' && c != block_mark; }

Found find_line(wire::ByteView pending, bool finished) {
    const auto end = std::find_if_not(pending.begin(), pending.end(), printable);
    const auto size = static_cast<std::size_t>(end - pending.begin());
    if (size > longest_line) return noise(pending);
    if (size == pending.size() && !finished) return {};
    if (size == pending.size() || *end == mark || *end == block_mark)
        return whole(Piece::Kind::line, pending.first(size));
    if (*end != '\r' && *end != '\n') return {size};
    const bool two = *end == '\r' && size + 1 < pending.size() && pending[size + 1] == '\n';
    return whole(Piece::Kind::line, pending.first(size),
                 two ? "\r\n" : std::string(1, static_cast<char>(*end)));
}

}  // namespace

std::uint16_t sum(wire::ByteView bytes) {
    return static_cast<std::uint16_t>(std::accumulate(bytes.begin(), bytes.end(), 0U));
}

std::optional<Contents> read_contents(wire::ByteView bytes) {
    if (bytes.size() < header_size || bytes[0] != mark || bytes[1] != mark) return std::nullopt;
    Contents contents{.size = word_at(bytes, 2), .offsets = {}};
    const std::size_t begin = header_size + 2 * std::size_t{bytes[5]};
    if (begin == header_size || bytes.size() < begin) return std::nullopt;
    std::size_t least = begin;
    for (std::size_t at = header_size; at < begin; at += 2) {
        const std::size_t offset = word_at(bytes, at);
        if (offset < least || offset + 2 > contents.size) return std::nullopt;
        contents.offsets.push_back(offset);
        least = offset + 2;
    }
    if (contents.offsets.front() != begin) return std::nullopt;
    return contents;
}

wire::Bytes encode(const Ensemble& ensemble) {
    wire::Bytes bytes{mark, mark, 0, 0, ensemble.spare, static_cast<std::uint8_t>(ensemble.sections.size())};
    bytes.resize(header_size + 2 * ensemble.sections.size());
    std::size_t at = header_size;
    for (const Section& section : ensemble.sections) {
        put_word(bytes, at, bytes.size());
        at += 2;
        const wire::Bytes body = std::visit([](const auto& s) { return wire::serialise(s); }, section);
        bytes.insert(bytes.end(), body.begin(), body.end());
    }
    put_word(bytes, 2, bytes.size());
    const std::uint16_t checksum = sum(bytes);
    bytes.resize(bytes.size() + checksum_size);
    put_word(bytes, bytes.size() - checksum_size, checksum);
    return bytes;
}

wire::Result<Ensemble> parse_ensemble(wire::ByteView bytes) {
    const auto contents = read_contents(bytes);
    if (!contents || bytes.size() != contents->size + checksum_size)
        return wire::Error{"Ensemble", "size", 2, wire::Reason::wrong_constant};
    if (sum(bytes.first(contents->size)) != word_at(bytes, contents->size))
        return wire::Error{"Ensemble", "checksum", contents->size, wire::Reason::wrong_constant};
    Ensemble out{.spare = bytes[4], .sections = {}};
    for (std::size_t i = 0; i < contents->offsets.size(); ++i) {
        const std::size_t begin = contents->offsets[i];
        const std::size_t end = i + 1 < contents->offsets.size() ? contents->offsets[i + 1] : contents->size;
        if (const auto error = add_section(out.sections, bytes.subspan(begin, end - begin))) return *error;
    }
    return out;
}

wire::Bytes encode(Pd5 block) {
    const wire::Bytes bytes = wire::serialise(block);
    block.checksum = sum(wire::ByteView(bytes).first(bytes.size() - checksum_size));
    return wire::serialise(block);
}

wire::Result<Pd5> parse_pd5(wire::ByteView bytes) {
    auto block = wire::parse<Pd5>(bytes);
    if (!block) return block.error();
    if (block->checksum != sum(bytes.first(bytes.size() - checksum_size)))
        return wire::Error{"PD5", "checksum", bytes.size() - checksum_size, wire::Reason::wrong_constant};
    return block;
}

wire::Found<Piece> PieceFinder::find(wire::ByteView pending, bool finished) const {
    const std::uint8_t first = pending.front();
    if (first == '\r' || first == '\n') return {0, 1};
    if (first == mark) return find_ensemble(pending, finished);
    if (first == block_mark) return find_block(pending, finished);
    return printable(first) ? find_line(pending, finished) : noise(pending);
}

}  // namespace echoloop::teledyne
