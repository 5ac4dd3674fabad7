// libFuzzer: a row of packets in pieces whose sizes the input chooses, single packets with a checksum that is
// put right, and Snappy blocks. What is read is written and read again as the same.
#include <cstdlib>

#include "protocols/sonar3d/codec.h"
#include "protocols/sonar3d/framer.h"
#include "protocols/sonar3d/inspect.h"
#include "protocols/sonar3d/snappy.h"
#include "protocols/wire/crc.h"
#include "tests/protocols/fuzz_stream.h"

using namespace echoloop;
using namespace echoloop::sonar3d;

namespace {

void check(wire::ByteView bytes) {
    const auto packet = parse(bytes);
    if (!packet) return;
    const wire::Bytes written = serialise(*packet);
    if (written.size() > longest_packet) return;
    const auto again = parse(written);
    if (!again || serialise(*again) != written) std::abort();
}

/// The input as the payload of a packet that is right otherwise.
wire::Bytes framed(wire::ByteView payload, char version) {
    const std::size_t size = payload.size() + frame_bytes;
    wire::Bytes bytes{'R', 'I', 'P', static_cast<std::uint8_t>(version)};
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(size >> 8 * i));
    bytes.insert(bytes.end(), payload.begin(), payload.end());
    const std::uint32_t sum = echoloop::wire::crc32(bytes);
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(sum >> 8 * i));
    return bytes;
}

void stream(wire::ByteView bytes, std::size_t piece) {
    Framer framer;
    const auto take = [](const wire::Bytes& packet) {
        check(packet);
        return packet.size();
    };
    stream_in_pieces(framer, bytes, piece, longest_packet, take);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const wire::ByteView bytes(data + 1, size - 1);
    if (bytes.size() + frame_bytes <= longest_packet) {
        check(framed(bytes, '1'));
        check(framed(bytes, '2'));
        stream(framed(bytes, data[0] % 2 == 0 ? '1' : '2'), data[0] + 1U);
        decode(framed(bytes, '1'));
    }
    snappy_uncompress(bytes);
    if (snappy_uncompress(snappy_compress(bytes)) != wire::Bytes(bytes.begin(), bytes.end())) std::abort();
    stream(bytes, data[0] + 1U);
    recognise(bytes);
    return 0;
}
