// Norbit WBMS packets: round trips, truncations, the framer on noisy, split and lying streams; commands and
// their lines.
#include "protocols/inspect.h"
#include "protocols/norbit/codec.h"
#include "protocols/norbit/command.h"
#include "protocols/norbit/framer.h"
#include "protocols/norbit/layouts.h"
#include "protocols/wire/crc.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::norbit {
namespace {

wire::Bytes golden(const std::string& name) {
    return read_hex_file(std::string(ECHOLOOP_SOURCE_DIR) + "/tests/data/norbit/" + name + ".hex").bytes;
}

/// Frames found in `bytes`, the stream cut at `at`.
std::vector<Frame> frames_of(wire::ByteView bytes, std::size_t at = 0) {
    return found_in_two(Framer(), bytes, at);
}

template <class M>
class NorbitMessage : public ::testing::Test {};
TYPED_TEST_SUITE(NorbitMessage, TypesOf<Message>::type);

TYPED_TEST(NorbitMessage, SurvivesARoundTripThroughAFrame) {
    EXPECT_TRUE(rc::check([] {
        const auto message = arbitrary<TypeParam>();
        const auto frames = frames_of(encode(Message(message), *rc::gen::arbitrary<std::uint32_t>()));
        RC_ASSERT(frames.size() == 1U);
        const auto parsed = parse(frames[0]);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::holds_alternative<TypeParam>(*parsed));
        RC_ASSERT(std::get<TypeParam>(*parsed) == message);
    }));
}

class NorbitGolden : public ::testing::TestWithParam<const char*> {};

TEST_P(NorbitGolden, EveryTruncationIsNoPacket) {
    const wire::Bytes bytes = golden(GetParam());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_TRUE(frames_of(wire::ByteView(bytes).first(size)).empty()) << size;
}

TEST_P(NorbitGolden, ComesOutOfNoiseWhereverTheStreamIsSplit) {
    const wire::Bytes bytes = golden(GetParam()), other = golden("bathymetry");
    const wire::Bytes noise =
        from_hex("ef ef be ad ef be ad de 01 00 00 00 70 00 00 00 04 00 00 00 01 00 00 00");
    const wire::Bytes stream = joined({noise, bytes, noise, other});
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        const auto frames = frames_of(stream, at);
        ASSERT_EQ(frames.size(), 2U) << at;
        EXPECT_EQ(frames[0].payload, wire::Bytes(bytes.begin() + 24, bytes.end())) << at;
        EXPECT_EQ(frames[1].payload, wire::Bytes(other.begin() + 24, other.end())) << at;
    }
}

INSTANTIATE_TEST_SUITE_P(Data, NorbitGolden, ::testing::Values("bathymetry", "water_column", "snippet"),
                         [](const auto& name) { return std::string(name.param); });

TEST(NorbitFramer, EveryFlippedByteOfAPacketWithAChecksumCostsThatPacketOnly) {
    const wire::Bytes bytes = golden("bathymetry"), other = golden("water_column");
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        if (at >= 12 && at < 16) continue;  // any version is read
        wire::Bytes damaged = bytes;
        damaged[at] ^= 0x55;
        const auto frames = frames_of(joined({damaged, other}));
        ASSERT_EQ(frames.size(), 1U) << at;
        EXPECT_EQ(frames[0].header.type, Type::water_column) << at;
    }
}

TEST(NorbitFramer, EveryByteIsAccountedForAndMemoryIsBounded) {
    Framer framer;
    wire::Bytes claim = golden("water_column");
    claim[10] = 0x0F;  // nearly 1 MB
    for (int i = 0; i < 30000; ++i) {
        framer.feed(claim);
        ASSERT_LE(framer.pending_bytes(), max_packet + claim.size());
    }
    EXPECT_EQ(framer.skipped_bytes() + framer.pending_bytes(), 30000 * claim.size());
}

TEST(NorbitCrc, IsZlibs) {
    const std::string check = "123456789";
    EXPECT_EQ(wire::crc32(wire::Bytes(check.begin(), check.end())), 0xCBF43926U);
    EXPECT_EQ(wire::crc32({}), 0U);
}

