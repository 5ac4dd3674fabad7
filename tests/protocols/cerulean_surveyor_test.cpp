// The messages of the Surveyor 240-16: sizes of the published struct strings, round trips, truncations,
// noise.
#include "protocols/cerulean/surveyor_codec.h"
#include "protocols/cerulean/surveyor_layouts.h"
#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"

namespace echoloop::cerulean::surveyor {
namespace {

static_assert(fixed_size<PingParameters>() == 36 && fixed_size<AttitudeReport>() == 36);
static_assert(fixed_size<AtofPoint>() == 16 && fixed_size<YzPoint>() == 8);
static_assert(fixed_size<UtcResponse>() == 12 && fixed_size<UtcRequest>() == 0);
static_assert(fixed_size<SetNetInfo>() == 12 && fixed_size<WaterStats>() == 8);

/// The only frame in `bytes`, or nothing.
std::optional<ping::Frame> frame_of(wire::ByteView bytes) {
    ping::Framer framer;
    framer.feed(bytes);
    framer.finish();
    return framer.next();
}

template <class M>
class SurveyorMessage : public ::testing::Test {};
using OwnMessages = ::testing::Types<UtcRequest, UtcResponse, SetNetInfo, WaterStats, AttitudeReport,
                                     YzPointData, AtofPointData, PingParameters, JsonWrapper, ping::Nack>;
TYPED_TEST_SUITE(SurveyorMessage, OwnMessages);

TYPED_TEST(SurveyorMessage, SurvivesARoundTripThroughAFrame) {
    EXPECT_TRUE(rc::check([] {
        const auto message = arbitrary<TypeParam>();
        const wire::Bytes bytes = encode(Message(message), *rc::gen::arbitrary<std::uint8_t>());
        const auto frame = frame_of(bytes);
        RC_ASSERT(frame.has_value());
        const auto parsed = surveyor::Codec::parse(*frame);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::holds_alternative<TypeParam>(*parsed));
        RC_ASSERT(std::get<TypeParam>(*parsed) == message);
    }));
}

TYPED_TEST(SurveyorMessage, EveryTruncationIsRejectedUnlessItEndsInText) {
    const bool text = std::is_same_v<TypeParam, JsonWrapper> || std::is_same_v<TypeParam, ping::Nack>;
    EXPECT_TRUE(rc::check([&] {
        const wire::Bytes bytes = encode(Message(arbitrary<TypeParam>()));
        const auto frame = frame_of(bytes);
        RC_ASSERT(frame.has_value());
        for (std::size_t size = 0; size < frame->payload.size() && !text; ++size) {
            ping::Frame cut = *frame;
            cut.payload.resize(size);
            RC_ASSERT(!surveyor::Codec::parse(cut));
        }
        for (std::size_t size = 0; size < bytes.size(); ++size)
            RC_ASSERT(!frame_of(wire::ByteView(bytes).first(size)));
    }));
}

TEST(Surveyor, ALyingCountIsRefusedBeforeAnythingIsAllocated) {
    AtofPointData data;
    data.atof_point_data.resize(3);
    auto frame = *frame_of(encode(Message(data)));
    frame.payload[36] = frame.payload[37] = 0xFF;  // num_points
    EXPECT_EQ(surveyor::Codec::parse(frame).error(),
              (Error{"AtofPointData", "atof_point_data", 48, Reason::truncated}));
    frame.payload[36] = 2;
    frame.payload[37] = 0;
    EXPECT_EQ(surveyor::Codec::parse(frame).error().reason, Reason::trailing_bytes);
}

TEST(Surveyor, AnEmptyPayloadIsARequestForWhatHasContent) {
    const auto short_request = [](Id id) {
        return surveyor::Codec::is_short_request(ping::short_request(static_cast<ping::Id>(id)));
    };
    EXPECT_TRUE(short_request(Id::atof_point_data));
    EXPECT_TRUE(short_request(Id::attitude_report));
    EXPECT_FALSE(short_request(Id::utc_request)) << "it has no content";
    EXPECT_FALSE(short_request(Id::os_mono_profile)) << "an Omniscan's";
    EXPECT_FALSE(surveyor::Codec::parse(ping::short_request(static_cast<ping::Id>(Id::os_mono_profile))));
}

TEST(Surveyor, PointsComeOutOfNoise) {
    AtofPointData data;
    data.atof_point_data = {{0.5F, 0.0078125F, {}}};
    const wire::Bytes good = encode(Message(data), 1);
    for (std::size_t at = 0; at < good.size(); ++at) {
        wire::Bytes stream = from_hex("00 ff 42 52 10");
        stream.insert(stream.end(), good.begin(), good.end());
        stream[stream.size() - good.size() + at] ^= 0x21;
        stream.insert(stream.end(), good.begin(), good.end());
        const auto frame = frame_of(stream);
        ASSERT_TRUE(frame) << at;
        EXPECT_EQ(std::get<AtofPointData>(*surveyor::Codec::parse(*frame)), data) << at;
    }
}

}  // namespace
}  // namespace echoloop::cerulean::surveyor
