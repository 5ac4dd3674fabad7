#include "protocols/ping/framer.h"

#include "protocols/ping/codec.h"
#include "protocols/ping/layouts.h"
#include "protocols/wire/read.h"

namespace echoloop::ping {
namespace {

constexpr std::size_t length_end = 4;  ///< of "BR" and the length

/// Bytes of the frame that starts here, 0 if no frame can start here, or nothing if more bytes must come
/// first.
std::optional<std::size_t> frame_bytes(ByteView bytes) {
    if (bytes[0] != 'B' || (bytes.size() > 1 && bytes[1] != 'R')) return 0;
    if (bytes.size() < length_end) return std::nullopt;
    const std::size_t size = load<ByteOrder::little, std::uint16_t>(bytes.data() + 2) + min_frame_bytes;
    if (size > max_frame_bytes) return 0;
    if (bytes.size() < size) return std::nullopt;
    const auto sum = load<ByteOrder::little, std::uint16_t>(bytes.data() + size - 2);
    return sum == checksum(bytes.first(size)) ? size : 0;
}

/// Where a whole frame begins behind the first byte; 0 if none does.
std::size_t whole_frame_behind(ByteView pending) {
    for (std::size_t at = 1; at + min_frame_bytes <= pending.size(); ++at)
        if (frame_bytes(pending.subspan(at)).value_or(0) > 0) return at;
    return 0;
}

}  // namespace

wire::Found<Frame> FrameFinder::find(ByteView pending, bool finished) const {
    const auto size = frame_bytes(pending);
    if (size && *size > 0) return {0, *size, *wire::parse<Frame>(pending.first(*size))};
    if (size || finished) return {wire::bytes_before('B', pending)};
    return {waiting_ == Waiting::impatient ? whole_frame_behind(pending) : 0};
}

}  // namespace echoloop::ping
