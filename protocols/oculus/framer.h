// Cuts a TCP stream into Oculus messages, and skips and counts everything else. Never opens or waits for
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocols/oculus/codec.h"

namespace echoloop::oculus {

inline constexpr std::size_t host_payload = 73;  ///< the longest that a host sends: FireV2

/// Messages carry no checksum: one begins where a plausible header stands (known id, its version and size).
/// Where another one stands within a message without an image, bytes of the first were lost: it is skipped.
class Framer {
  public:
    /// `longest`: of the payloads that may come; what claims more is noise.
    explicit Framer(std::size_t longest = max_payload) : longest_(longest) {}

    /// Appends received bytes. At most one message of the longest kind is kept waiting, and one call's bytes.
    void feed(wire::ByteView bytes);
    /// No more bytes will come: what waits for the rest of a message is searched for others, then skipped.
    void finish() { finished_ = true; }
    /// The next complete message, or nothing until more bytes come.
    std::optional<Frame> next();

    /// Bytes that belonged to no message so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the header of the message returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned message.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }
    /// Forgets pending bytes without counting them, e.g. when another host connects.
    void clear();

  private:
    Frame take(const Header& header);
    void skip(std::size_t count);
    /// To the next byte where a header may begin.
    void skip_noise();

    std::size_t longest_;
    bool finished_ = false;
    wire::Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::oculus
