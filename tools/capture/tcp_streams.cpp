#include "tools/capture/tcp_streams.h"

#include <algorithm>

namespace echoloop::capture {
namespace {

constexpr std::size_t most_streams = 1024, most_waiting = 1 << 20;
constexpr std::size_t each_piece = 100;  // bytes of memory beside its own

constexpr std::uint32_t half_of_all = 0x80000000;  // what lies farther ahead lies behind

/// How far `a` lies behind `b`; sequence numbers wrap.
std::int32_t behind(std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(a - b); }

}  // namespace

void TcpStreams::add(const TcpSegment& segment, const Each& each) {
    const Way way{segment.from, segment.to};
    if (!streams_.contains(way) && streams_.size() >= most_streams) streams_.erase(streams_.begin());
    Stream& stream = streams_[way];
    if (segment.begins || !stream.begun) {
        stream = {true, segment.sequence + (segment.begins ? 1 : 0), {}, 0};
        if (segment.begins) return;
    }
    if (segment.payload.empty()) return;
    const auto [place, is_new] = stream.early.try_emplace(segment.sequence);
    Bytes& kept = place->second;
    if (is_new) stream.waiting += each_piece;
    if (kept.size() < segment.payload.size()) {
        stream.waiting += segment.payload.size() - kept.size();
        kept = segment.payload;
    }
    give_out(way, stream, each, stream.waiting > most_waiting);
}

void TcpStreams::finish(const Each& each) {
    for (auto& [way, stream] : streams_) give_out(way, stream, each, true);
}

void TcpStreams::give_out(const Way& way, Stream& stream, const Each& each, bool over_gaps) {
    while (!stream.early.empty()) {
        auto nearest = stream.early.lower_bound(stream.next + half_of_all);
        if (nearest == stream.early.end()) nearest = stream.early.begin();
        const std::int32_t ahead = behind(nearest->first, stream.next);
        if (ahead > 0 && !over_gaps) return;
        const Bytes bytes = std::move(nearest->second);
        stream.waiting -= bytes.size() + each_piece;
        stream.early.erase(nearest);
        const std::size_t known =
            ahead > 0 ? 0
                      : std::min<std::size_t>(bytes.size(), static_cast<std::size_t>(-std::int64_t{ahead}));
        if (known == bytes.size()) continue;  // came twice
        stream.next += static_cast<std::uint32_t>(bytes.size() - known) +
                       (ahead > 0 ? static_cast<std::uint32_t>(ahead) : 0);
        each(way.first, way.second, ByteView(bytes).subspan(known), ahead > 0);
    }
}

}  // namespace echoloop::capture
