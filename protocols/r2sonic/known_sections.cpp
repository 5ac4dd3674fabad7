#include "protocols/r2sonic/known_sections.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace echoloop::r2sonic {

namespace {

using wire::ByteOrder;
using wire::Bytes;
using wire::ByteView;

constexpr std::size_t header_size = 12, size_at = 4;

struct Order {
    std::string_view packet;
    std::string_view tags;  ///< two characters each
    bool size_may_be_0 = false;
};
constexpr std::array orders{Order{"BTH0", "H0R0A0A2I1G0G1Q0"}, Order{"AID0", "H0A1M0"},
                            Order{"WCD0", "H0A1M1M2"}, Order{"SNI0", "H0S1", true},
                            Order{"TPX0", "H0D0D1", true}};

std::string_view text(ByteView bytes, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes.data()), size};
}

struct Piece {
    std::size_t rank;  ///< place of its tag in the order
    ByteView bytes;
};

/// Place of the tag in the order; npos if it is not of this packet.
std::size_t rank_of(std::string_view tag, std::string_view tags) {
    for (std::size_t at = 0; at < tags.size(); at += 2)
        if (tags.substr(at, 2) == tag) return at;
    return std::string_view::npos;
}

/// The known sections; nothing if a size leads beyond the datagram.
std::optional<std::vector<Piece>> pieces(ByteView datagram, std::string_view tags) {
    std::vector<Piece> found;
    for (ByteView rest = datagram.subspan(header_size); !rest.empty();) {
        if (rest.size() < 4) return std::nullopt;
        const std::size_t size = wire::load<ByteOrder::big, std::uint16_t>(rest.data() + 2);
        if (size < 4 || size % 4 != 0 || size > rest.size()) return std::nullopt;
        const std::size_t rank = rank_of(text(rest, 2), tags);
        if (rank != std::string_view::npos) found.push_back({rank, rest.first(size)});
        rest = rest.subspan(size);
    }
    return found;
}

}  // namespace

std::optional<Bytes> known_sections(ByteView datagram) {
    if (datagram.size() < header_size) return std::nullopt;
    const auto order = std::find_if(orders.begin(), orders.end(),
                                    [&](const Order& o) { return o.packet == text(datagram, 4); });
    if (order == orders.end()) return std::nullopt;
    const auto said = wire::load<ByteOrder::big, std::uint32_t>(datagram.data() + size_at);
    if (said != datagram.size() && !(said == 0 && order->size_may_be_0)) return std::nullopt;
    auto found = pieces(datagram, order->tags);
    if (!found) return std::nullopt;
    std::stable_sort(found->begin(), found->end(), [](auto& a, auto& b) { return a.rank < b.rank; });
    Bytes out(datagram.begin(), datagram.begin() + header_size);
    for (const Piece& piece : *found) out.insert(out.end(), piece.bytes.begin(), piece.bytes.end());
    wire::store<ByteOrder::big>(static_cast<std::uint32_t>(out.size()), out.data() + size_at);
    if (std::equal(out.begin(), out.end(), datagram.begin(), datagram.end())) return std::nullopt;
    return out;
}

}  // namespace echoloop::r2sonic
