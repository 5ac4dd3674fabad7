#include "protocols/seanet/framer.h"

#include <algorithm>
#include <array>

#include "protocols/seanet/layouts.h"
#include "protocols/wire/read.h"

namespace echoloop::seanet {

namespace {

constexpr std::size_t lengths_end = 7;  ///< of '@' and both length fields
constexpr std::size_t id_at = 10;
constexpr std::size_t min_length = min_frame_bytes - 6;

constexpr std::array no_payload = {Id::reboot, Id::send_version, Id::send_bb_user, Id::stop_alives};

/// Bytes of the frame that starts here, 0 if no frame can start here, or nothing if more bytes must come
/// first.
std::optional<std::size_t> frame_bytes(ByteView bytes) {
    std::uint64_t digits = 0;
    if (bytes.size() < lengths_end) {
        const bool hex =
            std::all_of(bytes.begin() + 1, bytes.begin() + std::min<std::size_t>(5, bytes.size()),
                        [](std::uint8_t c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F'); });
        return hex ? std::nullopt : std::optional<std::size_t>(0);
    }
    if (!read_hex4(bytes.data() + 1, digits)) return 0;
    const std::uint16_t length = load<ByteOrder::little, std::uint16_t>(bytes.data() + 5);
    const bool fits = length == digits && length >= min_length && length + 6U <= max_frame_bytes;
    return fits ? length + 6U : 0U;
}

/// A command without payload whose LF stands where its id says, whatever its length claims.
std::optional<Frame> short_command(ByteView bytes) {
    if (bytes.size() < min_frame_bytes || bytes[min_frame_bytes - 1] != '\n') return std::nullopt;
    const auto id = static_cast<Id>(bytes[id_at]);
    if (std::find(no_payload.begin(), no_payload.end(), id) == no_payload.end()) return std::nullopt;
    Reader reader{.bytes = bytes.subspan(lengths_end)};
    Frame frame;
    read_fields(reader, frame.header);
    return frame;
}

}  // namespace

wire::Found<Frame> FrameFinder::find(ByteView pending, bool finished) const {
    const wire::Found<Frame> noise{wire::bytes_before('@', pending)};
    if (pending[0] != '@') return noise;
    const wire::Found<Frame> rest_to_come = finished ? noise : wire::Found<Frame>{};
    const auto size = frame_bytes(pending);
    if (!size) return rest_to_come;
    if (*size == 0) return noise;
    if (lengths_ == Lengths::by_id) {
        if (pending.size() < min_frame_bytes) return rest_to_come;
        if (auto frame = short_command(pending)) return {0, min_frame_bytes, std::move(frame)};
    }
    if (pending.size() < *size) return rest_to_come;
    auto frame = wire::parse<Frame>(pending.first(*size));
    if (!frame) return noise;
    return {0, *size, *std::move(frame)};
}

}  // namespace echoloop::seanet
