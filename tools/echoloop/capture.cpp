#include "tools/echoloop/capture.h"

#include <pcap/pcap.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "emulator/error.h"
#include "emulator/scenario/file.h"
#include "tools/echoloop/pcapng_reader.h"
#include "tools/echoloop/tcp_streams.h"

namespace echoloop::cli {
namespace {

constexpr std::size_t magic_size = 4;

/// Feeds libpcap from an Input's bytes already read, then from its file.
struct Replay {
    Bytes head;
    std::size_t at = 0;
    std::FILE* rest = nullptr;
};

ssize_t replay_read(void* cookie, char* buffer, std::size_t size) {
    auto& replay = *static_cast<Replay*>(cookie);
    if (replay.at == replay.head.size())
        return static_cast<ssize_t>(std::fread(buffer, 1, size, replay.rest));
    const auto count = std::min(size, replay.head.size() - replay.at);
    std::memcpy(buffer, replay.head.data() + replay.at, count);
    replay.at += count;
    return static_cast<ssize_t>(count);
}

int replay_close(void* cookie) {
    const std::unique_ptr<Replay> replay(static_cast<Replay*>(cookie));
    return replay->rest == stdin ? 0 : std::fclose(replay->rest);
}

double seconds(const timeval& nano) {  // libpcap keeps nanoseconds in tv_usec at this precision
    return static_cast<double>(nano.tv_sec) + static_cast<double>(nano.tv_usec) * 1e-9;
}

}  // namespace

Input::Input(const std::string& name) : name_(name) {
    if (name == "-") {
        file_ = stdin;
    } else {
        if (const auto fault = scenario::file_fault(name)) {
            const bool permission = fault->kind == Problem::Kind::no_permission;
            throw StartError(permission ? Exit::no_permission : Exit::no_input,
                             scenario::in_quotes(name) + ": " + fault->message);
        }
        file_ = std::fopen(name.c_str(), "rbe");
        if (file_ == nullptr)
            throw StartError(Exit::no_input, scenario::in_quotes(name) + ": " + std::strerror(errno));
    }
}

Input::~Input() {
    if (file_ != nullptr && file_ != stdin) std::fclose(file_);
}

const Bytes& Input::peek(std::size_t count) {
    if (head_.size() < count) head_ = read(count);
    return head_;
}

bool Input::is_capture() {
    constexpr std::uint8_t magics[][magic_size] = {{0xD4, 0xC3, 0xB2, 0xA1},
                                                   {0xA1, 0xB2, 0xC3, 0xD4},
                                                   {0x4D, 0x3C, 0xB2, 0xA1},
                                                   {0xA1, 0xB2, 0x3C, 0x4D},
                                                   {0x0A, 0x0D, 0x0D, 0x0A}};
    const auto start = ByteView(peek(magic_size)).first(std::min(head_.size(), magic_size));
    return std::ranges::any_of(magics, [&](const auto& magic) { return std::ranges::equal(start, magic); });
}

Bytes Input::read(std::size_t count) {
    const auto have = std::min(count, head_.size());
    Bytes bytes(count);
    std::copy_n(head_.begin(), have, bytes.begin());
    head_.erase(head_.begin(), head_.begin() + static_cast<std::ptrdiff_t>(have));
    bytes.resize(have + std::fread(bytes.data() + have, 1, count - have, file_));
    if (std::ferror(file_) != 0)
        throw StartError(Exit::io, "cannot read " + scenario::in_quotes(name_) + ": " + std::strerror(errno));
    return bytes;
}

std::FILE* Input::release() {
    auto replay = std::make_unique<Replay>(Replay{std::move(head_), 0, file_});
    std::FILE* stream = ::fopencookie(replay.get(), "rb", {replay_read, nullptr, nullptr, replay_close});
    if (stream == nullptr) throw StartError(Exit::unavailable, "cannot open a stream: out of memory");
    static_cast<void>(replay.release());  // replay_close owns it now
    file_ = nullptr;
    return stream;
}

namespace {

/// Hands the content of packets on, stream bytes in their order.
class Sorter {
  public:
    Sorter(const CaptureEvents& events, CaptureCounts& counts) : events_(events), counts_(counts) {}

