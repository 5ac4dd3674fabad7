// Puts a TCP stream of 7k packets, or the bytes of a file of records, together into records; skips and counts
// everything else. Never opens or waits for anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocols/reson7k/codec.h"

namespace echoloop::reson7k {

inline constexpr std::size_t host_record = 4096;  ///< the longest that a host sends

/// Where the bytes come from: records are in packets on the network; files have them bare.
enum class Source { network, network_or_file };

class Framer {
  public:
    /// `longest`: of the records that may come; what claims more is noise.
    explicit Framer(std::size_t longest = max_record, Source source = Source::network_or_file)
        : longest_(longest), bare_(source == Source::network_or_file) {}

    /// Appends received bytes. At most one longest record is kept waiting, and one call's bytes.
    void feed(wire::ByteView bytes);
    /// No more bytes will come: what waits for the rest of a record is searched for others, then skipped.
    void finish() { finished_ = true; }
    /// The next complete record, or nothing until more bytes come.
    std::optional<Record> next();

    /// Bytes that belonged to no record so far.
    std::uint64_t skipped_bytes() const { return skipped_; }
    /// Position of the first byte of the record returned last, in bytes since the start of the stream.
    std::uint64_t frame_offset() const { return frame_offset_; }
    /// Bytes of the stream that the record returned last took, with its network frames.
    std::uint64_t frame_size() const { return position_ - frame_offset_; }
    /// Bytes received that are neither skipped nor part of a returned record.
    std::size_t pending_bytes() const { return buffer_.size() - begin_; }

  private:
    /// How many of the pending bytes a record takes, and the record; 0: its end is not there yet.
    struct Found {
        std::size_t size = 0;
        std::optional<Record> record;
    };
    std::optional<Found> look(wire::ByteView pending) const;
    std::optional<Found> look_for_packets(wire::ByteView pending) const;
    bool is_beginning(wire::ByteView bytes) const;
    /// Where another record begins among pending bytes whose own record is not complete.
    std::optional<std::size_t> beginning_within(wire::ByteView pending) const;
    void skip(std::size_t count);

    std::size_t longest_;
    bool bare_;  ///< records without network frames too
    bool finished_ = false;
    wire::Bytes buffer_;
    std::size_t begin_ = 0;       ///< first byte of buffer_ that is still pending
    std::uint64_t position_ = 0;  ///< stream position of begin_
    std::uint64_t skipped_ = 0;
    std::uint64_t frame_offset_ = 0;
};

}  // namespace echoloop::reson7k
