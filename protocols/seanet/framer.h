// Cuts a SeaNet byte stream into frames, and skips and counts everything else. Never opens or waits for
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocols/seanet/messages.h"
#include "protocols/wire/bytes.h"

namespace echoloop::seanet {

inline constexpr std::size_t min_frame_bytes = 14;
inline constexpr std::size_t max_frame_bytes = 4096;

/// A frame is accepted where both length forms agree, lie within 14..4096 bytes in all, and LF stands where
/// they say. Otherwise the search goes on at the byte behind this '@', so no good frame is lost behind a bad
/// length.
class Framer {
  public:
    enum class Lengths {
        trusted,  ///< the length decides
        by_id,    ///< commands without payload are also taken at their known 14 bytes, whatever length they
                  ///< claim
    };
    explicit Framer(Lengths lengths = Lengths::trusted) : lengths_(lengths) {}

    /// Appends received bytes. Beyond 64 KiB that next() has not taken, the oldest are dropped and counted as
    /// skipped.
    void feed(wire::ByteView bytes);
    /// No more bytes will come: what waits for the rest of a frame is searched for other frames, then
    /// skipped.
    void finish() { finished_ = true; }
    /// The next complete frame, or nothing until more bytes come.
    std::optional<Frame> next();

    /// Bytes that belonged to no frame so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the '@' of the frame returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned frame.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }
    /// Forgets pending bytes without counting them, e.g. when a driver reopens the port.
    void clear();

  private:
    /// What the '@' at begin_ turned out to be: a frame of so many bytes, nothing, or not to be told yet.
    struct Step {
        std::optional<Frame> frame{};
        std::size_t bytes = 0;
        bool wait = false;
    };
    Step at_begin() const;
    void skip(std::size_t count);

    Lengths lengths_;
    bool finished_ = false;
    wire::Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::seanet
