#include "protocols/checksums.h"

#include "protocols/nmea/framer.h"
#include "protocols/norbit/codec.h"
#include "protocols/ping/framer.h"
#include "protocols/reson7k/codec.h"
#include "protocols/sonar3d/codec.h"

namespace echoloop {
namespace {

using wire::ByteView;
using Places = std::vector<ChecksumPlace>;

Places of_ping(ByteView bytes) {
    constexpr std::size_t sum_bytes = 2;
    ping::Framer framer;
    framer.feed(bytes);
    Places places;
    while (const auto frame = framer.next()) {
        const std::size_t size = ping::min_frame_bytes + frame->payload.size();
        places.push_back({framer.frame_offset() + size - sum_bytes, sum_bytes});
    }
    return places;
}

Places of_nmea(ByteView bytes) {
    nmea::Framer framer;
    framer.feed(bytes);
    Places places;
    while (const auto line = framer.next()) {
        const std::size_t star = line->text.find('*');
        if (star != std::string::npos && star + 3 == line->text.size())
            places.push_back({framer.frame_offset() + star + 1, 2, true});
    }
    return places;
}

Places of_sonar3d(ByteView bytes) {
    constexpr std::size_t crc_bytes = 4;
    if (!sonar3d::is_packet(bytes)) return {};
    return {{bytes.size() - crc_bytes, crc_bytes}};
}

/// A long record is several packets; the last one holds its sum, which is 0 if there is none.
Places of_reson7k(ByteView bytes) {
    Places places;
    std::size_t at = 0;
    while (const auto frame = reson7k::plausible_network_frame(bytes.subspan(at))) {
        if (frame->packet_size > bytes.size() - at) break;
        at += frame->packet_size;
        if (frame->sequence + 1 != frame->packets) continue;
        const std::size_t sum = at - reson7k::checksum_size;
        if (wire::load<wire::ByteOrder::little, std::uint32_t>(bytes.data() + sum) != 0)
            places.push_back({sum, reson7k::checksum_size});
    }
    return places;
}

Places of_norbit(ByteView bytes) {
    constexpr std::size_t crc_at = 20, crc_bytes = 4, header_bytes = 24;
    Places places;
    std::size_t at = 0;
    while (const auto header = norbit::plausible_header(bytes.subspan(at))) {
        if (header->size > bytes.size() - at || header->size < header_bytes) break;
        const bool has_one =
            header->type == norbit::Type::bathymetry || header->type == norbit::Type::water_column;
        if (has_one) places.push_back({at + crc_at, crc_bytes});
        at += header->size;
    }
    return places;
}

struct Row {
    std::string_view family;
    FindChecksums find;
};
constexpr Row rows[] = {{"ping", of_ping},       {"cerulean", of_ping},   {"nmea", of_nmea},
                        {"sonar3d", of_sonar3d}, {"reson7k", of_reson7k}, {"norbit", of_norbit}};

}  // namespace

FindChecksums find_checksums(std::string_view family) {
    for (const Row& row : rows)
        if (row.family == family) return row.find;
    return nullptr;
}

}  // namespace echoloop
