// libFuzzer: any bytes as two captures of serial lines, datagrams and connections, compared.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "tools/echoloop/diff/compare.h"
#include "tools/echoloop/diff/json.h"

using namespace echoloop;

namespace {

/// Events {kind and direction, length, bytes} out of whatever there is.
class Events final : public capture::CaptureReader {
  public:
    explicit Events(ByteView bytes) : rest_(bytes) {}

    std::optional<capture::CaptureEvent> next() override {
        if (rest_.size() < 2) return {};
        const std::uint8_t kind = rest_[0];
        const std::size_t size = std::min<std::size_t>(rest_[1], rest_.size() - 2);
        const ByteView bytes = rest_.subspan(2, size);
        rest_ = rest_.subspan(2 + size);
        capture::CaptureEvent event{.time = 0.001 * static_cast<double>(++packets_)};
        event.packet = packets_;
        const Address here{0x7F000001, 4000},
            there{0x7F000001, static_cast<std::uint16_t>(5000 + (kind >> 6))};
        const bool sent = (kind & 1) != 0;
        const Address from = sent ? here : there, to = sent ? there : here;
        if ((kind & 6) == 0)
            event.content = capture::Datagram{from, to, {bytes.begin(), bytes.end()}, (kind & 8) != 0};
        else if ((kind & 6) == 2)
            event.content =
                capture::StreamPiece{"", false, from, to, {bytes.begin(), bytes.end()}, (kind & 8) != 0};
        else
            event.content = capture::StreamPiece{"line", sent, {}, {}, {bytes.begin(), bytes.end()}, false};
        return event;
    }
    capture::CaptureCounts counts() const override { return {packets_, 0, 0, {}}; }

  private:
    ByteView rest_;
    std::uint64_t packets_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const ByteView all(data, size);
    diff::Side a, b;
    Events first(all.first(size / 2)), second(all.subspan(size / 2));
    const diff::SideSettings settings{.family = nullptr, .port = {}, .most_bytes = std::size_t{1} << 20};
    diff::read_events(first, settings, a);
    diff::read_events(second, settings, b);
    const diff::Rules rules;
    static_cast<void>(diff::report_json(diff::compare(a, b, rules)));
    return 0;
}
