// Range Image Protocol packets: truncations, faults, round trips, Snappy, the framer on noise, and the real
// recording. HTTP requests and JSON as the sonar's interface takes them.
#include <fstream>
#include <iterator>

#include "protocols/http/json.h"
#include "protocols/http/request.h"
#include "protocols/sonar3d/codec.h"
#include "protocols/sonar3d/framer.h"
#include "protocols/sonar3d/snappy.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"

namespace echoloop::sonar3d {
namespace {

wire::Bytes golden(const std::string& name) {
    return read_hex_file(std::string(ECHOLOOP_SOURCE_DIR) + "/tests/data/" + name + ".hex").bytes;
}

wire::Bytes with_checksum(wire::Bytes packet) {
    packet.resize(packet.size() - 4);
    const std::uint32_t sum = crc32(packet);
    for (int i = 0; i < 4; ++i) packet.push_back(static_cast<std::uint8_t>(sum >> 8 * i));
    return packet;
}

std::vector<wire::Bytes> packets_of(wire::ByteView bytes, std::size_t at = 0) {
    Framer framer;
    std::vector<wire::Bytes> out;
    const auto drain = [&] {
        while (auto packet = framer.next()) out.push_back(*std::move(packet));
    };
    framer.feed(bytes.first(at));
    drain();
    framer.feed(bytes.subspan(at));
    framer.finish();
    drain();
    return out;
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

namespace echoloop::http {
namespace {

wire::Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

/// The status of the refusal, or 0.
int refusal_of(std::string_view text) {
    RequestReader reader;
    reader.feed(bytes_of(text));
    const auto next = reader.next();
    const auto* refusal = next ? std::get_if<Refusal>(&*next) : nullptr;
    return refusal ? refusal->status : 0;
}

TEST(HttpRequest, IsReadWhereverTheStreamIsSplit) {
    wire::Bytes stream = sonar3d::golden("http/post_range");
    const wire::Bytes get = sonar3d::golden("http/get_about");
    stream.insert(stream.end(), get.begin(), get.end());
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        RequestReader reader;
        std::vector<Request> requests;
        for (const auto part : {wire::ByteView(stream).first(at), wire::ByteView(stream).subspan(at)}) {
            reader.feed(part);
            while (const auto next = reader.next()) requests.push_back(std::get<Request>(*next));
        }
        ASSERT_EQ(requests.size(), 2U) << at;
        EXPECT_EQ(requests[0].method, "POST");
        EXPECT_EQ(requests[0].target, "/api/v1/integration/acoustics/range");
        EXPECT_EQ(requests[0].body, R"({"min": 2.0, "max": 3.0})");
        EXPECT_EQ(requests[1].method, "GET");
        EXPECT_EQ(requests[1].body, "");
        EXPECT_EQ(reader.pending_bytes(), 0U);
    }
}

TEST(HttpRequest, WhatIsNoneIsRefusedAndForgotten) {
    EXPECT_EQ(refusal_of("nonsense\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("GET / FTP/1.1\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("GET / HTTP/1.1\r\nno colon\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nContent-Length: 65537\r\n\r\n"), 413);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nTransfer-Encoding: gzip, chunked\r\n\r\n"), 501);
    EXPECT_EQ(refusal_of("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\nContent-Length: 1\r\n\r\n"), 400);
    EXPECT_EQ(refusal_of(std::string(longest_head + 1, 'x')), 431);
    RequestReader reader;
    reader.feed(bytes_of("nonsense\r\n\r\n"));
    reader.next();
    EXPECT_EQ(reader.pending_bytes(), 0U);
}

const std::string chunked_head = "POST / HTTP/1.1\r\ntransfer-encoding: Chunked\r\n\r\n";

TEST(HttpRequest, InChunksIsReadWhereverTheStreamIsSplit) {
    const auto stream = bytes_of(chunked_head +
                                 "4\r\n{\"a\"\r\n0003;name=value\r\n: 1\r\n1\r\n}\r\n0\r\n"
                                 "Trailer: x\r\n\r\nGET /next HTTP/1.1\r\n\r\n");
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        RequestReader reader;
        std::vector<Request> requests;
        for (const auto part : {wire::ByteView(stream).first(at), wire::ByteView(stream).subspan(at)}) {
            reader.feed(part);
            while (const auto next = reader.next()) requests.push_back(std::get<Request>(*next));
        }
        ASSERT_EQ(requests.size(), 2U) << at;
        EXPECT_EQ(requests[0].body, R"({"a": 1})");
        EXPECT_EQ(requests[1].target, "/next");
        EXPECT_EQ(reader.pending_bytes(), 0U);
    }
}

TEST(HttpRequest, InChunksThatAreNoneIsRefused) {
    for (const char* chunks : {"\r\n", "x\r\n", "-1\r\n", "0x1\r\n", "1\r\nab\r\n", "1x\r\n"})
        EXPECT_EQ(refusal_of(chunked_head + chunks), 400) << chunks;
    EXPECT_EQ(refusal_of(chunked_head + "10001\r\n"), 413) << "65537";
    EXPECT_EQ(refusal_of(chunked_head + "ffffffffffffffffffff\r\n"), 413);
    EXPECT_EQ(refusal_of(chunked_head + "1;" + std::string(300, 'x')), 400) << "a line without an end";
    std::string trailers = "0\r\n";
    for (int i = 0; i < 40; ++i) trailers += "A: b\r\n";
    EXPECT_EQ(refusal_of(chunked_head + trailers), 400);
}

TEST(HttpRequest, InChunksKeepsNoMoreThanItsBody) {
    RequestReader reader;
    reader.feed(bytes_of(chunked_head));
    int status = 0;
    for (std::size_t sent = 0; status == 0 && sent < 70'000; ++sent) {
        reader.feed(bytes_of("1;" + std::string(200, 'x') + "\r\na\r\n"));
        const auto next = reader.next();
        if (next) status = std::get<Refusal>(*next).status;
        ASSERT_LE(reader.pending_bytes(), longest_body + 10) << sent;
    }
    EXPECT_EQ(status, 413) << "behind 65536 bytes";
    EXPECT_EQ(reader.pending_bytes(), 0U);
}

TEST(HttpResponse, HasItsLengthAndNoneWithoutContent) {
    EXPECT_EQ(response(200, "21.0"), bytes_of("HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n"
                                              "Content-Length: 4\r\nConnection: close\r\n\r\n21.0"));
    EXPECT_EQ(response(204), bytes_of("HTTP/1.1 204 No Content\r\nConnection: close\r\n\r\n"));
    EXPECT_EQ(response(404),
              bytes_of("HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"));
}

TEST(Json, ReadsBareValuesAndFlatObjects) {
    EXPECT_EQ(read_json(" true "), Json(JsonScalar(true)));
    EXPECT_EQ(read_json("null"), Json(JsonScalar()));
    EXPECT_EQ(read_json("-1.5e2"), Json(JsonScalar(-150.0)));
    EXPECT_EQ(read_json(R"("a\"\u00e9\n")"), Json(JsonScalar("a\"\xC3\xA9\n")));
    EXPECT_EQ(read_json(R"({"a": 1, "b" :"x"} )"),
              Json(JsonObject{{"a", JsonScalar(1.0)}, {"b", JsonScalar("x")}}));
    for (const char* text : {"", "tru", "truex", "inf", ".5", "1e999", "{", "{\"a\"}", "{\"a\":1,}", "[1]",
                             "{\"a\":{}}", "\"a", "\"\\x\"", "\"\\u12\"", "1 2", "{\"a\":1}}"})
        EXPECT_FALSE(read_json(text).has_value()) << text;
}

TEST(Json, NumbersHaveAPointAndReadBack) {
    EXPECT_EQ(json_number(21), "21.0");
    EXPECT_EQ(json_number(0.1), "0.1");
    EXPECT_EQ(json_number(1e22), "1e+22");
    EXPECT_EQ(json_string("a\"\\\x01"), R"("a\"\\\u0001")");
}

}  // namespace
}  // namespace echoloop::http
