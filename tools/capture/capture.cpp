#include "tools/capture/capture.h"

#include <deque>

#include "tools/capture/pcap_reader.h"
#include "tools/capture/tcp_streams.h"

namespace echoloop::capture {
namespace {

/// The content of packets, stream bytes in their order. `File`: PcapReader or PcapngReader.
template <class File>
class PacketCapture final : public CaptureReader {
  public:
    template <class... Source>
    explicit PacketCapture(Source&&... source) : file_(std::forward<Source>(source)...) {}

    std::optional<CaptureEvent> next() override {
        while (waiting_.empty() && !ended_) advance();
        if (waiting_.empty()) return {};
        CaptureEvent event = std::move(waiting_.front());
        waiting_.pop_front();
        return event;
    }

    CaptureCounts counts() const override {
        return {packets_, reader_.skipped(), reader_.incomplete(), file_.fault()};
    }

    bool of_ports() const override {
        if constexpr (requires { file_.application(); }) return file_.application().starts_with("echoloop");
        return false;
    }

  private:
    void advance() {
        const auto raw = file_.next();
        if (!raw) {
            ended_ = true;
            return tcp_.finish(tcp_bytes());
        }
        ++packets_;
        about_ = {std::chrono::duration<double>(raw->time).count(),
                  raw->interface,
                  raw->sent,
                  {},
                  packets_,
                  raw->comment};
        const Packet packet = reader_.read(raw->link_type, raw->bytes);
        if (const auto* datagram = std::get_if<Datagram>(&packet)) add(*datagram);
        if (const auto* segment = std::get_if<TcpSegment>(&packet)) tcp_.add(*segment, tcp_bytes());
        if (const auto* serial = std::get_if<SerialBytes>(&packet))
            add(StreamPiece{raw->interface, serial->sent, {}, {}, serial->payload});
    }

    template <class Content>
    void add(Content content) {
        CaptureEvent event = about_;
        event.content = std::move(content);
        waiting_.push_back(std::move(event));
    }

    TcpStreams::Each tcp_bytes() {
        return [this](Address from, Address to, ByteView bytes, bool gap) {
            add(StreamPiece{"", false, from, to, Bytes(bytes.begin(), bytes.end()), gap});
        };
    }

    File file_;
    PacketReader reader_;
    TcpStreams tcp_;
    CaptureEvent about_;  ///< what is known of the packet at hand
    std::deque<CaptureEvent> waiting_;
    std::uint64_t packets_ = 0;
    bool ended_ = false;
};

}  // namespace

std::unique_ptr<CaptureReader> open_packets(Input& input) {
    constexpr std::uint8_t pcapng_starts = 0x0A;
    const Bytes& start = input.peek(1);
    if (start.empty() || start[0] != pcapng_starts) return std::make_unique<PacketCapture<PcapReader>>(input);
    return std::make_unique<PacketCapture<PcapngReader>>(
        [&input](std::size_t count) { return input.read(count); });
}

}  // namespace echoloop::capture
