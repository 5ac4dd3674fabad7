#include "protocols/norbit/framer.h"

#include <algorithm>

#include "protocols/norbit/layouts.h"

namespace echoloop::norbit {
namespace {

constexpr std::uint8_t start[] = {0xEF, 0xBE, 0xAD, 0xDE};

bool may_begin(wire::ByteView bytes) {
    const std::size_t size = std::min(bytes.size(), std::size(start));
    return std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size), start);
}

}  // namespace

wire::Found<Frame> PacketFinder::find(wire::ByteView pending, bool finished) const {
    const auto header = plausible_header(pending);
    const bool is_cut =
        header ? pending.size() < header->size : pending.size() < header_bytes && may_begin(pending);
    if (is_cut && !finished) return {};
    const wire::Found<Frame> noise{wire::bytes_before(start[0], pending)};
    if (is_cut || !header) return noise;
    const wire::ByteView payload = pending.subspan(header_bytes, header->size - header_bytes);
    if (!has_right_crc(*header, payload)) return noise;
    return {0, header->size, Frame{*header, wire::Bytes(payload.begin(), payload.end())}};
}

}  // namespace echoloop::norbit
