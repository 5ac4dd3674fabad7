#include <algorithm>

#include "protocols/aris/beams.h"
#include "protocols/aris/codec.h"
#include "tools/capture/little_endian.h"
#include "tools/capture/makers_files.h"

namespace echoloop::capture {
namespace {

constexpr std::size_t aris_header = 1024, most_samples = 8192;
constexpr std::size_t version_at = 12, sonar_time_at = 20, computer_time_at = 4, ping_mode_at = 436,
                      samples_at = 468;
// As the device's own: a datagram of 1500 bytes with its headers, one every 0.3 ms.
constexpr std::size_t room_in_part = 1400 - 32;
constexpr double part_spacing = 0.3e-3;  // s

/// B of header and samples; 0 if no frame begins here.
std::size_t frame_size(ByteView bytes) {
    if (bytes.size() < aris_header || little::u32(bytes, version_at) != aris::header_version) return 0;
    const auto* mode = aris::find_ping_mode(little::u32(bytes, ping_mode_at));
    const std::size_t per_beam = little::u32(bytes, samples_at);
    if (mode == nullptr || per_beam == 0 || per_beam > most_samples) return 0;
    return aris_header + mode->beams * per_beam;
}

bool begins_frame(ByteView bytes) { return frame_size(bytes) != 0; }

class ArisFile final : public Container {
  public:
    explicit ArisFile(bool in_parts) : in_parts_(in_parts) {}

    Entry look(ByteView pending, bool last) override {
        if (pending.size() < aris_header && !last) return {};
        const std::size_t size = frame_size(pending);
        if (size > pending.size() && !last) return {};
        if (size == 0 || size > pending.size())
            return {.size = distance_to_next(pending, last, aris_header, begins_frame), .damaged = true};
        const std::uint64_t us = little::u64(pending, sonar_time_at);
        const auto lost = lost_bytes_before(pending, size, last, aris_header, begins_frame);
        if (!lost) return {};
        if (*lost > 0) return {.size = *lost, .damaged = true};
        Entry entry{.size = size,
                    .time = static_cast<double>(us != 0 ? us : little::u64(pending, computer_time_at)) * 1e-6,
                    .said = parts(pending.first(size)),
                    .spacing = part_spacing};
        return entry;
    }

  private:
    std::vector<Bytes> parts(ByteView frame) {
        const ByteView data = frame.subspan(aris_header);
        aris::FramePart part;
        part.frame_index = ++frames_;
        part.total_data_size = static_cast<std::uint32_t>(data.size());
        part.header.assign(frame.begin(), frame.begin() + aris::header_bytes);
        std::vector<Bytes> out;
        for (std::size_t at = 0; at < data.size(); at += part.data.size()) {
            const std::size_t room = !in_parts_ ? data.size()
                                     : at == 0  ? room_in_part - aris::header_bytes
                                                : room_in_part;
            const ByteView piece = data.subspan(at, std::min(room, data.size() - at));
            part.data.assign(piece.begin(), piece.end());
            part.data_offset = static_cast<std::uint32_t>(at);
            out.push_back(aris::encode(part));
            part.header.clear();
        }
        return out;
    }

    bool in_parts_;
    std::uint32_t frames_ = 0;
};

}  // namespace

std::unique_ptr<CaptureReader> open_aris(Input& input, const OpenSettings& settings) {
    const Bytes& start = input.peek(4);
    if (start.size() < 4 || little::u32(start, 0) != aris::header_version) return nullptr;
    const std::size_t begin = input.read(aris_header).size();
    return std::make_unique<ContainerFile>(input, std::make_unique<ArisFile>(settings.as_sent), "aris",
                                           ContainerFile::Speech::datagrams, begin);
}

}  // namespace echoloop::capture
