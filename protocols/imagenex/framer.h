// Cuts a byte stream into Imagenex commands, replies and shots of files, and skips and counts everything
// else. Never opens or waits for anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocols/wire/bytes.h"

namespace echoloop::imagenex {

/// There is no checksum: a command is 27 bytes from FE 44 to the first FD; a reply is told by its name, a
/// legal count and FC at its end. The search goes on at the byte behind the start of what was none.
class Framer {
  public:
    enum class Takes {
        everything,  ///< both directions of a line, and the shots of .81A and .852 files
        commands     ///< what a head listens for; nothing else on the line can hold it up
    };
    explicit Framer(Takes takes = Takes::everything) : takes_(takes) {}

    /// Appends received bytes. Beyond 128 KiB that next() has not taken, the oldest are dropped and counted
    /// as skipped.
    void feed(wire::ByteView bytes);
    /// No more bytes will come: what waits for the rest of a frame is searched for others, then skipped.
    void finish() { finished_ = true; }
    /// The next complete frame, or nothing until more bytes come.
    std::optional<wire::Bytes> next();

    /// Bytes that belonged to no frame so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the first byte of the frame returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned frame.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }
    /// Forgets pending bytes without counting them.
    void clear();

  private:
    std::optional<std::size_t> frame_bytes(wire::ByteView bytes) const;
    wire::Bytes take(std::size_t size);
    void skip(std::size_t count);

    Takes takes_;
    bool finished_ = false;
    wire::Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::imagenex
