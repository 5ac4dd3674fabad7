// Puts a TCP stream of 7k packets, or the bytes of a file of records, together into records; skips and counts
// everything else.
#pragma once

#include "protocols/reson7k/codec.h"
#include "protocols/wire/framer.h"

namespace echoloop::reson7k {

inline constexpr std::size_t host_record = 4096;  ///< the longest that a host sends

/// Where the bytes come from: records are in packets on the network; files have them bare.
enum class Source { network, network_or_file };

class RecordFinder {
  public:
    /// `longest`: of the records that may come; what claims more is noise.
    explicit RecordFinder(std::size_t longest = max_record, Source source = Source::network_or_file)
        : longest_(longest), bare_(source == Source::network_or_file) {}

    wire::Found<Record> find(wire::ByteView pending, bool finished) const;
    wire::FramerLimits limits() const;

  private:
    using Found = wire::Found<Record>;
    /// Nothing: no record begins here. Without a record: its end is not there yet.
    std::optional<Found> look(wire::ByteView pending) const;
    std::optional<Found> look_for_packets(wire::ByteView pending) const;
    bool is_beginning(wire::ByteView bytes) const;
    /// Where another record begins among pending bytes whose own record is not complete; 0 if none does.
    std::size_t beginning_within(wire::ByteView pending) const;

    std::size_t longest_;
    bool bare_;  ///< records without network frames too
};

using Framer = wire::Framer<Record, RecordFinder>;

}  // namespace echoloop::reson7k
