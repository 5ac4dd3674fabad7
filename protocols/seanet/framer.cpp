#include "protocols/seanet/framer.h"

#include <algorithm>
#include <array>

#include "protocols/seanet/layouts.h"
#include "protocols/wire/read.h"

namespace echoloop::seanet {

namespace {

constexpr std::size_t max_pending = 65536;
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

void Framer::feed(wire::ByteView bytes) {
    finished_ = false;
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    if (pending_bytes() > max_pending) skip(pending_bytes() - max_pending);
}

void Framer::skip(std::size_t count) {
    begin_ += count;
    position_ += count;
    skipped_ += count;
}

std::optional<Frame> Framer::next() {
    while (pending_bytes() > 0) {
        const auto start =
            std::find(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_), buffer_.end(), '@');
        skip(static_cast<std::size_t>(start - buffer_.begin()) - begin_);
        if (pending_bytes() == 0) break;
        const Step step = at_begin();
        if (step.wait && !finished_) break;
        if (!step.frame) {
            skip(1);
            continue;
        }
        frame_offset_ = position_;
        begin_ += step.bytes;
        position_ += step.bytes;
        return step.frame;
    }
    return std::nullopt;
}

Framer::Step Framer::at_begin() const {
    const ByteView pending = ByteView(buffer_).subspan(begin_);
    const auto size = frame_bytes(pending);
    if (!size) return {.wait = true};
    if (*size == 0) return {};
    if (lengths_ == Lengths::by_id) {
        if (pending.size() < min_frame_bytes) return {.wait = true};
        if (auto frame = short_command(pending)) return {.frame = std::move(frame), .bytes = min_frame_bytes};
    }
    if (pending.size() < *size) return {.wait = true};
    auto frame = wire::parse<Frame>(pending.first(*size));
    if (!frame) return {};
    return {.frame = *std::move(frame), .bytes = *size};
}

void Framer::clear() {
    position_ += pending_bytes();
    begin_ = buffer_.size();
}

}  // namespace echoloop::seanet
