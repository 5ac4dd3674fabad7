// Cuts a byte stream into the frames of a protocol, and skips and counts everything else; what a frame is,
// the protocol says. Never opens or waits for anything.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "protocols/wire/bytes.h"

namespace echoloop::wire {

/// What stands at the front of pending bytes: some that belong to no frame, then perhaps a frame. With a size
/// but no frame: a message that nobody asked for, which is passed over and is no noise. All empty: more bytes
/// must come first.
template <class Frame>
struct Found {
    std::size_t skipped = 0;  ///< bytes
    std::size_t size = 0;     ///< of the frame, bytes
    std::optional<Frame> frame{};
};

/// The most bytes that wait; beyond them the oldest are skipped.
struct FramerLimits {
    std::size_t before = std::numeric_limits<std::size_t>::max();  ///< when more bytes come, without those
    std::size_t with = std::numeric_limits<std::size_t>::max();    ///< the bytes that came last
};

/// How many bytes stand before the next `start` behind the first byte, or before the end.
inline std::size_t bytes_before(std::uint8_t start, ByteView pending) {
    return static_cast<std::size_t>(std::find(pending.begin() + 1, pending.end(), start) - pending.begin());
}

inline std::string_view characters(ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A Finder knows the protocol. Its `find(pending, finished)` is never called without pending bytes;
/// `finished` says that no more will come. Its `limits()` bound the memory.
template <class Frame, class Finder>
class Framer : public Finder {
  public:
    using Finder::Finder;

    /// Appends received bytes.
    void feed(ByteView bytes) {
        finished_ = false;
        buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
        begin_ = 0;
        const FramerLimits limits = this->limits();
        keep(limits.before);
        buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
        keep(limits.with);
    }
    /// No more bytes will come: what waits for the rest of a frame is searched for others, then skipped.
    void finish() { finished_ = true; }
    /// The next complete frame, or nothing until more bytes come.
    std::optional<Frame> next() {
        while (pending_bytes() > 0) {
            Found<Frame> found = this->find(ByteView(buffer_).subspan(begin_), finished_);
            if (found.skipped == 0 && found.size == 0) break;
            skip(found.skipped);
            if (found.frame) frame_offset_ = position_;
            pass(found.size);
            if (found.frame) return std::move(found.frame);
        }
        return std::nullopt;
    }

    /// Bytes that belonged to no frame so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the first byte of the frame returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes of the frame returned last, before next() or feed() is called again.
    std::size_t frame_size() const { return static_cast<std::size_t>(position_ - frame_offset_); }
    /// Bytes received that are neither skipped nor part of a returned frame.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }
    /// Forgets pending bytes without counting them, e.g. when another host connects.
    void clear() { pass(pending_bytes()); }

  private:
    void keep(std::size_t most) {
        if (pending_bytes() > most) skip(pending_bytes() - most);
    }
    void skip(std::size_t count) {
        pass(count);
        skipped_ += count;
    }
    void pass(std::size_t count) {
        begin_ += count;
        position_ += count;
    }

    bool finished_ = false;
    Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::wire
