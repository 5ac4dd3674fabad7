#include "protocols/mavlink/framer.h"

#include "protocols/mavlink/codec.h"

namespace echoloop::mavlink {
namespace {

using wire::ByteView;

constexpr std::uint8_t start1 = 0xFE, start2 = 0xFD, signed_frame = 0x01;
constexpr std::size_t header1 = 6, header2 = 10, checksum_bytes = 2, signature_bytes = 13;

/// Bytes of the frame that begins here; 0 if none can, nothing if its header is not complete.
std::optional<std::size_t> frame_bytes(ByteView bytes) {
    if (bytes[0] != start1 && bytes[0] != start2) return 0;
    if (bytes.size() < header1 || (bytes[0] == start2 && bytes.size() < header2)) return {};
    if (bytes[0] == start1) return header1 + bytes[1] + checksum_bytes;
    if ((bytes[2] & ~signed_frame) != 0) return 0;  // a flag that must be understood, and is not
    return header2 + bytes[1] + checksum_bytes + ((bytes[2] & signed_frame) != 0 ? signature_bytes : 0);
}

/// `bytes` has a whole header.
std::uint32_t id_of(ByteView bytes) {
    if (bytes[0] == start1) return bytes[5];
    return static_cast<std::uint32_t>(bytes[7] | bytes[8] << 8 | bytes[9] << 16);
}

/// The frame that begins here, if it is whole, known and undamaged.
std::optional<Frame> known_frame(ByteView bytes) {
    const auto size = frame_bytes(bytes);
    if (!size || *size == 0 || *size > bytes.size()) return {};
    const bool first = bytes[0] == start1;
    const std::size_t header = first ? header1 : header2, length = bytes[1];
    const auto seed = checksum_seed(id_of(bytes));
    if (!seed) return {};
    const auto told = static_cast<std::uint16_t>(bytes[header + length] | bytes[header + length + 1] << 8);
    if (checksum(bytes.subspan(1, header - 1 + length), *seed) != told) return {};
    const std::size_t at = first ? 2 : 4;  // of the sequence number
    const auto payload = bytes.subspan(header, length);
    return Frame{
        static_cast<std::uint8_t>(first ? 1 : 2), bytes[at], bytes[at + 1], bytes[at + 2], id_of(bytes),
        {payload.begin(), payload.end()}};
}

/// Whether what begins here, whole, is a message that this folder does not know: another begins behind it, or
/// nothing does yet.
bool is_other(ByteView bytes, std::size_t size) {
    if (checksum_seed(id_of(bytes))) return false;
    return size == bytes.size() || bytes[size] == start1 || bytes[size] == start2;
}

/// Where a known frame begins behind the first byte; 0 if none does.
std::size_t known_frame_behind(ByteView bytes) {
    for (std::size_t at = 1; at < bytes.size(); ++at)
        if (known_frame(bytes.subspan(at))) return at;
    return 0;
}

}  // namespace

wire::Found<Frame> FrameFinder::find(ByteView pending, bool finished) const {
    const auto size = frame_bytes(pending);
    if (!size || *size > pending.size()) return {finished ? 1 : known_frame_behind(pending)};
    if (*size == 0) return {1};
    if (auto frame = known_frame(pending)) return {0, *size, std::move(frame)};
    if (is_other(pending, *size)) return {0, *size};
    return {1};
}

}  // namespace echoloop::mavlink
