// Cuts a byte stream into MAVLink frames of versions 1 and 2, and skips and counts everything else. Never
// opens or waits for anything.
#pragma once

#include <optional>

#include "protocols/mavlink/messages.h"
#include "protocols/wire/bytes.h"

namespace echoloop::mavlink {

/// Messages that this folder knows are taken if their checksum is right, also from behind what looks like the
/// beginning of another one. Of others the seed of the checksum is not known: they are passed over by their
/// length.
class Framer {
  public:
    void feed(wire::ByteView bytes);
    /// The next complete frame of a message that this folder knows.
    std::optional<Frame> next();
    std::uint64_t skipped_bytes() const { return skipped_; }  ///< noise, not messages of other kinds
    void clear() { buffer_.clear(); }

  private:
    std::optional<std::size_t> whole_frame_behind() const;
    void drop(std::size_t count);

    wire::Bytes buffer_;
    std::uint64_t skipped_ = 0;
};

}  // namespace echoloop::mavlink
