// Packets of a Norbit WBMS to bytes and back, by the tables of the layouts. Knows no state, time or device.
#pragma once

#include <optional>
#include <string>

#include "protocols/norbit/messages.h"
#include "protocols/wire/result.h"

namespace echoloop::norbit {

inline constexpr std::size_t water_column_head = 192;  ///< B before an image, with the header
inline constexpr std::size_t max_payload = 1U << 20;   ///< B behind the header
inline constexpr std::size_t max_packet = 24 + max_payload;

/// The header at the start of `bytes`, if one of a known type and possible size stands there.
std::optional<Header> plausible_header(wire::ByteView bytes);

/// False if a packet that carries a checksum has a wrong one.
bool has_right_crc(const Header& header, wire::ByteView payload);

/// The message in a frame. Errors carry offsets from the header's first byte.
wire::Result<Message> parse(const Frame& frame);

/// All bytes of a packet, with size and checksum. `type` is for snippets and side scan, which are
/// WaterColumns.
wire::Bytes encode(const Message& message, std::uint32_t version = 4, std::optional<Type> type = {});
/// A packet with room for samples x beams of its type and the angles, all zero: they are written once, into
/// place, from water_column_head on; then close() it. `message.tail` is left alone.
wire::Bytes open(const WaterColumn& message, std::uint32_t version);
/// Fills in the checksum.
void close(wire::Bytes& packet);

/// "WaterColumn", or "type 9" of one without a name.
std::string name_of(const Header& header);

/// Bytes of a sample; 0 for a type that is not known.
std::size_t bytes_of(Sample sample);

struct Image {
    std::size_t sample_bytes = 0;
    wire::ByteView samples;  ///< samples x beams, rows of all beams
    wire::ByteView angles;   ///< an f32 a beam
};
/// Nothing if the tail is shorter than rows, columns and type ask for.
std::optional<Image> image_of(const WaterColumn& message);

}  // namespace echoloop::norbit
