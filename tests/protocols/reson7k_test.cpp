// 7k records: round trips, truncations, packets, and the framer on noisy, split and lying streams.
#include "protocols/inspect.h"
#include "protocols/reson7k/codec.h"
#include "protocols/reson7k/framer.h"
#include "protocols/reson7k/layouts.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::reson7k {
namespace {

wire::Bytes golden(const std::string& name) {
    return read_hex_file(std::string(ECHOLOOP_SOURCE_DIR) + "/tests/data/reson7k/" + name + ".hex").bytes;
}

/// Records found in `bytes`, the stream cut at `at`.
std::vector<Record> records_of(wire::ByteView bytes, std::size_t at = 0,
                               Source source = Source::network_or_file) {
    return found_in_two(Framer(source == Source::network ? host_record : max_record, source), bytes, at);
}

template <class M>
class Reson7kMessage : public ::testing::Test {};
TYPED_TEST_SUITE(Reson7kMessage, TypesOf<Message>::type);

TYPED_TEST(Reson7kMessage, SurvivesARoundTripThroughPackets) {
    EXPECT_TRUE(rc::check([] {
        auto message = arbitrary<TypeParam>();
        const wire::Bytes record = encode(Message(message), {});
        const wire::Bytes stream = joined(packets_of(record, 7, 7125, 200));
        const auto records = records_of(stream);
        RC_ASSERT(records.size() == 1U);
        RC_ASSERT(encode(records[0]) == record);
        const auto parsed = parse(records[0]);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(encode(*parsed, records[0].frame) == record);
        RC_ASSERT(std::holds_alternative<TypeParam>(*parsed));
        RC_ASSERT(records_of(record).size() == 1U);  // as in a file
    }));
}

class Reson7kGolden : public ::testing::TestWithParam<const char*> {};

TEST_P(Reson7kGolden, EveryTruncationIsNoRecord) {
    const wire::Bytes bytes = golden(GetParam());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_TRUE(records_of(wire::ByteView(bytes).first(size)).empty()) << size;
}

TEST_P(Reson7kGolden, AnyFlippedByteOfTheRecordIsSeen) {
    const wire::Bytes bytes = golden(GetParam());
    for (std::size_t at = network_frame_size; at < bytes.size(); ++at) {
        if (at == network_frame_size + 48) continue;  // the flag that says that the checksum counts
        wire::Bytes wrong = bytes;
        wrong[at] ^= 0x10;
        EXPECT_TRUE(records_of(wrong).empty()) << at;
    }
}

TEST_P(Reson7kGolden, ComesOutOfNoiseWhereverTheStreamIsSplit) {
    const wire::Bytes bytes = golden(GetParam()), range = golden("range");
    const wire::Bytes noise = from_hex("05 00 24 05 00 3c 00 ff ff 00 01 05 00 24 00 01 00");
    const wire::Bytes stream = joined({noise, bytes, noise, range});
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        const auto records = records_of(stream, at);
        ASSERT_EQ(records.size(), 2U) << at;
        EXPECT_EQ(joined(packets_of(encode(records[1]), 6, 0)), range) << at;
    }
}

INSTANTIATE_TEST_SUITE_P(Data, Reson7kGolden,
                         ::testing::Values("subscribe", "range", "acknowledge", "not_acknowledge",
                                           "detections", "settings", "remote_settings", "geometry",
                                           "beamformed"),
                         [](const auto& name) { return std::string(name.param); });

TEST(Reson7kFramer, ALostByteCostsOneRecordOnly) {
    const wire::Bytes subscribe = golden("subscribe");
    for (std::size_t lost = 0; lost < subscribe.size(); ++lost) {
        wire::Bytes damaged = subscribe;
        damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(lost));
        const wire::Bytes stream = joined({damaged, subscribe});
        Framer framer(host_record, Source::network);
        framer.feed(stream);
        EXPECT_TRUE(framer.next()) << lost;
    }
}

/// Offset 64, as MBARI's client for 7k sonars (MB-System, mbtrn) has it: its content is in the same place.
TEST(Reson7kFramer, AHostMayCountTheContentFromTheFirstByteOfTheFrame) {
    wire::Bytes subscribe = golden("subscribe");
    subscribe[network_frame_size + 2] = 64;
    subscribe[subscribe.size() - 4] += 4;  // checksum
    for (std::size_t at = 0; at <= subscribe.size(); ++at) {
        const auto records = records_of(subscribe, at, Source::network);
        ASSERT_EQ(records.size(), 1U) << at;
        EXPECT_EQ(records[0].content, records_of(golden("subscribe"))[0].content);
    }
    for (const std::uint8_t other : wire::Bytes{0, 59, 61, 63, 65, 68}) {
        subscribe[network_frame_size + 2] = other;
        EXPECT_FALSE(plausible_record_frame(wire::ByteView(subscribe).subspan(network_frame_size)));
    }
}

