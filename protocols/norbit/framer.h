// Cuts a TCP stream into packets of a Norbit WBMS, and skips and counts everything else. Never opens or waits
// for anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocols/norbit/codec.h"

namespace echoloop::norbit {

/// A packet begins where a plausible header stands and ends with its size; types 1 and 2 need their checksum.
class Framer {
  public:
    /// Appends received bytes. At most one packet of the longest kind is kept waiting, and one call's bytes.
    void feed(wire::ByteView bytes);
    /// No more bytes will come: what waits for the rest of a packet is searched for others, then skipped.
    void finish() { finished_ = true; }
    /// The next complete packet, or nothing until more bytes come.
    std::optional<Frame> next();

    /// Bytes that belonged to no packet so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the header of the packet returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned packet.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }

  private:
    void skip(std::size_t count);
    /// To the next byte where a header may begin.
    void skip_noise();

    bool finished_ = false;
    wire::Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::norbit
