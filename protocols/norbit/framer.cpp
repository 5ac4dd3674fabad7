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

void Framer::feed(wire::ByteView bytes) {
    finished_ = false;
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    // A caller who does not take what is complete loses the oldest bytes.
    if (buffer_.size() > max_packet) skip(buffer_.size() - max_packet);
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

void Framer::skip(std::size_t count) {
    begin_ += count;
    position_ += count;
    skipped_ += count;
}

void Framer::skip_noise() {
    const auto from = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_) + 1;
    skip(static_cast<std::size_t>(std::find(from, buffer_.end(), start[0]) - from) + 1);
}

std::optional<Frame> Framer::next() {
    while (pending_bytes() > 0) {
        const wire::ByteView pending = wire::ByteView(buffer_).subspan(begin_);
        const auto header = plausible_header(pending);
        const bool is_cut =
            header ? pending.size() < header->size : pending.size() < header_bytes && may_begin(pending);
        if (is_cut && !finished_) return std::nullopt;
        if (is_cut || !header) {
            skip_noise();
            continue;
        }
        const wire::ByteView payload = pending.subspan(header_bytes, header->size - header_bytes);
        if (!has_right_crc(*header, payload)) {
            skip_noise();
            continue;
        }
        frame_offset_ = position_;
        begin_ += header->size;
        position_ += header->size;
        return Frame{*header, wire::Bytes(payload.begin(), payload.end())};
    }
    return std::nullopt;
}

}  // namespace echoloop::norbit
