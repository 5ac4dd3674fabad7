// The lines of a Tritech altimeter as text and as values, and their framer. Never opens or waits for
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocols/wire/bytes.h"

namespace echoloop::altimeter {

enum class Format {
    three_decimals,  ///< "xxx.xxxm" CR LF
    two_decimals,    ///< "xxx.xxm" CR LF
    millimetres,     ///< "dmm" LF
};

struct Reading {
    Format format = Format::three_decimals;
    double metres = 0;  ///< 0 to 999.99
};

/// With its line end; metres beyond what the format has room for are cut.
std::string write_line(const Reading& reading);
/// A whole line with its end and nothing before it; nothing if it is none.
std::optional<Reading> read_line(std::string_view line);

/// A line where it stands in a stream.
struct Line {
    Reading reading;
    std::size_t size = 0;  ///< bytes, with the line's end
};

/// What stands before a line end is a line as far as it reads as one; everything before it is skipped.
class Framer {
  public:
    void feed(wire::ByteView bytes);
    /// No more bytes will come: what has no line end is skipped.
    void finish() { finished_ = true; }
    std::optional<Line> next();

    /// Bytes that belonged to no line so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the first digit of the line returned last, in bytes since the start of the stream.
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

}  // namespace echoloop::altimeter
