// Every message survives a round trip, and no part or extension of it is taken for one.
#include "tests/protocols/arbitrary.h"

#include "protocols/r2sonic/codec.h"
#include "protocols/seanet/codec.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop {
namespace {

template <class M>
class SeanetMessage : public ::testing::Test {};
TYPED_TEST_SUITE(SeanetMessage, SeanetTypes);

TYPED_TEST(SeanetMessage, SurvivesARoundTripThroughAFrame) {
    EXPECT_TRUE(rc::check([] {
        const auto message = arbitrary<TypeParam>();
        // Node 20 is the profiler's, whose messages have other tables.
        const auto node = *rc::gen::distinctFrom(rc::gen::arbitrary<std::uint8_t>(), seanet::nodes::profiler);
        const wire::Bytes bytes = seanet::encode(seanet::Message(message), {.sonar_node = node});
        const auto frame = wire::parse<seanet::Frame>(bytes);
        RC_ASSERT(frame.has_value());
        const auto parsed = seanet::parse(*frame);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::holds_alternative<TypeParam>(*parsed));
        RC_ASSERT(std::get<TypeParam>(*parsed) == message);
        RC_ASSERT(seanet::encode(*frame) == bytes);
    }));
}

TYPED_TEST(SeanetMessage, EveryTruncationAndExtensionOfThePayloadIsRejected) {
    EXPECT_TRUE(rc::check([] {
        const auto frame = seanet::make_frame(seanet::Message(arbitrary<TypeParam>()));
        for (std::size_t size = 0; size < frame.payload.size(); ++size) {
            // The older form of BBUserData is a true prefix of the newer one.
            if (frame.header.id == seanet::Id::bb_user_data && size == 175 - 14) continue;
            auto cut = frame;
            cut.payload.resize(size);
            RC_ASSERT(!seanet::parse(cut));
        }
        auto longer = frame;
        longer.payload.push_back(0);
        const auto parsed = seanet::parse(longer);
        RC_ASSERT(!parsed);
    }));
}

TYPED_TEST(SeanetMessage, EveryTruncationAndExtensionOfTheFrameIsRejected) {
    EXPECT_TRUE(rc::check([] {
        wire::Bytes bytes = seanet::encode(seanet::Message(arbitrary<TypeParam>()));
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            RC_ASSERT(!wire::parse<seanet::Frame>(wire::ByteView(bytes).first(size)));
        }
        bytes.push_back('\n');
        RC_ASSERT(!wire::parse<seanet::Frame>(bytes));
    }));
}

template <class P>
class R2SonicPacket : public ::testing::Test {};
TYPED_TEST_SUITE(R2SonicPacket, R2SonicTypes);

TYPED_TEST(R2SonicPacket, SurvivesARoundTrip) {
    EXPECT_TRUE(rc::check([] {
        const auto packet = arbitrary<TypeParam>();
        const wire::Bytes bytes = r2sonic::serialise(packet);
        const auto parsed = r2sonic::parse(bytes);
        RC_ASSERT(parsed.has_value());
        RC_ASSERT(std::holds_alternative<TypeParam>(*parsed));
        RC_ASSERT(std::get<TypeParam>(*parsed) == packet);
        RC_ASSERT(r2sonic::serialise(*parsed) == bytes);
    }));
}

TYPED_TEST(R2SonicPacket, EveryTruncationAndExtensionIsRejected) {
    // A CMD0 has no count: fewer commands, or one more, are a CMD0 as well.
    const bool open_ended = std::is_same_v<TypeParam, r2sonic::Cmd0>;
    EXPECT_TRUE(rc::check([&] {
        wire::Bytes bytes = r2sonic::serialise(arbitrary<TypeParam>());
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            if (open_ended && size % 8 == 4) continue;
            RC_ASSERT(!r2sonic::parse(wire::ByteView(bytes).first(size)));
        }
        for (int extra = 1; extra < 8; ++extra) {
            bytes.push_back(0);
            RC_ASSERT(!r2sonic::parse(bytes));
        }
    }));
}

TEST(R2SonicPacket, ATruncationWithACorrectedPacketSizeIsStillRejected) {
    EXPECT_TRUE(rc::check([] {
        const wire::Bytes bytes = r2sonic::serialise(arbitrary<r2sonic::Bth0>());
        for (std::size_t size = 8; size < bytes.size(); ++size) {
            wire::Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
            wire::store<wire::ByteOrder::big>(static_cast<std::uint32_t>(size), cut.data() + 4);
            RC_ASSERT(!r2sonic::parse(cut));
        }
    }));
}

TEST(R2SonicPacket, NonFiniteFloatsKeepTheirBits) {
    for (const std::uint32_t bits : {0x7F800000U, 0xFF800000U, 0x7FC00001U, 0xFFC12345U, 0x80000000U}) {
        r2sonic::Bth0 packet;
        packet.r0.scale = std::bit_cast<float>(bits);
        const auto parsed = r2sonic::parse(r2sonic::serialise(packet));
        ASSERT_TRUE(parsed);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(std::get<r2sonic::Bth0>(*parsed).r0.scale), bits);
    }
}

}  // namespace
}  // namespace echoloop
