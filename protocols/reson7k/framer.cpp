#include "protocols/reson7k/framer.h"

#include <algorithm>

#include "protocols/reson7k/layouts.h"

namespace echoloop::reson7k {
namespace {

constexpr std::uint8_t first_byte = 5;   // of the protocol version, with which every frame begins
constexpr std::size_t searched = 65536;  // bytes: a damaged packet claims no more

/// Whether so few bytes may still become a frame.
bool may_begin(wire::ByteView bytes, bool bare) {
    constexpr std::uint8_t network[] = {5, 0, 36, 0}, record[] = {5, 0, 60, 0, 0xFF, 0xFF, 0, 0};
    const auto starts = [&](std::span<const std::uint8_t> word) {
        const std::size_t count = std::min(word.size(), bytes.size());
        return std::equal(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(count), bytes.begin());
    };
    const bool short_network = starts(network) && bytes.size() < network_frame_size + record_frame_size;
    return short_network || (bare && starts(record) && bytes.size() < record_frame_size);
}

}  // namespace

wire::FramerLimits RecordFinder::limits() const {
    return {.before = longest_ + (longest_ / searched + 2) * network_frame_size};
}

bool RecordFinder::is_beginning(wire::ByteView bytes) const {
    if (const auto network = plausible_network_frame(bytes, longest_)) {
        const auto record = plausible_record_frame(bytes.subspan(network_frame_size), longest_);
        return network->sequence == 0 && record && record->size == network->total_size;
    }
    return bare_ && plausible_record_frame(bytes, longest_);
}

std::size_t RecordFinder::beginning_within(wire::ByteView pending) const {
    const std::size_t end = std::min(pending.size(), searched);
    // The record within the first packet is no beginning of its own: its bytes go on in the next packets.
    const bool in_packets = plausible_network_frame(pending, longest_).has_value();
    for (std::size_t at = in_packets ? network_frame_size + 1 : 1; at < end; ++at)
        if (pending[at] == first_byte && is_beginning(pending.subspan(at))) return at;
    return 0;
}

/// Packets of one record follow each other on a stream.
std::optional<wire::Found<Record>> RecordFinder::look_for_packets(wire::ByteView pending) const {
    wire::Bytes bytes;
    std::size_t at = 0;
    const auto first = plausible_network_frame(pending, longest_);
    for (std::uint32_t n = 0; n < first->packets; ++n) {
        const auto rest = pending.subspan(at);
        const auto frame = plausible_network_frame(rest, longest_);
        if (rest.size() < network_frame_size) return Found{};
        const bool fits = frame && frame->sequence == n && frame->transmission == first->transmission &&
                          frame->packets == first->packets && frame->total_size == first->total_size;
        if (!fits) return std::nullopt;
        if (rest.size() < frame->packet_size) return Found{};
        const auto data = rest.first(frame->packet_size).subspan(network_frame_size);
        if (bytes.size() + data.size() > first->total_size) return std::nullopt;
        bytes.insert(bytes.end(), data.begin(), data.end());
        at += frame->packet_size;
    }
    auto record = read_record(bytes);
    if (!record) return std::nullopt;
    return Found{0, at, std::move(record)};
}

std::optional<wire::Found<Record>> RecordFinder::look(wire::ByteView pending) const {
    if (may_begin(pending, bare_)) return Found{};
    if (!is_beginning(pending)) return std::nullopt;
    if (plausible_network_frame(pending, longest_)) return look_for_packets(pending);
    const auto frame = plausible_record_frame(pending, longest_);
    if (pending.size() < frame->size) return Found{};
    auto record = read_record(pending.first(frame->size));
    if (!record) return std::nullopt;
    return Found{0, frame->size, std::move(record)};
}

wire::Found<Record> RecordFinder::find(wire::ByteView pending, bool finished) const {
    auto found = look(pending);
    if (found && found->frame) return *std::move(found);
    if (found) {
        const std::size_t other = beginning_within(pending);
        if (other > 0 || !finished) return {other};
    }
    return {wire::bytes_before(first_byte, pending)};
}

}  // namespace echoloop::reson7k
