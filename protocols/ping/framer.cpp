#include "protocols/ping/framer.h"

#include <algorithm>
#include <utility>

#include "protocols/ping/codec.h"
#include "protocols/ping/layouts.h"
#include "protocols/wire/read.h"

namespace echoloop::ping {
namespace {

constexpr std::size_t max_pending = 65536;
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
        const auto size = frame_bytes(ByteView(buffer_).subspan(begin_));
        if (size && *size > 0) return take(*size);
        if (!size && !finished_) {
            const auto behind = waiting_ == Waiting::impatient ? whole_frame_behind() : std::nullopt;
            if (!behind) return std::nullopt;
            skip(*behind);
            continue;
        }
        skip(1);
    }
    return std::nullopt;
}

std::optional<std::size_t> Framer::whole_frame_behind() const {
    const ByteView pending = ByteView(buffer_).subspan(begin_);
    for (std::size_t at = 1; at + min_frame_bytes <= pending.size(); ++at)
        if (frame_bytes(pending.subspan(at)).value_or(0) > 0) return at;
    return std::nullopt;
}

Frame Framer::take(std::size_t size) {
    auto frame = wire::parse<Frame>(ByteView(buffer_).subspan(begin_, size));
    frame_offset_ = position_;
    begin_ += size;
    position_ += size;
    return *std::move(frame);
}

void Framer::clear() {
    position_ += pending_bytes();
    begin_ = buffer_.size();
}

}  // namespace echoloop::ping
