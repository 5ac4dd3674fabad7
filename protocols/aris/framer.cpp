#include "protocols/aris/framer.h"

namespace echoloop::aris {
namespace {

constexpr std::size_t shortest_command = 2;  // a type

/// Whether a command may begin here, as far as there are bytes.
bool may_begin(wire::ByteView bytes) {
    for (std::size_t i = 0; i < 2 && i < bytes.size(); ++i)
        if (bytes[i] != 0) return false;
    if (bytes.size() < length_bytes) return true;
    const auto length = wire::load<wire::ByteOrder::big, std::uint32_t>(bytes.data());
    return length >= shortest_command && length <= longest_command;
}

/// The command that begins here, if it is there to its end.
std::optional<Frame> whole(wire::ByteView bytes) {
    if (bytes.size() < length_bytes || !may_begin(bytes)) return std::nullopt;
    const auto length = wire::load<wire::ByteOrder::big, std::uint32_t>(bytes.data());
    if (bytes.size() - length_bytes < length) return std::nullopt;
    auto command = parse_command(bytes.subspan(length_bytes, length));
    if (!command) return std::nullopt;
    return Frame{std::move(*command), length_bytes + length};
}

bool is_there(wire::ByteView bytes) {
    return bytes.size() >= length_bytes &&
           bytes.size() - length_bytes >= wire::load<wire::ByteOrder::big, std::uint32_t>(bytes.data());
}

/// Where a whole command begins behind the first byte, if one does.
std::optional<std::size_t> whole_behind(wire::ByteView bytes) {
    for (std::size_t at = 1; at + length_bytes < bytes.size(); ++at)
        if (whole(bytes.subspan(at))) return at;
    return std::nullopt;
}

}  // namespace

void Framer::feed(wire::ByteView bytes) {
    finished_ = false;
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    // A caller who does not take what is complete loses the oldest bytes.
    constexpr std::size_t most = length_bytes + longest_command;
    if (buffer_.size() > most) skip(buffer_.size() - most);
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

void Framer::skip(std::size_t count) {
    begin_ += count;
    position_ += count;
    skipped_ += count;
}

std::optional<Frame> Framer::next() {
    while (pending_bytes() > 0) {
        const wire::ByteView pending = wire::ByteView(buffer_).subspan(begin_);
        if (auto frame = whole(pending)) {
            frame_offset_ = position_;
            begin_ += frame->size;
            position_ += frame->size;
            return frame;
        }
        const bool waits = may_begin(pending) && !is_there(pending);
        if (!waits || finished_)
            skip(1);
        else if (const auto behind = whole_behind(pending))
            skip(*behind);
        else
            return std::nullopt;
    }
    return std::nullopt;
}

void Framer::clear() {
    position_ += pending_bytes();
    begin_ = buffer_.size();
}

}  // namespace echoloop::aris
