#include <algorithm>
#include <ctime>

#include "tools/capture/little_endian.h"
#include "tools/capture/makers_files.h"
#include "tools/capture/xtf_sides.h"

namespace echoloop::capture {
namespace {

constexpr std::uint8_t xtf_mark = 0x7B;
constexpr std::size_t xtf_header = 1024, channels_in_header = 6;
constexpr std::uint16_t xtf_packet_mark = 0xFACE;
constexpr std::size_t xtf_packet_header = 14, xtf_unit = 64;
constexpr std::uint8_t side_scan = 0;
constexpr std::size_t longest_xtf_packet = std::size_t{16} << 20;

bool is_xtf_packet(ByteView bytes) {
    if (bytes.size() < xtf_packet_header || little::u16(bytes, 0) != xtf_packet_mark) return false;
    const std::size_t size = little::u32(bytes, 10);
    return size >= xtf_unit && size <= longest_xtf_packet && size % xtf_unit == 0;
}

/// Bathymetry and snippets of QINSy (65, 66) and of Triton (68, 69), as the sounder sent them.
bool is_r2sonic(std::uint8_t type) { return type == 65 || type == 66 || type == 68 || type == 69; }

/// s since 1970 of a ping header, 0.01 s apart.
double ping_time(ByteView packet) {
    std::tm at{};
    at.tm_year = little::u16(packet, 14) - 1900;
    at.tm_mon = packet[16] - 1;
    at.tm_mday = packet[17];
    at.tm_hour = packet[18];
    at.tm_min = packet[19];
    at.tm_sec = packet[20];
    return static_cast<double>(::timegm(&at)) + packet[21] * 0.01;
}

/// The datagram behind a ping header: big-endian, its own length in it; zeros fill the packet.
ByteView datagram_in(ByteView packet) {
    const ByteView rest = packet.subspan(xtf_ping_header);
    constexpr std::size_t start = 12;
    if (rest.size() < start) return {};
    const std::size_t size = wire::load<wire::ByteOrder::big, std::uint32_t>(rest.data() + 4);
    return size >= start && size <= rest.size() ? rest.first(size) : rest;
}

class XtfFile final : public Container {
  public:
    explicit XtfFile(const XtfSides& sides) : sides_(sides) {}

    Entry look(ByteView pending, bool last) override {
        if (pending.size() < xtf_packet_header && !last) return {};
        const std::size_t size = is_xtf_packet(pending) ? little::u32(pending, 10) : 0;
        if (size > pending.size() && !last) return {};
        if (size == 0 || size > pending.size())
            return {.size = distance_to_next(pending, last, xtf_packet_header, is_xtf_packet),
                    .damaged = true};
        const auto lost = lost_bytes_before(pending, size, last, xtf_packet_header, is_xtf_packet);
        if (!lost) return {};
        if (*lost > 0) return {.size = *lost, .damaged = true};
        Entry entry{.size = size};
        ++packets_;
        if (size < xtf_ping_header) return entry;
        const ByteView packet = pending.first(size);
        if (sides_.any()) {
            entry.time = ping_time(packet);
            if (pending[2] == side_scan) entry.said = sides_.messages(packet, entry.time);
            return entry;
        }
        if (!is_r2sonic(pending[2])) return entry;
        const ByteView datagram = datagram_in(packet);
        entry.time = ping_time(packet);
        if (!datagram.empty()) entry.said.emplace_back(datagram.begin(), datagram.end());
        return entry;
    }

    std::string others() const override {
        if (packets_ == 0) return {};
        return "of XTF, side-scans (type 0) and the datagrams of R2Sonic sounders (types 65, 66, 68, 69) are "
               "read, and none of its " +
               std::to_string(packets_) + " packets is one";
    }

  private:
    XtfSides sides_;
    std::uint64_t packets_ = 0;
};

}  // namespace

std::unique_ptr<CaptureReader> open_xtf(Input& input, const OpenSettings&) {
    const Bytes start = input.peek(xtf_header + xtf_packet_header);
    if (start.size() < xtf_header + xtf_packet_header || start[0] != xtf_mark) return nullptr;
    // More channels than fit are told of in further headers.
    const std::size_t channels = little::u16(start, 166) + std::size_t{little::u16(start, 168)};
    const std::size_t headers =
        channels <= channels_in_header ? 1 : 1 + (channels - channels_in_header + 7) / 8;
    if (headers == 1 && little::u16(start, xtf_header) != xtf_packet_mark) return nullptr;
    const std::size_t begin = input.read(headers * xtf_header).size();
    const XtfSides sides(start);
    using Speech = ContainerFile::Speech;
    return std::make_unique<ContainerFile>(input, std::make_unique<XtfFile>(sides),
                                           sides.any() ? "edgetech" : "r2sonic",
                                           sides.any() ? Speech::stream : Speech::datagrams, begin);
}

}  // namespace echoloop::capture
