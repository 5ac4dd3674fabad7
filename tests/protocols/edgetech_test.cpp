// EdgeTech messages: round trips, truncations, the framer on noisy, split and lying streams, samples of each
// format. The golden bytes of tests/data/edgetech are read by golden_test.cpp.
#include "protocols/edgetech/codec.h"

#include "protocols/edgetech/layouts.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::edgetech {
namespace {

/// What comes out of a stream that is cut into pieces.
std::vector<wire::Bytes> frames_of(wire::ByteView bytes, std::size_t piece) {
    return found_in_pieces(Framer(), bytes, piece);
}

template <class B>
Type type_of() {
    if constexpr (std::is_same_v<B, SystemTime>) return Type::system_time;
    if constexpr (std::is_same_v<B, Setting>) return Type::range;
    if constexpr (std::is_same_v<B, Coupling>) return Type::coupling;
    if constexpr (std::is_same_v<B, SonarData>) return Type::sonar_data;
    if constexpr (std::is_same_v<B, OldSideScan>) return Type::old_side_scan;
    if constexpr (std::is_same_v<B, SystemInformation>) return Type::system_information;
    if constexpr (std::is_same_v<B, NmeaText>) return Type::nmea_text;
    if constexpr (std::is_same_v<B, PitchRoll>) return Type::pitch_roll;
    if constexpr (std::is_same_v<B, Pressure>) return Type::pressure;
    return Type::padding;
}

template <class B>
class EdgetechBody : public ::testing::Test {};
TYPED_TEST_SUITE(EdgetechBody, TypesOf<Body>::type);

TYPED_TEST(EdgetechBody, MakesItsRoundTripAndIsRefusedWhenCut) {
    EXPECT_TRUE(rc::check([] {
        Message message{{.type = type_of<TypeParam>(), .subsystem = 21, .channel = 1},
                        arbitrary<TypeParam>()};
        const wire::Bytes bytes = encode(message);
        message.header.size = static_cast<std::uint32_t>(bytes.size() - header_bytes);
        const auto parsed = parse(bytes);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::holds_alternative<TypeParam>(parsed->body));
        RC_ASSERT(encode(*parsed) == bytes);
        for (std::size_t size = 0; size < bytes.size(); ++size)
            RC_ASSERT(!parse(wire::ByteView(bytes).first(size)).has_value());
    }));
}

TEST(EdgetechFramer, FindsMessagesInNoiseWhateverThePieces) {
    const wire::Bytes message = encode({{.type = Type::range, .subsystem = 21}, Setting{50000}});
    wire::Bytes stream = from_hex("00 01 16 FF 01 16 0D 00 50 00 09 15 00 00 01");
    stream.insert(stream.end(), message.begin(), message.end());
    stream.push_back('?');
    for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
        const auto found = frames_of(stream, piece);
        ASSERT_EQ(found.size(), 1U) << piece;
        EXPECT_EQ(found[0], message) << piece;
    }
}

TEST(EdgetechFramer, ASizeThatNobodyCouldReadIsNoise) {
    wire::Bytes stream = from_hex("01 16 0D 00 50 00 00 15 00 00 00 00 FF FF FF 7F");
    const wire::Bytes message = encode({{.type = Type::ping}, Setting{1}});
    stream.insert(stream.end(), message.begin(), message.end());
    EXPECT_EQ(frames_of(stream, 5).size(), 1U);
}

TEST(EdgetechFramer, TypesThatNobodyKnowsArePassedOn) {
    const wire::Bytes bytes = from_hex("01 16 0D 00 99 99 01 00 00 00 00 00 02 00 00 00 AA BB");
    ASSERT_EQ(frames_of(bytes, 3).size(), 1U);
    const auto message = parse(bytes);
    ASSERT_TRUE(message);
    EXPECT_EQ(name_of(message->header), "message 39321");
    EXPECT_EQ(std::get<Unread>(message->body).bytes, from_hex("AA BB"));
}

/// A known host leaves the size of the set before in a get.
TEST(EdgetechCodec, AGetMayCarryAnything) {
    const auto message = parse(from_hex("01 16 0D 00 80 00 01 15 00 00 00 00 04 00 00 00 01 02 03 04"));
    ASSERT_TRUE(message);
    EXPECT_TRUE(std::holds_alternative<Unread>(message->body));
}

TEST(EdgetechSonarData, NumbersBeyond16BitsStandInTwoPlaces) {
    SonarData data;
    set_sample_count(data, 0x12345);
    set_frequencies(data, 800e3, 900e3);
    EXPECT_EQ(data.samples, 0x2345);
    EXPECT_EQ(data.high_bits, 0x0111);
    EXPECT_EQ(sample_count(data), 0x12345U);
    EXPECT_EQ(start_frequency(data), 800e3);
    EXPECT_EQ(end_frequency(data), 900e3);
}

TEST(EdgetechSonarData, LevelsOfEachFormat) {
    SonarData data;
    data.weighting = 2;
    data.data = from_hex("10 00 FC FF");
    set_sample_count(data, 2);
    EXPECT_EQ(levels(data), (std::vector<float>{4, 16383}));
    data.format = DataFormat::real;
    EXPECT_EQ(levels(data), (std::vector<float>{4, 1}));
    data.format = DataFormat::analytic;
    EXPECT_TRUE(levels(data).empty()) << "two samples are eight bytes";
    set_sample_count(data, 1);
    data.data = from_hex("03 00 FC FF");
    EXPECT_EQ(levels(data), (std::vector<float>{1.25}));
    data.format = static_cast<DataFormat>(300);
    EXPECT_TRUE(levels(data).empty()) << "compressed";
}

}  // namespace
}  // namespace echoloop::edgetech
