#include "protocols/imagenex/framer.h"

#include <algorithm>

#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex {
namespace {

using wire::ByteView;
/// Bytes of the frame that starts here, 0 if none can start here, or nothing if more bytes must come first.
using Size = std::optional<std::size_t>;

constexpr std::uint8_t command_end = 0xFD, reply_end = 0xFC;

/// The first FD ends what a head collects, whether it belongs there or not.
Size find_command(ByteView bytes) {
    if (bytes.size() > 1 && bytes[1] != 0x44) return 0;
    const auto seen = bytes.first(std::min(bytes.size(), command_bytes));
    const auto end = std::find(seen.begin(), seen.end(), command_end);
    if (end != seen.end()) return end - seen.begin() + 1 == command_bytes ? command_bytes : 0;
    return bytes.size() < command_bytes ? Size() : 0;
}

Size find_reply(ByteView bytes) {
    constexpr std::size_t count_at = 10;
    constexpr std::string_view letters = "MGPA";
    if (bytes.size() > 1 && letters.find(static_cast<char>(bytes[1])) == std::string_view::npos) return 0;
    if (bytes.size() > 2 && bytes[2] != 'X') return 0;
    if (bytes.size() < reply_overhead) return std::nullopt;
    std::size_t size = reply_overhead;
    if (bytes[1] == 'A') {
        if (bytes[3] != azimuth_head_id) return 0;
    } else {
        if (((bytes[count_at] | bytes[count_at + 1]) & 0x80) != 0) return 0;
        const std::size_t data = static_cast<std::size_t>(bytes[count_at + 1]) << 7 | bytes[count_at];
        const bool pipe = is_of_831l(bytes[1], bytes[3]);
        if (pipe ? !is_legal_pipe_data_size(bytes[1], data) : !is_legal_data_size(data)) return 0;
        size = (pipe ? pipe_reply_overhead : reply_overhead) + data;
    }
    if (bytes.size() < size) return std::nullopt;
    return bytes[size - 1] == reply_end ? size : 0;
}

/// Whether the reply in a whole shot has a name and an end.
bool holds_reply(ByteView shot) {
    const std::size_t size = static_cast<std::size_t>(shot[6]) << 8 | shot[7];
    const ByteView reply = shot.subspan(shot[0] == '3' ? Shot31L::reply_at : shot_header_bytes, size);
    return size >= reply_overhead && reply[0] == 'I' && reply[2] == 'X' && reply[size - 1] == reply_end;
}

Size find_shot(ByteView bytes) {
    const Size size = shot_bytes(bytes);
    if (!size || *size == 0) return size;
    if (*size > bytes.size()) return std::nullopt;
    return holds_reply(bytes) ? size : 0;
}

Size frame_bytes(ByteView bytes, FrameFinder::Takes takes) {
    if (bytes[0] == 0xFE) return find_command(bytes);
    if (takes == FrameFinder::Takes::commands) return 0;
    if (bytes[0] == 'I') return find_reply(bytes);
    if (bytes[0] == '8' || bytes[0] == '3') return find_shot(bytes);
    return 0;
}

}  // namespace

wire::Found<wire::Bytes> FrameFinder::find(ByteView pending, bool finished) const {
    const Size size = frame_bytes(pending, takes_);
    if (!size && !finished) return {};
    if (!size || *size == 0) return {1};
    return {0, *size, wire::Bytes(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(*size))};
}

}  // namespace echoloop::imagenex
