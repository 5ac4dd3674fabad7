// Oculus messages: round trips, truncations, the framer on noisy, split and lying streams, and three real
// pings.
#include <fstream>
#include <iterator>

#include "protocols/inspect.h"
#include "protocols/oculus/codec.h"
#include "protocols/oculus/framer.h"
#include "protocols/oculus/layouts.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"
#include "tests/protocols/streams.h"

namespace echoloop::oculus {
namespace {

constexpr const char* recording = "oculus/three_pings_8bit.raw";

wire::Bytes golden(const std::string& name) {
    return read_hex_file(std::string(ECHOLOOP_SOURCE_DIR) + "/tests/data/oculus/" + name + ".hex").bytes;
}

/// Frames found in `bytes`, the stream cut at `at`.
std::vector<Frame> frames_of(wire::ByteView bytes, std::size_t at = 0, std::size_t longest = max_payload) {
    return found_in_two(Framer(longest), bytes, at);
}

template <class M>
class OculusMessage : public ::testing::Test {};
TYPED_TEST_SUITE(OculusMessage, TypesOf<Message>::type);

TYPED_TEST(OculusMessage, SurvivesARoundTripThroughAFrame) {
    EXPECT_TRUE(rc::check([] {
        auto message = arbitrary<TypeParam>();
        if constexpr (requires { message.beams; })
            message.beams = static_cast<std::uint16_t>(message.bearings.size());
        if constexpr (std::is_same_v<TypeParam, FullResult>) message.bytes.resize(40);
        const wire::Bytes bytes = encode(Message(message), *rc::gen::arbitrary<std::uint16_t>());
        const auto frames = frames_of(bytes);
        RC_ASSERT(frames.size() == 1U);
        const auto parsed = parse(frames[0]);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::holds_alternative<TypeParam>(*parsed));
        RC_ASSERT(std::get<TypeParam>(*parsed) == message);
        RC_ASSERT(encode(frames[0]) == bytes);
    }));
}

class OculusGolden : public ::testing::TestWithParam<const char*> {};

TEST_P(OculusGolden, EveryTruncationIsNoMessage) {
    const wire::Bytes bytes = golden(GetParam());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_TRUE(frames_of(wire::ByteView(bytes).first(size)).empty()) << size;
}

TEST_P(OculusGolden, ComesOutOfNoiseWhereverTheStreamIsSplit) {
    const wire::Bytes bytes = golden(GetParam()), fire = golden("fire_v1");
    const wire::Bytes noise = from_hex("53 00 53 53 4f 53 4f 00 00 00 00 15 00 00 00 26 00 00 00 00 00 4f");
    const wire::Bytes stream = joined({noise, bytes, noise, fire});
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        const auto frames = frames_of(stream, at);
        ASSERT_EQ(frames.size(), 2U) << at;
        EXPECT_EQ(encode(frames[0]), bytes) << at;
        EXPECT_EQ(encode(frames[1]), fire) << at;
    }
}

INSTANTIATE_TEST_SUITE_P(Data, OculusGolden,
                         ::testing::Values("fire_v1", "fire_v2", "result_v1", "result_v2", "status", "dummy",
                                           "user_config", "log_text"),
                         [](const auto& name) { return std::string(name.param); });

TEST(OculusFramer, ALostByteCostsOneMessageOnly) {
    const wire::Bytes fire = golden("fire_v2");
    for (std::size_t lost = 0; lost < fire.size(); ++lost) {
        wire::Bytes damaged = fire;
        damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(lost));
        const auto frames = frames_of(joined({damaged, fire}), 0, host_payload);
        ASSERT_FALSE(frames.empty()) << lost;
        EXPECT_EQ(encode(frames.back()), fire) << lost;
    }
}

