// libFuzzer: any bytes as captured packets. The first byte chooses the link type, the next of each packet its
// length.
#include <pcap/dlt.h>

#include <cstddef>
#include <cstdint>

#include "protocols/inspect.h"
#include "tools/capture/packet.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr int links[] = {DLT_EN10MB, DLT_RAW, DLT_LINUX_SLL, DLT_LINUX_SLL2, DLT_NULL, 250};
    if (size == 0) return 0;
    const int link = links[data[0] % std::size(links)];
    echoloop::capture::PacketReader reader;
    std::span<const std::uint8_t> rest(data + 1, size - 1);
    while (!rest.empty()) {
        const auto length = std::min<std::size_t>(rest[0], rest.size() - 1);
        const auto packet = reader.read(link, rest.subspan(1, length));
        rest = rest.subspan(1 + length);
        const auto* datagram = std::get_if<echoloop::capture::Datagram>(&packet);
        if (datagram == nullptr) continue;
        if (const auto* family = echoloop::inspect::guess_family(datagram->payload))
            family->decode(datagram->payload);
    }
    return 0;
}
