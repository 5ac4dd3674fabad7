#include "protocols/aris/frames.h"

#include "protocols/aris/codec.h"

namespace echoloop::aris {
namespace {

constexpr std::size_t most_frame_bytes = std::size_t{4} << 20;

/// Samples in the sonar's order come ping by ping, each range by range, 16 channels at a time.
wire::Bytes range_after_range(wire::ByteView samples, const PingMode& mode) {
    wire::Bytes image(samples.size());
    const std::size_t ranges = samples.size() / mode.beams;
    std::size_t at = 0;
    for (std::size_t ping = 0; ping < mode.pings; ++ping)
        for (std::size_t range = 0; range < ranges; ++range)
            for (const std::size_t channel : channel_map)
                image[range * mode.beams + ping + channel * mode.pings] = samples[at++];
    return image;
}

}  // namespace

std::optional<WholeFrame> FrameJoiner::add(const FramePart& part) {
    if (part.data_offset == 0) {
        drop();
        const auto header = parse_frame_header(part.header);
        const auto* mode = header ? find_ping_mode(header->ping_mode) : nullptr;
        if (mode == nullptr || header->samples == 0 || part.total_data_size > most_frame_bytes ||
            part.total_data_size != mode->beams * std::size_t{header->samples})
            return std::nullopt;
        header_ = *header;
        number_ = part.frame_index;
    } else if (part.frame_index != number_ || part.data_offset != data_.size() || data_.empty()) {
        drop();
        return std::nullopt;
    }
    data_.insert(data_.end(), part.data.begin(), part.data.end());
    if (data_.size() < part.total_data_size) return std::nullopt;
    std::optional<WholeFrame> whole;
    if (data_.size() == part.total_data_size)
        whole = WholeFrame{header_, header_.reordered != 0
                                        ? data_
                                        : range_after_range(data_, *find_ping_mode(header_.ping_mode))};
    data_.clear();
    return whole;
}

void FrameJoiner::drop() {
    lost_ += data_.empty() ? 0 : 1;
    data_.clear();
}

}  // namespace echoloop::aris