TEST(OculusFramer, ALyingSizeIsNoise) {
    wire::Bytes lie = golden("fire_v1");
    lie[10] = 0x26;  // one byte more than a v1 fire has
    EXPECT_EQ(frames_of(joined({lie, golden("dummy")})).size(), 1U);
    wire::Bytes huge = golden("result_v1");
    huge[13] = 0x7F;  // 2 GB
    EXPECT_EQ(frames_of(joined({huge, golden("dummy")})).size(), 1U);
    EXPECT_EQ(frames_of(joined({golden("result_v1"), golden("dummy")}), 0, host_payload).size(), 1U)
        << "a device waits for no image";
}

/// The maker's own client clears the structure, and fills in neither version nor size.
TEST(OculusFramer, AFireMessageWithoutItsSizeIsWhole) {
    for (const auto& [name, payload] : {std::pair{"fire_v1", 37U}, {"fire_v2", 73U}}) {
        wire::Bytes fire = golden(name);
        const auto whole = parse(frames_of(fire).at(0));
        fire[10] = 0;
        for (std::size_t at = 0; at <= fire.size(); ++at) {
            const auto frames = frames_of(joined({fire, golden("dummy")}), at, host_payload);
            ASSERT_EQ(frames.size(), 2U) << name << " cut at " << at;
            EXPECT_EQ(frames[0].payload.size(), payload);
            EXPECT_TRUE(*parse(frames[0]) == *whole);
        }
    }
}

TEST(OculusFramer, ThePartNumberOfNewerUnitsIsNoNoise) {
    wire::Bytes result = golden("result_v1");
    result[14] = 0x08, result[15] = 0x04;
    EXPECT_EQ(frames_of(joined({result, golden("dummy")})).size(), 2U);
}

TEST(OculusFramer, EveryByteIsAccountedForAndMemoryIsBounded) {
    Framer framer(host_payload);
    wire::Bytes claim = golden("fire_v2");
    claim.resize(40);
    for (int i = 0; i < 4000; ++i) {
        framer.feed(claim);
        EXPECT_LE(framer.pending_bytes(), host_payload + 16 + claim.size());
    }
    EXPECT_FALSE(framer.next());
    EXPECT_EQ(framer.skipped_bytes() + framer.pending_bytes(), 4000 * claim.size());
    framer.clear();
    framer.feed(golden("dummy"));
    EXPECT_TRUE(framer.next());
    EXPECT_EQ(framer.frame_offset(), 4000 * claim.size());
}

TEST(OculusImage, IsFoundOnlyWhereTheFieldsAgree) {
    const auto frames = frames_of(golden("result_v1"));
    const auto result = std::get<ResultV1>(*parse(frames.at(0)));
    const auto image = image_of(result);
    ASSERT_TRUE(image);
    EXPECT_TRUE(image->gain_words);
    EXPECT_EQ(image->row_bytes, 8U);
    EXPECT_EQ(to_hex(image->bytes.first(8)), "64000000000a14fe");
    for (auto change : {+[](ResultV1& r) { r.image_size = 23; }, +[](ResultV1& r) { r.image_offset = 129; },
                        +[](ResultV1& r) { r.image_offset = 137; }, +[](ResultV1& r) { r.ranges = 4; },
                        +[](ResultV1& r) { r.ranges = 0xFFFF; }, +[](ResultV1& r) { r.tail.clear(); },
                        +[](ResultV1& r) { r.data_size = DataSize::bits16; },
                        +[](ResultV1& r) { r.fire.flags &= ~flag::gain_words & 0xFF; }}) {
        ResultV1 wrong = result;
        change(wrong);
        EXPECT_FALSE(image_of(wrong));
    }
}

TEST(OculusImage, IsWrittenIntoItsPlaceWithSizesThatReadersCheck) {
    ResultV2 result;
    result.fire.fire.flags = flag::gain_words;
    result.data_size = DataSize::bits32;
    result.ranges = 1000;
    result.bearings.assign(512, 0);
    const wire::Bytes bytes = encode_around_image(result, 77);
    ASSERT_EQ(bytes.size(), result.message_size);
    EXPECT_EQ(result.image_size, 1000U * (512 * 4 + 4));
    const auto frames = frames_of(bytes);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].header.source, 77);
    const auto parsed = std::get<ResultV2>(*parse(frames[0]));
    ASSERT_TRUE(image_of(parsed));
    EXPECT_EQ(image_of(parsed)->bytes.size(), result.image_size);
}