    void add(int link_type, const std::string& interface, double time, ByteView bytes) {
        ++counts_.packets;
        time_ = time;
        const Packet packet = reader_.read(link_type, bytes);
        if (const auto* datagram = std::get_if<Datagram>(&packet)) events_.datagram(time, *datagram);
        if (const auto* segment = std::get_if<TcpSegment>(&packet)) tcp_.add(*segment, tcp_bytes());
        if (const auto* serial = std::get_if<SerialBytes>(&packet))
            events_.stream(time, {interface, serial->sent, {}, {}, serial->payload});
    }

    void finish() {
        tcp_.finish(tcp_bytes());
        counts_.skipped = reader_.skipped();
        counts_.incomplete = reader_.incomplete();
    }

  private:
    TcpStreams::Each tcp_bytes() {
        return [this](Address from, Address to, ByteView bytes, bool gap) {
            events_.stream(time_, {"", false, from, to, bytes, gap});
        };
    }

    const CaptureEvents& events_;
    CaptureCounts& counts_;
    double time_ = 0;
    PacketReader reader_;
    TcpStreams tcp_;
};

void read_pcapng(Input& input, Sorter& sorter, CaptureCounts& counts) {
    PcapngReader file([&input](std::size_t count) { return input.read(count); });
    while (const auto packet = file.next()) {
        const double time = std::chrono::duration<double>(packet->time).count();
        sorter.add(packet->link_type, packet->interface, time, packet->bytes);
    }
    counts.fault = file.fault();
    if (counts.packets == 0 && !counts.fault.empty())
        throw StartError(Exit::data, scenario::in_quotes(input.name()) +
                                         " is no capture that can be read: " + counts.fault);
}

void read_pcap(Input& input, Sorter& sorter, CaptureCounts& counts) {
    char error[PCAP_ERRBUF_SIZE] = "";
    std::FILE* stream = input.release();
    const std::unique_ptr<pcap_t, decltype(&pcap_close)> capture(
        pcap_fopen_offline_with_tstamp_precision(stream, PCAP_TSTAMP_PRECISION_NANO, error), pcap_close);
    const auto name = scenario::in_quotes(input.name());
    if (!capture) {
        std::fclose(stream);
        throw StartError(Exit::data, name + " is no capture that can be read: " + scenario::printable(error));
    }
    const int link = pcap_datalink(capture.get());
    if (!PacketReader::reads(link)) {
        const char* link_name = pcap_datalink_val_to_name(link);
        throw StartError(Exit::data, name + ": packets of link type " +
                                         (link_name == nullptr ? std::to_string(link) : link_name) +
                                         " are not understood; capture on Ethernet, loopback or \"any\"");
    }
    pcap_pkthdr* header = nullptr;
    const std::uint8_t* bytes = nullptr;
    int status = 0;
    while ((status = pcap_next_ex(capture.get(), &header, &bytes)) == 1)
        sorter.add(link, "", seconds(header->ts), {bytes, header->caplen});
    if (status == PCAP_ERROR) counts.fault = scenario::printable(pcap_geterr(capture.get()));
}

}  // namespace

CaptureCounts read_capture(Input& input, const CaptureEvents& events) {
    CaptureCounts counts;
    Sorter sorter(events, counts);
    constexpr std::uint8_t pcapng_starts = 0x0A;
    const Bytes& start = input.peek(magic_size);
    if (!start.empty() && start[0] == pcapng_starts)
        read_pcapng(input, sorter, counts);
    else
        read_pcap(input, sorter, counts);
    sorter.finish();
    return counts;
}

}  // namespace echoloop::cli
