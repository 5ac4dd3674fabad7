// Cuts a byte stream into Ping frames, and skips and counts everything else. Never opens or waits for
// anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocols/ping/messages.h"
#include "protocols/wire/bytes.h"

namespace echoloop::ping {

inline constexpr std::size_t min_frame_bytes = 10;
/// The longest of all devices is an S500's chirp with 6000 results, 12076; other known hosts take 10250.
inline constexpr std::size_t max_frame_bytes = 12288;

/// A frame is accepted where "BR" stands, the length keeps within max_frame_bytes and the checksum is right.
/// Otherwise the search goes on at the byte behind this 'B', so no good frame is lost behind a bad length.
class Framer {
  public:
    enum class Waiting {
        patient,    ///< the rest of a frame is waited for
        impatient,  ///< a whole frame behind half a frame means that the half is damaged: what a device
                    ///< needs, whose host says nothing more until it is answered
    };
    explicit Framer(Waiting waiting = Waiting::patient) : waiting_(waiting) {}

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
    /// Position of the 'B' of the frame returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned frame.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }
    /// Forgets pending bytes without counting them, e.g. after a line break.
    void clear();

  private:
    /// Position of the next whole frame behind the one that is waited for, in pending bytes.
    std::optional<std::size_t> whole_frame_behind() const;
    Frame take(std::size_t size);
    void skip(std::size_t count);

    Waiting waiting_;
    bool finished_ = false;
    wire::Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::ping
