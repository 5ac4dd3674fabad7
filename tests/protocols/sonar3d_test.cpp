// Range Image Protocol packets: truncations, faults, round trips, Snappy, the framer on noise, and the real
// recording.
#include <fstream>
#include <iterator>

#include "protocols/sonar3d/codec.h"
#include "protocols/sonar3d/framer.h"
#include "protocols/sonar3d/snappy.h"
#include "protocols/wire/crc.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::sonar3d {
namespace {

wire::Bytes golden(const std::string& name) {
    return read_hex_file(std::string(ECHOLOOP_SOURCE_DIR) + "/tests/data/" + name + ".hex").bytes;
}

wire::Bytes with_checksum(wire::Bytes packet) {
    packet.resize(packet.size() - 4);
    const std::uint32_t sum = wire::crc32(packet);
    for (int i = 0; i < 4; ++i) packet.push_back(static_cast<std::uint8_t>(sum >> 8 * i));
    return packet;
}

std::vector<wire::Bytes> packets_of(wire::ByteView bytes, std::size_t at = 0) {
    return found_in_two(Framer(), bytes, at);
}

class Sonar3dGolden : public ::testing::TestWithParam<const char*> {};

TEST_P(Sonar3dGolden, EveryTruncationIsRejected) {
    const wire::Bytes bytes = golden(GetParam());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto parsed = parse(wire::ByteView(bytes).first(size));
        ASSERT_FALSE(parsed.has_value()) << size;
        EXPECT_EQ(parsed.error().reason, wire::Reason::truncated) << size;
    }
}

TEST_P(Sonar3dGolden, EveryFlippedByteIsRejected) {
    for (std::size_t at = 0; at < golden(GetParam()).size(); ++at) {
        wire::Bytes bytes = golden(GetParam());
        bytes[at] ^= 0x10;
        EXPECT_FALSE(parse(bytes).has_value()) << at;
    }
}

TEST_P(Sonar3dGolden, ComesOutOfNoiseWhereverTheStreamIsSplit) {
    const wire::Bytes bytes = golden(GetParam());
    wire::Bytes stream = from_hex("52 49 50 52 52 49 50 32 ff ff ff ff 52 49 50 32 40 00 00 00 01 02");
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    stream.insert(stream.end(), bytes.begin(), bytes.begin() + 20);
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    for (std::size_t at = 0; at <= stream.size(); ++at)
        ASSERT_EQ(packets_of(stream, at), (std::vector{bytes, bytes})) << at;
}

INSTANTIATE_TEST_SUITE_P(Data, Sonar3dGolden,
                         ::testing::Values("sonar3d/range_rip1", "sonar3d/range_rip2", "sonar3d/bitmap_rip2",
                                           "sonar3d/unknown_rip2"));

TEST(Sonar3dPacket, TrailingBytesAreRejected) {
    wire::Bytes bytes = golden("sonar3d/range_rip2");
    bytes.push_back(0);
    ASSERT_FALSE(parse(bytes).has_value());
    EXPECT_EQ(parse(bytes).error().reason, wire::Reason::trailing_bytes);
}

TEST(Sonar3dPacket, UnknownFieldsAreSkippedAndPixelsMayStandAlone) {
    // Packet{Any{".RangeImage", value}} with field 15 of four kinds, and image_pixel_data as two single
    // fields.
    const std::string value = "7805 7d01020304 790102030405060708 7a0199 5007 508001";
    wire::Bytes bytes =
        from_hex("52495031 00000000 0a28 0a0b 2e52616e6765496d616765 1219" + value + "00000000");
    bytes[4] = static_cast<std::uint8_t>(bytes.size());
    bytes[9] = static_cast<std::uint8_t>(bytes.size() - 14);
    bytes[24] = static_cast<std::uint8_t>(bytes.size() - 29);
    const auto packet = parse(with_checksum(bytes));
    ASSERT_TRUE(packet.has_value()) << packet.error().what();
    EXPECT_EQ(std::get<RangeImage>(packet->message).image_pixel_data, (std::vector<std::uint32_t>{7, 128}));
}

TEST(Sonar3dPacket, ALyingLengthInsideIsRejected) {
    for (const char* payload : {"0a05 0a", "0aff ffffffffffffffffff01 00", "0b", "08 80"}) {
        wire::Bytes bytes = from_hex("52495031 00000000" + std::string(payload) + "00000000");
        bytes[4] = static_cast<std::uint8_t>(bytes.size());
        EXPECT_FALSE(parse(with_checksum(bytes)).has_value()) << payload;
    }
}

