// The messages of the Omniscan 450 and the S500: sizes of the published struct strings, round trips,
// truncations, noise, and what a Ping1D says under the same ids.
#include "protocols/cerulean/omniscan_codec.h"
#include "protocols/cerulean/omniscan_layouts.h"
#include "protocols/cerulean/s500_codec.h"
#include "protocols/cerulean/s500_layouts.h"
#include "protocols/inspect.h"
#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"

namespace echoloop::cerulean {
namespace {

static_assert(fixed_size<s500::SetPingParams>() == 20 && fixed_size<s500::FwVersion>() == 6);
static_assert(fixed_size<s500::Altitude>() == 5 && fixed_size<s500::Distance2>() == 16);
static_assert(fixed_size<s500::ProcessorTemperature>() == 4 && fixed_size<s500::GainIndex>() == 4);
static_assert(fixed_size<s500::PingRate>() == 2 && fixed_size<s500::Range>() == 8);

/// The only frame in `bytes`, or nothing.
std::optional<ping::Frame> frame_of(wire::ByteView bytes) {
    ping::Framer framer;
    framer.feed(bytes);
    framer.finish();
    return framer.next();
}

template <class M>
constexpr bool ends_in_text =
    std::is_same_v<M, ping::Nack> || std::is_same_v<M, ping::AsciiText> || std::is_same_v<M, JsonWrapper>;

/// Whether a payload cut to `size` is another whole form of the message.
template <class M>
bool is_whole(std::size_t size) {
    constexpr std::size_t short_form = 34;
    if (std::is_same_v<M, ping::Nack>) return size >= 2;
    return ends_in_text<M> || (std::is_same_v<M, omniscan::OsPingParams> && size == short_form);
}

template <class Message, class M>
void check_round_trip(const auto& parse, const auto& encode) {
    EXPECT_TRUE(rc::check([&] {
        const auto message = arbitrary<M>();
        const wire::Bytes bytes = encode(Message(message), *rc::gen::arbitrary<std::uint8_t>(), 0);
        const auto frame = frame_of(bytes);
        RC_ASSERT(frame.has_value());
        const auto parsed = parse(*frame);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::holds_alternative<M>(*parsed));
        RC_ASSERT(std::get<M>(*parsed) == message);
        for (std::size_t size = 0; size < frame->payload.size(); ++size) {
            ping::Frame cut = *frame;
            cut.payload.resize(size);
            RC_ASSERT(parse(cut).has_value() == is_whole<M>(size));
        }
        for (std::size_t size = 0; size < bytes.size(); ++size)
            RC_ASSERT(!frame_of(wire::ByteView(bytes).first(size)));
    }));
}

template <class M>
class OmniscanMessage : public ::testing::Test {};
TYPED_TEST_SUITE(OmniscanMessage, TypesOf<omniscan::Message>::type);
TYPED_TEST(OmniscanMessage, SurvivesARoundTripAndNoTruncation) {
    check_round_trip<omniscan::Message, TypeParam>(omniscan::Codec::parse, omniscan::Codec::encode);
}

template <class M>
class S500Message : public ::testing::Test {};
TYPED_TEST_SUITE(S500Message, TypesOf<s500::Message>::type);
TYPED_TEST(S500Message, SurvivesARoundTripAndNoTruncation) {
    check_round_trip<s500::Message, TypeParam>(s500::Codec::parse, s500::Codec::encode);
}

TEST(Omniscan, AProfileOf1200ResultsIsAsLongAsTheSpecificationSays) {
    omniscan::OsMonoProfile profile;
    profile.pwr_results.resize(1200);
    EXPECT_EQ(omniscan::Codec::encode(profile).size(), 2462U);
}

TEST(Omniscan, ParametersComeInTwoLengthsAndNoOther) {
    const wire::Bytes head =
        from_hex("00000000 10270000 32000000 00000000 00000000 6f12033b a69bc43a ffff 5802 01");
    ping::Frame frame{{static_cast<ping::Id>(2197), 0, 0}, head, 0};
    for (std::size_t reserved = 0; reserved <= 5; ++reserved) {
        EXPECT_EQ(omniscan::Codec::parse(frame).has_value(), reserved == 1 || reserved == 3) << reserved;
        frame.payload.push_back(0);
    }
}

TEST(S500, AChirpOf6000ResultsIsOneMessage) {
    s500::Profile6 profile;
    profile.pwr_results.resize(6000);
    const auto messages = inspect::find_family("cerulean")->decode(s500::Codec::encode(profile));
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].name, "Profile6");
    EXPECT_EQ(messages[0].size, 12076U);
}

TEST(Cerulean, ACountThatLiesIsRefused) {
    omniscan::OsMonoProfile profile;
    profile.pwr_results = {1, 2, 3};
    ping::Frame frame = *frame_of(omniscan::Codec::encode(profile));
    frame.payload[22] = frame.payload[23] = 0xFF;  // num_results
    EXPECT_EQ(omniscan::Codec::parse(frame).error(),
              (Error{"OsMonoProfile", "pwr_results", 60, Reason::truncated}));
}

TEST(Cerulean, FramesComeOutOfNoise) {
    wire::Bytes stream = from_hex("00 ff 55 42 42 52 ff 42");
    const auto params = omniscan::Codec::encode(omniscan::OsPingParams{.reserved_3 = {0, 0, 0}});
    stream.insert(stream.end(), params.begin(), params.end());
    stream.push_back('B');
    const auto messages = inspect::find_family("cerulean")->decode(stream);
    ASSERT_EQ(messages.size(), 3U);
    EXPECT_EQ(messages[1].name, "OsPingParams");
    EXPECT_EQ(messages[1].reason, "");
    EXPECT_EQ(messages[1].offset, 8U);
}

TEST(Cerulean, IsOnlyRecognisedByWhatNoPingDeviceSays) {
    const auto guess = [](std::string_view hex) { return inspect::guess_family(from_hex(hex))->name; };
    // The altitude of an S500 is a distance_simple of a Ping1D, byte for byte.
    EXPECT_EQ(guess("42 52 05 00 BB 04 01 00 DA 07 00 00 64 9E 02"), "ping");
    // Four bytes of temperature are an S500's, two are a Ping1D's.
    EXPECT_EQ(guess("42 52 04 00 BD 04 00 00 E1 10 00 00 4A 02"), "cerulean");
    EXPECT_EQ(guess("42 52 02 00 BD 04 00 00 E1 10 48 02"), "ping");
    // An id of theirs with a payload that is none of theirs.
    EXPECT_EQ(guess("42 52 02 00 95 08 00 00 00 00 33 01"), "ping");
}

TEST(Cerulean, AmbiguousMessagesHaveTheNamesOfTheFamilyThatWasAskedFor) {
    const auto altitude = from_hex("42 52 05 00 BB 04 01 00 DA 07 00 00 64 9E 02");
    const auto named = inspect::find_family("cerulean")->decode(altitude);
    ASSERT_EQ(named.size(), 1U);
    EXPECT_EQ(named[0].name, "Altitude");
    EXPECT_EQ(named[0].fields.back().text, "100");
    const auto voltage =
        inspect::find_family("cerulean")->decode(from_hex("42 52 02 00 B2 04 00 00 88 13 E7 01"));
    ASSERT_EQ(voltage.size(), 1U);
    EXPECT_EQ(voltage[0].name, "id 1202");
    EXPECT_NE(voltage[0].reason, "");
}

}  // namespace
}  // namespace echoloop::cerulean