TEST(OculusBearings, AreEqualInSineAndCutTowardZero) {
    const auto angles = bearings(256, 60 * M_PI / 180);
    EXPECT_EQ(wire_bearing(angles.front()), -3000);
    EXPECT_EQ(wire_bearing(angles.back()), 3000);
    for (std::size_t i = 0; i < 256; ++i) {
        const double degrees = std::asin(-0.5 + static_cast<double>(i) / 255) * 180 / M_PI;
        EXPECT_NEAR(angles[i] * 180 / M_PI, degrees, 1e-9) << i;
        EXPECT_LE(std::abs(wire_bearing(angles[i])), 100 * std::abs(degrees) + 1e-6) << i;
        EXPECT_GT(std::abs(wire_bearing(angles[i])), 100 * std::abs(degrees) - 1) << i;
    }
}

TEST(OculusInspect, NamesBothVersionsAndSaysWhatContradictsItself) {
    wire::Bytes wrong = golden("result_v1");
    wrong[114] = 25;  // image size
    const auto messages = inspect::find_family("oculus")->decode(
        joined({golden("fire_v2"), from_hex("00 01 02"), wrong, golden("status")}));
    ASSERT_EQ(messages.size(), 4U);
    EXPECT_EQ(messages[0].name, "FireV2");
    EXPECT_EQ(messages[1].name, "");
    EXPECT_EQ(messages[2].name, "Result");
    EXPECT_NE(messages[2].reason, "");
    EXPECT_EQ(messages[3].name, "Status");
}

// Real pings of an M1200d, high frequency.
std::vector<Frame> real_pings(const std::filesystem::path& path, wire::Bytes& bytes) {
    std::ifstream file(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
    return frames_of(bytes);
}

TEST(RealOculus, PingsAreWrittenBackByteForByte) {
    ECHOLOOP_NEED_DATA(path, recording);
    wire::Bytes bytes, again;
    for (const Frame& frame : real_pings(*path, bytes)) {
        const auto message = parse(frame);
        ASSERT_TRUE(message) << message.error().what();
        const wire::Bytes one = encode(*message, frame.header.source);
        again.insert(again.end(), one.begin(), one.end());
    }
    EXPECT_EQ(bytes.size(), 3U * 182016);
    EXPECT_TRUE(again == bytes);
}

TEST(RealOculus, FieldsAndBearingsAreTheKnownOnes) {
    ECHOLOOP_NEED_DATA(path, recording);
    wire::Bytes bytes;
    const auto frames = real_pings(*path, bytes);
    ASSERT_EQ(frames.size(), 3U);
    const auto angles = bearings(256, 60 * M_PI / 180);
    for (std::size_t n = 0; n < 3; ++n) {
        const auto ping = std::get<ResultV1>(*parse(frames[n]));
        EXPECT_EQ(ping.ping_id, 415323 + n);
        EXPECT_EQ(ping.fire.flags, 0x19);
        EXPECT_NEAR(ping.frequency, 2098880.597, 0.001);
        EXPECT_NEAR(ping.range_resolution, ping.sound_speed / (2 * 75e6 / 286), 1e-9);
        EXPECT_EQ(ping.ranges, std::floor(ping.fire.range / ping.range_resolution));
        ASSERT_EQ(ping.bearings.size(), 256U);
        for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(ping.bearings[i], wire_bearing(angles[i])) << i;
        const auto image = image_of(ping);
        ASSERT_TRUE(image);
        EXPECT_FALSE(image->gain_words);
        EXPECT_EQ(image->row_bytes, 256U);
    }
}

}  // namespace
}  // namespace echoloop::oculus
