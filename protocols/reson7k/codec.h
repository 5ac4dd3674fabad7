// 7k records to bytes and back, by the tables of the layouts, and cut into packets. Knows no state, time or
// device.
#pragma once

#include <optional>
#include <string>

#include "protocols/reson7k/messages.h"
#include "protocols/wire/result.h"

namespace echoloop::reson7k {

inline constexpr std::size_t network_frame_size = 36, record_frame_size = 64, checksum_size = 4;
inline constexpr std::size_t max_packet = 60000;      ///< with its network frame
inline constexpr std::size_t max_record = 64U << 20;  ///< of what is read
inline constexpr std::size_t least_record = record_frame_size + checksum_size;

/// The frame at the start of `bytes` if it can be one of a packet whose record has at most `longest` bytes.
std::optional<NetworkFrame> plausible_network_frame(wire::ByteView bytes, std::size_t longest = max_record);
/// The frame at the start of `bytes` if it can be one of a record of at most `longest` bytes.
std::optional<RecordFrame> plausible_record_frame(wire::ByteView bytes, std::size_t longest = max_record);

/// The record that all these bytes are: frame, content, checksum. Nothing if sizes or checksum contradict.
std::optional<Record> read_record(wire::ByteView bytes);
/// The message in a record. Errors carry offsets from the first byte behind the record frame.
wire::Result<Message> parse(const Record& record);

/// A whole record: `frame` with type, size and checksum filled in.
wire::Bytes encode(const Message& message, RecordFrame frame);
/// A record as it is, but for size and checksum.
wire::Bytes encode(const Record& record);
/// Sets size and checksum of a whole record whose content was written in place.
void seal(wire::Bytes& record);

/// A whole record in packets for the network, each at most `most` bytes. `source`: of the sender.
std::vector<wire::Bytes> packets_of(wire::ByteView record, std::uint16_t transmission, std::uint32_t source,
                                    std::size_t most = max_packet);

/// `unix_time` in s.
Time7k to_time(double unix_time);
/// "RawDetections", or "record 7610" for a type without a table.
std::string name_of(std::uint32_t type);

}  // namespace echoloop::reson7k
