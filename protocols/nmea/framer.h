// Cuts a byte stream into NMEA 0183 sentences, and skips and counts everything else. Never opens or waits for
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "protocols/wire/bytes.h"

namespace echoloop::nmea {

/// The standard ends at 82 characters; makers' own sentences do not keep to it.
inline constexpr std::size_t longest_line = 512;

/// A line that looks like a sentence: '$' or '!', an address of capital letters and digits, printable
/// characters, CR LF or LF. Its checksum has not been looked at.
struct Line {
    std::string text;      ///< from '$' to the character before the line's end
    std::size_t size = 0;  ///< bytes, with the line's end
};

class Framer {
  public:
    /// Appends received bytes; all that next() leaves is at most one unfinished line.
    void feed(wire::ByteView bytes);
    /// No more bytes will come: a last line may end behind its checksum.
    void finish() { finished_ = true; }
    /// The next complete line, or nothing until more bytes come.
    std::optional<Line> next();

    /// Bytes that belonged to no line so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the '$' of the line returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned line.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }

  private:
    void skip(std::size_t count);

    bool finished_ = false;
    std::string buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::nmea
