// Cuts a row of Range Image Protocol packets (a .sonar file, datagrams one behind the other) into packets,
// and skips and counts everything else. Never opens or waits for anything.
#pragma once

#include "protocols/sonar3d/codec.h"

namespace echoloop::sonar3d {

/// A packet is bytes whose id, length and checksum are right.
class Framer {
  public:
    /// Appends received bytes; all that next() leaves is at most one unfinished packet.
    void feed(wire::ByteView bytes);
    /// No more bytes will come: what waits for the rest of a packet is searched for others, then skipped.
    void finish() { finished_ = true; }
    /// The next complete packet, or nothing until more bytes come.
    std::optional<wire::Bytes> next();

    /// Bytes that belonged to no packet so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the packet returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned packet.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }

  private:
    wire::Bytes take(std::size_t size);
    /// To the next byte where a packet may begin.
    void skip_noise();

    bool finished_ = false;
    wire::Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::sonar3d
