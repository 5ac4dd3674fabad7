// The Ping protocol: round trips, truncations, and the framer on noisy, split and lying streams.
#include "protocols/inspect.h"
#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"
#include "protocols/ping/ping1d_layouts.h"
#include "protocols/ping/ping360_layouts.h"
#include "protocols/wire/read.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::ping {
namespace {

// Sizes of the published definitions, which are those of Python's struct strings.
static_assert(fixed_size<DeviceInformation>() == 6 && fixed_size<ProtocolVersion>() == 4);
static_assert(fixed_size<Transducer>() == 14 && fixed_size<AutoTransmit>() == 16 && fixed_size<Reset>() == 2);
static_assert(fixed_size<MotorOff>() == 0 && fixed_size<Ping360SetDeviceId>() == 2);
static_assert(fixed_size<Distance>() == 24 && fixed_size<DistanceSimple>() == 5);
static_assert(fixed_size<GeneralInfo>() == 10 && fixed_size<FirmwareVersion>() == 6);
static_assert(fixed_size<SetGainSetting>() == 1 && fixed_size<GainSetting>() == 4);

const wire::Bytes request = from_hex("42 52 02 00 06 00 00 00 05 00 a1 00");

template <class M>
class PingMessage : public ::testing::Test {};
TYPED_TEST_SUITE(PingMessage, TypesOf<Message>::type);

TYPED_TEST(PingMessage, SurvivesARoundTripThroughAFrame) {
    EXPECT_TRUE(rc::check([] {
        const auto message = arbitrary<TypeParam>();
        const wire::Bytes bytes = encode(Message(message), *rc::gen::arbitrary<std::uint8_t>());
        Framer framer;
        framer.feed(bytes);
        const auto frame = framer.next();
        RC_ASSERT(frame.has_value());
        const auto parsed = parse(*frame);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::holds_alternative<TypeParam>(*parsed));
        RC_ASSERT(std::get<TypeParam>(*parsed) == message);
        RC_ASSERT(encode(*frame) == bytes);
    }));
}

TYPED_TEST(PingMessage, EveryTruncationIsRejected) {
    EXPECT_TRUE(rc::check([] {
        const Frame frame = make_frame(Message(arbitrary<TypeParam>()));
        for (std::size_t size = 0; size < frame.payload.size(); ++size) {
            Frame cut = frame;
            cut.payload.resize(size);
            RC_ASSERT(!parse(cut));
        }
        const wire::Bytes bytes = encode(frame);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            RC_ASSERT(!wire::parse<Frame>(wire::ByteView(bytes).first(size)));
            Framer framer;
            framer.feed(wire::ByteView(bytes).first(size));
            framer.finish();
            RC_ASSERT(!framer.next());
        }
    }));
}

TYPED_TEST(PingMessage, ALongerPayloadIsRejectedUnlessItEndsInText) {
    const bool text = std::is_same_v<TypeParam, Nack> || std::is_same_v<TypeParam, AsciiText>;
    Frame frame = make_frame(Message(TypeParam{}));
    frame.payload.push_back(0);
    EXPECT_EQ(parse(frame).has_value(), text);
}

TEST(PingCodec, AnEmptyPayloadIsARequestForWhatHasContent) {
    EXPECT_TRUE(is_short_request(short_request(Id::device_information)));
    EXPECT_FALSE(is_short_request(short_request(Id::motor_off))) << "it has no content";
    EXPECT_FALSE(is_short_request(make_frame(DeviceInformation{})));
    EXPECT_FALSE(is_short_request(short_request(static_cast<Id>(4321))));
    EXPECT_EQ(to_hex(encode(short_request(Id::device_information))),
              to_hex(from_hex("42520000040000009800")));
}

TEST(PingCodec, ALyingDataLengthIsRefused) {
    Frame frame = make_frame(DeviceData{.data = {1, 2, 3}});
    frame.payload[12] = 0xFF;
    frame.payload[13] = 0xFF;
    EXPECT_EQ(parse(frame).error(), (Error{"DeviceData", "data", 22, Reason::truncated}));
}

/// Frames found in `bytes`, the stream cut at `at`.
std::vector<Frame> frames_of(wire::ByteView bytes, std::size_t at = 0,
                             Framer::Waiting waiting = Framer::Waiting::patient) {
    return found_in_two(Framer(waiting), bytes, at);
}

TEST(PingFramer, FramesComeOutOfNoiseWhereverTheStreamIsSplit) {
    wire::Bytes stream = from_hex("00 ff 55 55 42 42 52 ff 42");
    stream.insert(stream.end(), request.begin(), request.end());
    for (const std::uint8_t byte : from_hex("5a 48 00 00 48 b8 a5 42")) stream.push_back(byte);
    const wire::Bytes data = encode(DeviceData{.data = wire::Bytes(300, 'B')}, 2);
    stream.insert(stream.end(), data.begin(), data.end());
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        const auto frames = frames_of(stream, at);
        ASSERT_EQ(frames.size(), 2U) << at;
        EXPECT_EQ(encode(frames[0]), request) << at;
        EXPECT_EQ(encode(frames[1]), data) << at;
    }
}

TEST(PingFramer, EveryDamagedByteCostsThatFrameOnly) {
    for (std::size_t at = 0; at < request.size(); ++at) {
        wire::Bytes stream = request;
        stream.insert(stream.end(), request.begin(), request.end());
        stream[at] ^= 0x21;
        const auto frames = frames_of(stream);
        ASSERT_EQ(frames.size(), 1U) << at;
        EXPECT_EQ(encode(frames[0]), request);
    }
}

TEST(PingFramer, AnImpatientOneIsNotHeldUpByALengthThatLies) {
    for (std::size_t at = 0; at < request.size(); ++at) {
        wire::Bytes damaged = request;
        damaged[at] ^= 0x40;
        Framer framer(Framer::Waiting::impatient);
        framer.feed(damaged);
        EXPECT_FALSE(framer.next());
        framer.feed(request);
        EXPECT_TRUE(framer.next()) << at;
    }
}

TEST(PingFramer, EveryByteIsAccountedForAndMemoryIsBounded) {
    Framer framer;
    const wire::Bytes claim = from_hex("42 52 00 28 00 00");  // claims 10240 bytes that never come right
    for (int i = 0; i < 40000; ++i) framer.feed(claim);
    EXPECT_LE(framer.pending_bytes(), 65536U);
    EXPECT_FALSE(framer.next());
    EXPECT_LE(framer.pending_bytes(), max_frame_bytes);
    EXPECT_EQ(framer.skipped_bytes() + framer.pending_bytes(), 40000 * claim.size());
    framer.clear();
    framer.feed(request);
    EXPECT_TRUE(framer.next());
    EXPECT_EQ(framer.frame_offset(), 40000 * claim.size());
}

TEST(PingInspect, NamesRequestsOfTheOlderKindAndWhatItCannotRead) {
    wire::Bytes stream = encode(short_request(Id::profile));
    const wire::Bytes unknown = encode(short_request(static_cast<Id>(4321)));
    stream.insert(stream.end(), unknown.begin(), unknown.end());
    const auto messages = inspect::find_family("ping")->decode(stream);
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_EQ(messages[0].name, "Profile request");
    EXPECT_EQ(messages[1].name, "id 4321");
    EXPECT_NE(messages[1].reason, "");
}

}  // namespace
}  // namespace echoloop::ping
