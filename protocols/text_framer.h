// Cuts a byte stream into the lines of a text protocol, and skips and counts everything else; what a line is
// its protocol says. Never opens or waits for anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "protocols/wire/bytes.h"

namespace echoloop {

/// What stands at the front of pending bytes: some that belong to no line, then perhaps a line. Neither: more
/// bytes must come first.
template <class Line>
struct TextFound {
    std::size_t skipped = 0;
    std::optional<Line> line{};
};

/// A Line has a `size` in bytes, with the line's end. `look(pending, finished)` is never called without
/// pending bytes; `finished` says that no more will come.
template <class Line, TextFound<Line> (*look)(std::string_view pending, bool finished)>
class TextFramer {
  public:
    /// Appends received bytes; all that next() leaves is at most one unfinished line.
    void feed(wire::ByteView bytes) {
        finished_ = false;
        buffer_.erase(0, begin_);
        begin_ = 0;
        buffer_.append(bytes.begin(), bytes.end());
    }
    /// No more bytes will come: what is no line without them is skipped.
    void finish() { finished_ = true; }
    /// The next complete line, or nothing until more bytes come.
    std::optional<Line> next() {
        while (pending_bytes() > 0) {
            TextFound<Line> found = look(std::string_view(buffer_).substr(begin_), finished_);
            if (!found.line && found.skipped == 0) break;
            pass(found.skipped);
            skipped_ += found.skipped;
            if (!found.line) continue;
            frame_offset_ = position_;
            pass(found.line->size);
            return std::move(found.line);
        }
        return std::nullopt;
    }

    /// Bytes that belonged to no line so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the line returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned line.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }

  private:
    void pass(std::size_t count) {
        begin_ += count;
        position_ += count;
    }

    bool finished_ = false;
    std::string buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop
