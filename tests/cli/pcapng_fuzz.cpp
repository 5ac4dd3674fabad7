// libFuzzer: any bytes as a pcapng file, through the packets and the streams to the messages in them.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "tools/echoloop/packet.h"
#include "tools/echoloop/pcapng_reader.h"
#include "tools/echoloop/stream_decoder.h"
#include "tools/echoloop/tcp_streams.h"

using namespace echoloop;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteView rest(data, size);
    cli::PcapngReader file([&rest](std::size_t count) {
        const ByteView part = rest.first(std::min(count, rest.size()));
        rest = rest.subspan(part.size());
        return Bytes(part.begin(), part.end());
    });
    cli::PacketReader reader;
    cli::TcpStreams tcp;
    cli::StreamDecoder decoder;
    const auto ignore = [](const inspect::Family*, const inspect::Message&) {};
    const auto decode = [&](Address, Address, ByteView bytes, bool) { decoder.add(bytes, ignore); };
    while (const auto raw = file.next()) {
        const auto packet = reader.read(raw->link_type, raw->bytes);
        if (const auto* segment = std::get_if<cli::TcpSegment>(&packet)) tcp.add(*segment, decode);
        if (const auto* serial = std::get_if<cli::SerialBytes>(&packet)) decoder.add(serial->payload, ignore);
    }
    tcp.finish(decode);
    decoder.finish(ignore);
    return 0;
}
