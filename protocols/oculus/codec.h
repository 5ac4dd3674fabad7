// Oculus messages to bytes and back, by the tables of the layouts. Knows no state, time or device.
#pragma once

#include <optional>
#include <string>

#include "protocols/oculus/messages.h"
#include "protocols/wire/result.h"

namespace echoloop::oculus {

inline constexpr std::size_t status_payload = 126;
inline constexpr std::size_t max_payload = 8U << 20;  ///< of an image; the longest known ones have 2 MB

/// The header at the start of `bytes`, if one that belongs to a known message of at most `longest` bytes of
/// payload stands there. Images are bounded by max_payload too.
std::optional<Header> plausible_header(wire::ByteView bytes, std::size_t longest = max_payload);

/// How many bytes follow a plausible header: as many as it says, but a fire message of 0 bytes has all of
/// them, since hosts on the maker's own client leave the size out.
std::size_t payload_bytes(const Header& header);

/// The message in a frame. Errors carry offsets from the header's first byte.
wire::Result<Message> parse(const Frame& frame);

/// All bytes of a message: header with id, version and size, and payload. `id` is for a Status, whose own is
/// not known.
wire::Bytes encode(const Message& message, std::uint16_t source = 0, std::uint16_t destination = 0,
                   Id id = Id::status);
/// A frame as it is, but for its size.
wire::Bytes encode(const Frame& frame);

/// "FireV2", or "message 0x99" for an id without a name.
std::string name_of(const Frame& frame);

/// The image in a result.
struct Image {
    std::size_t sample_bytes = 1;
    std::size_t row_bytes = 0;  ///< with the gain word
    bool gain_words = false;
    wire::ByteView bytes;  ///< ranges x row_bytes, of the result's tail
};
/// Nothing if offset, sizes, rows and columns contradict each other.
std::optional<Image> image_of(const ResultV1& result);
std::optional<Image> image_of(const ResultV2& result);

/// A whole result with room for its image, which is zeros from image_offset on: it is written once, into
/// place. Fills in offset and sizes; `result.tail` is left alone. ranges, beams (by bearings), data size,
/// flags count.
wire::Bytes encode_around_image(ResultV1& result, std::uint16_t source);
wire::Bytes encode_around_image(ResultV2& result, std::uint16_t source);

/// Bearings of `beams` beams over `aperture` rad, rad, in equal steps of sine; at least 2 beams.
std::vector<double> bearings(std::size_t beams, double aperture);
/// In 0.01 deg, cut toward zero.
std::int16_t wire_bearing(double radians);

}  // namespace echoloop::oculus