/// A record of 3000 bytes in packets of 1000.
std::vector<wire::Bytes> three_packets() {
    Image image;
    image.pixels.assign(2700, 5);
    return packets_of(encode(Message(image), {}), 3, 7125, 1000);
}

TEST(Reson7kFramer, PacketsOfOneRecordMustBelongTogether) {
    auto packets = three_packets();
    ASSERT_EQ(packets.size(), 3U);
    EXPECT_EQ(packets[0].size(), 1000U);
    EXPECT_EQ(records_of(joined(packets)).size(), 1U);
    const wire::Bytes range = golden("range");
    EXPECT_EQ(records_of(joined({packets[0], packets[2], packets[1], range})).size(), 1U) << "only range";
    packets[1][10] ^= 1;  // another transmission
    EXPECT_EQ(records_of(joined({packets[0], packets[1], packets[2], range})).size(), 1U) << "only range";
    EXPECT_EQ(records_of(joined({packets[0], range})).size(), 1U) << "the host went away in between";
}

TEST(Reson7kFramer, PacketsMayComeInPieces) {
    const wire::Bytes stream = joined(three_packets());
    for (const std::size_t size : {1U, 50U, 150U, 1000U}) {
        Framer framer;
        int found = 0;
        for (std::size_t at = 0; at < stream.size(); at += size) {
            framer.feed(wire::ByteView(stream).subspan(at, std::min(size, stream.size() - at)));
            while (framer.next()) ++found;
        }
        EXPECT_EQ(found, 1) << size;
        EXPECT_EQ(framer.skipped_bytes(), 0U) << size;
    }
}

TEST(Reson7kFramer, ALyingSizeIsNoise) {
    for (const std::size_t at : {4U, 12U, 16U, 20U, 36U + 8U}) {  // packets, sizes, sequence; record size
        wire::Bytes lie = golden("range");
        lie[at + 2] = 1;  // 64 kB more
        EXPECT_EQ(records_of(joined({lie, golden("subscribe")}), 0, Source::network).size(), 1U) << at;
    }
}

TEST(Reson7kFramer, EveryByteIsAccountedForAndMemoryIsBounded) {
    Framer framer(host_record, Source::network);
    wire::Bytes claim = three_packets()[0];
    claim.resize(200);
    for (int i = 0; i < 400; ++i) {
        framer.feed(claim);
        EXPECT_LE(framer.pending_bytes(), 2 * host_record);
        EXPECT_FALSE(framer.next());
    }
    EXPECT_EQ(framer.skipped_bytes() + framer.pending_bytes(), 400 * claim.size());
}

TEST(Reson7kTime, IsDayOfYearAndTimeOfDayInUtc) {
    // 2024 was a leap year: 31 December, 23:59:59.5 UTC is day 366.
    const Time7k time = to_time(1735689599.5);
    EXPECT_EQ(time, (Time7k{2024, 366, 59.5F, 23, 59}));
    EXPECT_EQ(to_time(0), (Time7k{1970, 1, 0, 0, 0}));
    EXPECT_LT(to_time(59.9999999).seconds, 60);
}

TEST(Reson7kInspect, NamesRecordsOfStreamsAndFilesAndTypesWithoutATable) {
    wire::Bytes in_file = golden("detections");
    in_file.erase(in_file.begin(), in_file.begin() + network_frame_size);
    Record other;
    other.frame.type = 7777;
    other.content = {1, 2, 3, 4};
    const auto messages = inspect::find_family("reson7k")->decode(
        joined({golden("subscribe"), from_hex("00 01 02"), in_file, encode(other)}));
    ASSERT_EQ(messages.size(), 4U);
    EXPECT_EQ(messages[0].name, "RemoteControl");
    EXPECT_EQ(messages[1].name, "");
    EXPECT_EQ(messages[2].name, "RawDetections");
    EXPECT_EQ(messages[2].offset, golden("subscribe").size() + 3);
    EXPECT_EQ(messages[3].name, "record 7777");
    EXPECT_NE(messages[3].reason, "");
}

}  // namespace
}  // namespace echoloop::reson7k