rc::Gen<wire::Bytes> compressible() {
    return rc::gen::container<wire::Bytes>(rc::gen::weightedOneOf<std::uint8_t>(
        {{8, rc::gen::just<std::uint8_t>(0)}, {1, rc::gen::arbitrary<std::uint8_t>()}}));
}

TEST(Sonar3dPacket, SurvivesARoundTrip) {
    EXPECT_TRUE(rc::check([] {
        RangeImage image;
        image.header.timestamp.seconds = *rc::gen::arbitrary<std::int64_t>();
        image.header.timestamp.nanos = *rc::gen::arbitrary<std::int32_t>();
        image.header.sequence_id = *rc::gen::arbitrary<std::uint32_t>();
        image.range = *rc::gen::element(0.0F, -0.0F, 15.0F, 1e30F);
        image.width = *rc::gen::arbitrary<std::uint32_t>();
        image.image_pixel_data = *rc::gen::arbitrary<std::vector<std::uint32_t>>();
        BitmapImage bitmap;
        bitmap.type = *rc::gen::inRange(0U, 2U);
        bitmap.image_pixel_data = *compressible();
        const Version version = *rc::gen::element(Version::rip1, Version::rip2);
        for (const Message& message : {Message(image), Message(bitmap)}) {
            const Packet packet{version, type_url("some.package", message), message};
            const auto parsed = parse(serialise(packet));
            RC_ASSERT(parsed.has_value());
            RC_ASSERT(*parsed == packet);
        }
    }));
}

TEST(Snappy, SurvivesARoundTripAndShrinksWhatRepeats) {
    EXPECT_TRUE(rc::check([] {
        const wire::Bytes bytes = *compressible();
        RC_ASSERT(snappy_uncompress(snappy_compress(bytes)) == bytes);
    }));
    for (const std::size_t size : {0U, 59U, 60U, 61U, 256U, 257U, 65536U, 65537U, 200000U}) {
        wire::Bytes noise(size), zeros(size);
        std::uint32_t x = 1;
        for (auto& byte : noise) byte = static_cast<std::uint8_t>((x = x * 1664525 + 1013904223) >> 24);
        EXPECT_EQ(snappy_uncompress(snappy_compress(noise)), noise) << size;
        EXPECT_EQ(snappy_uncompress(snappy_compress(zeros)), zeros) << size;
        EXPECT_LT(snappy_compress(zeros).size(), 16 + size / 20);
        EXPECT_LE(snappy_compress(noise).size(), size + 8 + size / 100);
    }
}

TEST(Snappy, ReadsEveryElementOfTheFormat) {
    // literal "abcd"; copies with offsets of 11, 16 and 32 bits; a literal whose length has its own byte
    EXPECT_EQ(snappy_uncompress(from_hex("15 0c 61626364 01 04 0a 0400 0f 02000000 f0 05 787878787878")),
              from_hex("61626364 61626364 616263 62636263 787878787878"));
}

TEST(Snappy, RefusesBlocksThatLie) {
    for (const char* block :
         {"", "05 0c 61626364", "03 0c 61626364", "08 0c 61626364 01 00", "08 0c 61626364 01 05",
          "04 0c 6162", "ffffffff0f 00 61", "80", "04 fc ffffffff", "06 0c 61626364 01 04"})
        EXPECT_FALSE(snappy_uncompress(from_hex(block)).has_value()) << block;
}

TEST(Sonar3dRecording, IsReadWholeWithOneHeaderAShot) {
    ECHOLOOP_NEED_DATA(path, "sonar-3d-15/ship_short.sonar");
    std::ifstream file(*path, std::ios::binary);
    const wire::Bytes bytes{std::istreambuf_iterator<char>(file), {}};
    std::size_t total = 0;
    std::optional<Header> shot;
    const auto packets = packets_of(bytes, 5000);
    ASSERT_EQ(packets.size(), 12U);
    for (const wire::Bytes& one : packets) {
        const auto packet = parse(one);
        ASSERT_TRUE(packet.has_value()) << packet.error().what();
        total += one.size();
        if (const auto* image = std::get_if<RangeImage>(&packet->message)) {
            shot = image->header;
            EXPECT_EQ(image->image_pixel_data.size(), 256U * 64);
            EXPECT_EQ(image->image_pixel_scale, 50.0F / 65536);
        } else {
            EXPECT_EQ(std::get<BitmapImage>(packet->message).header, *shot);
        }
        const auto again = parse(serialise(*packet));
        ASSERT_TRUE(again.has_value());
        EXPECT_EQ(*again, *packet);
    }
    EXPECT_EQ(total, bytes.size());
}

}  // namespace
}  // namespace echoloop::sonar3d
