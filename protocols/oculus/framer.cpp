#include "protocols/oculus/framer.h"

#include <algorithm>

#include "protocols/oculus/layouts.h"

namespace echoloop::oculus {
namespace {

/// Where another header begins within the first `size` bytes, if one does.
std::optional<std::size_t> header_within(wire::ByteView bytes, std::size_t size, std::size_t longest) {
    for (std::size_t at = 1; at < size && at + header_bytes <= bytes.size(); ++at)
        if (bytes[at] == 'S' && plausible_header(bytes.subspan(at), longest)) return at;
    return std::nullopt;
}

}  // namespace

void Framer::feed(wire::ByteView bytes) {
    finished_ = false;
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    // A caller who does not take what is complete loses the oldest bytes.
    const std::size_t most = longest_ + header_bytes;
    if (buffer_.size() > most) skip(buffer_.size() - most);
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

void Framer::skip(std::size_t count) {
    begin_ += count;
    position_ += count;
    skipped_ += count;
}

void Framer::skip_noise() {
    const auto from = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_) + 1;
    skip(static_cast<std::size_t>(std::find(from, buffer_.end(), std::uint8_t{'S'}) - from) + 1);
}

std::optional<Frame> Framer::next() {
    while (pending_bytes() > 0) {
        const wire::ByteView pending = wire::ByteView(buffer_).subspan(begin_);
        const auto header = plausible_header(pending, longest_);
        const bool may_begin = pending[0] == 'S' && (pending.size() < 2 || pending[1] == 'O');
        if (!header) {
            if (may_begin && pending.size() < header_bytes && !finished_) return std::nullopt;
            skip_noise();
            continue;
        }
        const std::size_t size = header_bytes + payload_bytes(*header);

        // An image may hold anything, leftovers of older headers too.
        const bool short_one = payload_bytes(*header) <= status_payload;
        if (const auto inner = short_one ? header_within(pending, size, longest_) : std::nullopt) {
            skip(*inner);
        } else if (pending.size() >= size) {
            return take(*header);
        } else if (finished_) {
            skip_noise();
        } else {
            return std::nullopt;
        }
    }
    return std::nullopt;
}

Frame Framer::take(const Header& header) {
    const std::size_t size = payload_bytes(header);
    const auto first = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_ + header_bytes);
    Frame frame{header, wire::Bytes(first, first + static_cast<std::ptrdiff_t>(size))};
    frame_offset_ = position_;
    begin_ += header_bytes + size;
    position_ += header_bytes + size;
    return frame;
}

void Framer::clear() {
    position_ += pending_bytes();
    begin_ = buffer_.size();
}

}  // namespace echoloop::oculus
