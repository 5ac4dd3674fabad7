#include "protocols/nortek/codec.h"

#include <algorithm>

#include "protocols/nortek/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::nortek {
namespace {

constexpr std::uint8_t mark = 0xA5;
constexpr std::size_t summed_header = 8;  // bytes of it that its own sum is of
using Found = wire::Found<Piece>;

template <class M>
wire::Result<Frame> frame_of(const Header& header, wire::ByteView data) {
    auto body = wire::parse<M>(data);
    if (!body) return body.error();
    return Frame{header.id, header.family, *std::move(body)};
}

/// Of another version or size than the table's, data are kept as they are.
template <class M>
bool fits(wire::ByteView data, std::uint8_t version) {
    return data.size() == *wire::fixed_size<M>() && data[0] == version;
}

std::optional<Header> read_header(wire::ByteView bytes) {
    if (bytes.size() < header_size) return std::nullopt;
    const auto header = wire::parse<Header>(bytes.first(header_size));
    if (!header || header->checksum != checksum(bytes.first(summed_header))) return std::nullopt;
    return *header;
}

bool may_stand_in_line(std::uint8_t c) { return c >= ' ' && c <= '~'; }

Found find_frame(wire::ByteView pending, bool finished) {
    if (pending.size() > 1 && pending[1] != header_size) return {1};
    if (pending.size() < header_size) return finished ? Found{1} : Found{};
    const auto header = read_header(pending);
    if (!header) return {1};
    const std::size_t size = header_size + header->size;
    if (pending.size() < size) return finished ? Found{1} : Found{};
    const auto bytes = pending.first(size);
    if (checksum(bytes.subspan(header_size)) != header->data_checksum) return {1};
    return {0, size, Piece{Piece::Kind::frame, {bytes.begin(), bytes.end()}, ""}};
}

Found skip_noise(wire::ByteView pending) {
    const auto at = std::find_if(pending.begin() + 1, pending.end(),
                                 [](std::uint8_t c) { return c == mark || may_stand_in_line(c); });
    return {static_cast<std::size_t>(at - pending.begin())};
}

Found find_text(wire::ByteView pending, bool finished) {
    const auto end = std::find_if_not(pending.begin(), pending.end(), may_stand_in_line);
    const auto size = static_cast<std::size_t>(end - pending.begin());
    if (size > longest_line) return {size};
    if (size == pending.size()) return finished ? Found{size} : Found{};
    if (*end != '\r' && *end != '\n') return {size};
    const bool two = *end == '\r' && size + 1 < pending.size() && pending[size + 1] == '\n';
    const std::string line_end = two ? "\r\n" : std::string(1, static_cast<char>(*end));
    return {0, size + line_end.size(), Piece{Piece::Kind::line, {pending.begin(), end}, line_end}};
}

}  // namespace

std::uint16_t checksum(wire::ByteView bytes) {
    std::uint32_t sum = 0xB58C;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) sum += bytes[i] + 256U * bytes[i + 1];
    if (bytes.size() % 2 != 0) sum += 256U * bytes.back();
    return static_cast<std::uint16_t>(sum);
}

wire::Bytes encode(const Frame& frame) {
    const wire::Bytes data = std::visit([](const auto& d) { return wire::serialise(d); }, frame.data);
    Header header{frame.id, frame.family, static_cast<std::uint16_t>(data.size()), checksum(data), 0};
    header.checksum = checksum(wire::ByteView(wire::serialise(header)).first(summed_header));
    wire::Bytes bytes = wire::serialise(header);
    bytes.insert(bytes.end(), data.begin(), data.end());
    return bytes;
}

wire::Result<Frame> parse(wire::ByteView bytes) {
    const auto header = read_header(bytes);
    if (!header) return wire::Error{"Header", "checksum", summed_header, wire::Reason::wrong_constant};
    const auto data = bytes.subspan(header_size);
    if (data.size() != header->size) return wire::Error{"Header", "size", 4, wire::Reason::wrong_constant};
    if (checksum(data) != header->data_checksum)
        return wire::Error{"Header", "data_checksum", 6, wire::Reason::wrong_constant};
    if (header->family == nucleus_family && !data.empty()) {
        const bool track = header->id == bottom_track_id || header->id == water_track_id;
        if (track && fits<Track>(data, 1)) return frame_of<Track>(*header, data);
        if (header->id == altimeter_id && fits<Altimeter>(data, 1)) return frame_of<Altimeter>(*header, data);
        if (header->id == ahrs_id && fits<Ahrs>(data, 2)) return frame_of<Ahrs>(*header, data);
        if (header->id == imu_id && fits<Imu>(data, 1)) return frame_of<Imu>(*header, data);
    }
    if (header->family == dvl_family && !data.empty()) {
        const bool track = header->id == dvl_bottom_track_id || header->id == dvl_water_track_id;
        if (track && fits<DvlTrack>(data, 1)) return frame_of<DvlTrack>(*header, data);
    }
    return frame_of<Other>(*header, data);
}

wire::Found<Piece> PieceFinder::find(wire::ByteView pending, bool finished) const {
    const std::uint8_t first = pending.front();
    if (first == '\r' || first == '\n') return {0, 1};
    if (first == mark) return find_frame(pending, finished);
    return may_stand_in_line(first) ? find_text(pending, finished) : skip_noise(pending);
}

}  // namespace echoloop::nortek
