// .aris: a header, then frames put together from their parts, each with its header and its samples range
// after range.
#include <algorithm>

#include "protocols/aris/beams.h"
#include "protocols/aris/codec.h"
#include "protocols/wire/write.h"
#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {
namespace {

constexpr std::size_t header_on_disk = 1024, most_frame_bytes = std::size_t{4} << 20;

/// Samples in the sonar's order come ping by ping, each range by range, 16 channels at a time.
Bytes range_after_range(ByteView samples, const aris::PingMode& mode) {
    Bytes image(samples.size());
    const std::size_t ranges = samples.size() / mode.beams;
    std::size_t at = 0;
    for (std::size_t ping = 0; ping < mode.pings; ++ping)
        for (std::size_t range = 0; range < ranges; ++range)
            for (const std::size_t channel : aris::channel_map)
                image[range * mode.beams + ping + channel * mode.pings] = samples[at++];
    return image;
}

class Aris final : public Recording {
  public:
    void look(const Heard& heard) override {
        for_frame(heard, [this](const aris::FrameHeader& header, ByteView samples) {
            if (frames_++ == 0) first_ = header;
            bytes_ += header_on_disk + samples.size();
        });
    }

    void begin(std::ostream& out) override {
        reset();
        Bytes header(header_on_disk);
        const auto set = [&header](std::size_t at, auto value) {
            wire::store<wire::ByteOrder::little>(value, header.data() + at);
        };
        const auto* mode = aris::find_ping_mode(first_.ping_mode);
        set(0, aris::header_version);
        set(4, frames_);
        set(8, static_cast<std::uint32_t>(first_.frame_rate));
        set(12, first_.frequency);
        set(16, static_cast<std::uint32_t>(mode != nullptr ? mode->beams : 0));
        set(20, first_.sample_rate);
        set(24, first_.samples);
        set(28, first_.gain);
        set(32, first_.window_start);
        set(36, first_.window_length);
        set(44, first_.serial);
        set(356, frames_ == 0 ? 0 : frames_ - 1);
        set(424, static_cast<std::uint64_t>(header_on_disk + bytes_));
        set(452, first_.large_lens);
        put(out, header);
    }

    void add(const Heard& heard, std::ostream& out) override {
        for_frame(heard, [&](aris::FrameHeader header, ByteView samples) {
            const aris::PingMode& mode = *aris::find_ping_mode(header.ping_mode);
            const bool in_order = header.reordered != 0;
            header.index = static_cast<std::uint32_t>(count_);
            header.reordered = 1;
            Bytes bytes = aris::encode(header);
            bytes.resize(header_on_disk);
            put(out, bytes);
            put(out, in_order ? Bytes(samples.begin(), samples.end()) : range_after_range(samples, mode));
            ++count_;
        });
    }

    void end(std::ostream&) override { drop(); }

  private:
    /// Calls `each` with a frame that this part completes.
    template <class Each>
    void for_frame(const Heard& heard, Each each) {
        const auto part = aris::parse_frame_part(heard.bytes);
        if (heard.name != "FramePart" || !part) return;
        if (part->data_offset == 0) {
            drop();
            const auto header = aris::parse_frame_header(part->header);
            const auto* mode = header ? aris::find_ping_mode(header->ping_mode) : nullptr;
            if (mode == nullptr || part->total_data_size > most_frame_bytes ||
                part->total_data_size != mode->beams * std::size_t{header->samples})
                return;
            header_ = *header;
            number_ = part->frame_index;
        } else if (part->frame_index != number_ || part->data_offset != data_.size() || data_.empty()) {
            return drop();
        }
        data_.insert(data_.end(), part->data.begin(), part->data.end());
        if (data_.size() < part->total_data_size) return;
        if (data_.size() == part->total_data_size) each(header_, data_);
        data_.clear();
    }

    void drop() {
        lost_ += data_.empty() ? 0 : 1;
        data_.clear();
    }

    /// Between the two readings.
    void reset() {
        data_.clear();
        lost_ = 0;
    }

    aris::FrameHeader first_, header_;
    std::uint32_t frames_ = 0, number_ = 0;
    std::uint64_t bytes_ = 0;
    Bytes data_;
};

}  // namespace

std::unique_ptr<Recording> make_aris() { return std::make_unique<Aris>(); }

}  // namespace echoloop::convert
