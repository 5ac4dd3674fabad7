// libFuzzer: any bytes as a pcapng file, through the packets and the streams to the messages in them.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "protocols/stream_decoder.h"
#include "tools/capture/packet.h"
#include "tools/capture/pcapng_reader.h"
#include "tools/capture/tcp_streams.h"

using namespace echoloop;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteView rest(data, size);
    capture::PcapngReader file([&rest](std::size_t count) {
        const ByteView part = rest.first(std::min(count, rest.size()));
        rest = rest.subspan(part.size());
        return Bytes(part.begin(), part.end());
    });
    capture::PacketReader reader;
    capture::TcpStreams tcp;
    inspect::StreamDecoder decoder;
    const auto ignore = [](const inspect::Family*, const inspect::Message&, ByteView) {};
    const auto decode = [&](Address, Address, ByteView bytes, bool) { decoder.add(bytes, ignore); };
    while (const auto raw = file.next()) {
        const auto packet = reader.read(raw->link_type, raw->bytes);
        if (const auto* segment = std::get_if<capture::TcpSegment>(&packet)) tcp.add(*segment, decode);
        if (const auto* serial = std::get_if<capture::SerialBytes>(&packet))
            decoder.add(serial->payload, ignore);
    }
    tcp.finish(decode);
    decoder.finish(ignore);
    return 0;
}
