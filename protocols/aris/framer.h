// Cuts the TCP stream of a controller into commands, and skips and counts everything else. Never waits for
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocols/aris/codec.h"

namespace echoloop::aris {

struct Frame {
    Command command;
    std::size_t size = 0;  ///< with its length
};

/// A command begins where a length stands that a command can have, and what follows is one. Where another one
/// stands whole within a command that is not, or not yet, there, bytes of the first were lost: it is skipped.
class Framer {
  public:
    /// Appends received bytes. At most one command of the longest kind is kept waiting, and one call's bytes.
    void feed(wire::ByteView bytes);
    /// No more bytes will come: what waits for the rest of a command is skipped.
    void finish() { finished_ = true; }
    /// The next complete command, or nothing until more bytes come.
    std::optional<Frame> next();

    /// Bytes that belonged to no command so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the command returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned command.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }
    /// Forgets pending bytes without counting them, e.g. when another controller connects.
    void clear();

  private:
    void skip(std::size_t count);

    bool finished_ = false;
    wire::Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::aris
