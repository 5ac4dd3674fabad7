#include "protocols/sonar3d/framer.h"

#include <algorithm>

namespace echoloop::sonar3d {

void Framer::feed(wire::ByteView bytes) {
    finished_ = false;
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

std::optional<wire::Bytes> Framer::next() {
    while (pending_bytes() > 0) {
        const wire::ByteView pending = wire::ByteView(buffer_).subspan(begin_);
        const auto size = packet_size(pending);
        const bool whole = size && *size != 0 && *size <= pending.size();
        if (whole && is_packet(pending.first(*size))) return take(*size);
        const bool may_come = !size || *size > pending.size();
        if (may_come && !finished_) return std::nullopt;
        skip_noise();
    }
    return std::nullopt;
}

wire::Bytes Framer::take(std::size_t size) {
    const auto first = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_);
    wire::Bytes packet(first, first + static_cast<std::ptrdiff_t>(size));
    frame_offset_ = position_;
    begin_ += size;
    position_ += size;
    return packet;
}

void Framer::skip_noise() {
    const auto from = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_) + 1;
    const auto count = static_cast<std::size_t>(std::find(from, buffer_.end(), std::uint8_t{'R'}) - from) + 1;
    begin_ += count;
    position_ += count;
    skipped_ += count;
}

}  // namespace echoloop::sonar3d
