// .aris: a header, then frames put together from their parts, each with its header and its samples range
// after range.
#include "protocols/aris/beams.h"
#include "protocols/aris/codec.h"
#include "protocols/aris/frames.h"
#include "protocols/wire/write.h"
#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {
namespace {

constexpr std::size_t header_on_disk = 1024;

class Aris final : public Recording {
  public:
    void look(const Heard& heard) override {
        for_frame(heard, [this](const aris::FrameHeader& header, ByteView samples) {
            if (frames_++ == 0) first_ = header;
            bytes_ += header_on_disk + samples.size();
        });
    }

    void begin(std::ostream& out) override {
        joiner_ = {};
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
            header.index = static_cast<std::uint32_t>(count_);
            header.reordered = 1;
            Bytes bytes = aris::encode(header);
            bytes.resize(header_on_disk);
            put(out, bytes);
            put(out, samples);
            ++count_;
        });
    }

    void end(std::ostream&) override {
        joiner_.drop();
        lost_ = joiner_.lost();
    }

  private:
    /// Calls `each` with a frame that this part completes.
    template <class Each>
    void for_frame(const Heard& heard, Each each) {
        const auto part = aris::parse_frame_part(heard.bytes);
        if (heard.name != "FramePart" || !part) return;
        if (const auto frame = joiner_.add(*part)) each(frame->header, ByteView(frame->samples));
    }

    aris::FrameJoiner joiner_;
    aris::FrameHeader first_;
    std::uint32_t frames_ = 0;
    std::uint64_t bytes_ = 0;
};

}  // namespace

std::unique_ptr<Recording> make_aris() { return std::make_unique<Aris>(); }

}  // namespace echoloop::convert