TEST(NorbitImage, IsFoundOnlyWhereTheTailHoldsIt) {
    auto message = std::get<WaterColumn>(*parse(frames_of(golden("water_column")).at(0)));
    const auto image = image_of(message);
    ASSERT_TRUE(image);
    EXPECT_EQ(to_hex(image->samples), "010002002c019001fbffff7f");
    EXPECT_EQ(to_hex(image->angles), "000000bf0000003f");
    for (auto change :
         {+[](WaterColumn& w) { w.samples = 4; }, +[](WaterColumn& w) { w.beams = 0xFFFFFFFF; },
          +[](WaterColumn& w) { w.samples = 0xFFFFFFFF; }, +[](WaterColumn& w) { w.tail.pop_back(); },
          +[](WaterColumn& w) { w.sample = Sample(8); }, +[](WaterColumn& w) { w.sample = Sample::s32; }}) {
        WaterColumn wrong = message;
        change(wrong);
        EXPECT_FALSE(image_of(wrong));
    }
}

TEST(NorbitInspect, SaysWhatContradictsItself) {
    auto message = std::get<WaterColumn>(*parse(frames_of(golden("water_column")).at(0)));
    message.samples = 9;
    const auto messages = inspect::find_family("norbit")->decode(
        joined({golden("bathymetry"), from_hex("00 01"), encode(message), golden("snippet")}));
    ASSERT_EQ(messages.size(), 4U);
    EXPECT_EQ(messages[0].name, "Bathymetry");
    EXPECT_EQ(messages[1].name, "");
    EXPECT_NE(messages[2].reason, "");
    EXPECT_EQ(messages[3].name, "Snippet");
}

TEST(NorbitCommand, IsWordsWithoutItsComment) {
    EXPECT_EQ(*read_command("  set_range\t.5 30 # in meter"), (Command{"set_range", {".5", "30"}}));
    EXPECT_EQ(*read_command("temperature"), (Command{"temperature", {}}));
    for (const char* none : {"", "  ", "# only words", "set_p\xFFwer 1", "set\x01"})
        EXPECT_FALSE(read_command(none));
    EXPECT_FALSE(read_command("x 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17"));
    EXPECT_EQ(write_answer({"set_range", {"0.5", "20"}}, "in meter"), "set_range 0.5 20 # in meter\r\n");
}

TEST(NorbitCommand, NumbersAreWholeAndFinite) {
    EXPECT_EQ(read_number(".5"), 0.5);
    EXPECT_EQ(read_number("+3"), 3);
    EXPECT_EQ(read_number("-1e1"), -10);
    for (const char* none : {"", "nan", "inf", "1e999", "3m", " 3", "0x10"})
        EXPECT_FALSE(read_number(none)) << none;
}

TEST(NorbitCommand, NumbersAreWrittenShortOrWithADecimalAtLeast) {
    for (const auto& [value, brief, full] : {std::tuple(20.0, "20", "20.0"),
                                             {0.5, "0.5", "0.5"},
                                             {-0.25, "-0.25", "-0.25"},
                                             {0.0, "0", "0.0"}}) {
        EXPECT_EQ(write_number(value), brief);
        EXPECT_EQ(write_decimal(value), full);
    }
}

TEST(NorbitLines, EndAsHostsEndThemOrNotAtAll) {
    LineFramer lines;
    const auto feed = [&](const std::string& text) { lines.feed(wire::Bytes(text.begin(), text.end())); };
    feed("set_power 1\r\nset_");
    EXPECT_EQ(lines.next(), "set_power 1");
    EXPECT_EQ(lines.next(), "");
    EXPECT_FALSE(lines.next());
    feed("range");
    EXPECT_FALSE(lines.next());
    EXPECT_TRUE(lines.waits());
    EXPECT_EQ(lines.rest(), "set_range");
    EXPECT_FALSE(lines.waits());
    feed(std::string(600, 'x'));
    EXPECT_FALSE(lines.next());
    EXPECT_FALSE(lines.waits());
    feed("tail\nserial\n");
    EXPECT_EQ(lines.next(), "serial") << "a line too long is skipped whole";
    EXPECT_EQ(lines.skipped_bytes(), 605U);
}

}  // namespace
}  // namespace echoloop::norbit
