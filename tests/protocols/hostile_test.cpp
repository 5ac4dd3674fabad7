// Bytes that lie: counts, sizes, sections and constants. Each is refused with its place, and nothing big is
// allocated.
#include <gtest/gtest.h>

#include "protocols/inspect.h"
#include "protocols/r2sonic/codec.h"
#include "protocols/seanet/codec.h"
#include "protocols/seanet/layouts.h"
#include "protocols/wire/read.h"
#include "tests/protocols/allocations.h"
#include "tests/protocols/arbitrary.h"
#include "tests/protocols/data.h"

namespace echoloop {
namespace {

using wire::Error;
using wire::Reason;

void put(wire::Bytes& bytes, std::size_t at, std::initializer_list<std::uint8_t> values) {
    std::copy(values.begin(), values.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

r2sonic::Bth0 small_bathymetry() {
    r2sonic::Bth0 packet;
    packet.r0.r.resize(8);
    packet.q0.flags.resize(1);
    return packet;
}

TEST(Hostile, HeadDataCountsMustAgreeWithEachOtherAndWithTheBytes) {
    auto frame = seanet::make_frame(seanet::HeadData{.bins = wire::Bytes(4)});
    frame.payload[29] = 5;  // Dbytes, byte 42
    EXPECT_EQ(seanet::parse(frame).error(), (Error{"HeadData", "data_bytes", 42, Reason::wrong_count}));
    frame.payload[0] = 36;  // now the total count agrees, but the fifth bin is not there
    EXPECT_EQ(seanet::parse(frame).error(), (Error{"HeadData", "bins", 44, Reason::truncated}));
    frame.payload[0] = 30;  // less than the 31 that it always counts
    EXPECT_EQ(seanet::parse(frame).error(), (Error{"HeadData", "total_count", 13, Reason::wrong_count}));
}

TEST(Hostile, UnknownIdsAndTypesAreSaidToBeSo) {
    seanet::Frame frame;
    frame.header.id = static_cast<seanet::Id>(200);
    EXPECT_EQ(seanet::parse(frame).error(), (Error{"Frame", "id", 10, Reason::unknown_message}));
    frame.header.id = seanet::Id::head_command;
    EXPECT_EQ(seanet::parse(frame).error(), (Error{"HeadCommand", "type", 13, Reason::truncated}));
    frame.payload = {0x77};
    EXPECT_EQ(seanet::parse(frame).error(), (Error{"HeadCommand", "type", 13, Reason::unknown_message}));
}

TEST(Hostile, ErrorsSayMessageFieldAndByte) {
    auto frame = seanet::make_frame(seanet::Alive{});
    frame.payload.resize(6);
    EXPECT_EQ(seanet::parse(frame).error().what(), "Alive.motor_position at byte 18: the bytes end here");
}

TEST(Hostile, ALyingPointCountIsRefusedAtTheFirstArray) {
    wire::Bytes bytes = r2sonic::serialise(small_bathymetry());
    put(bytes, 12 + 114, {0xFF, 0xFF});
    largest_allocation = 0;
    const auto packet = r2sonic::parse(bytes);
    EXPECT_LT(largest_allocation, 4096U);
    EXPECT_EQ(packet.error(), (Error{"R0", "r", 136, Reason::truncated}));
}

TEST(Hostile, ALyingProductOfCountsIsRefusedWithoutAllocation) {
    wire::Bytes bytes = r2sonic::serialise(r2sonic::Aid0Data{});
    put(bytes, 12 + 24, {0xFF, 0xFF});
    put(bytes, 12 + 30, {0xFF, 0xFF});
    largest_allocation = 0;
    const auto packet = r2sonic::parse(bytes);
    EXPECT_LT(largest_allocation, 4096U);
    EXPECT_EQ(packet.error(), (Error{"M0", "data", 48, Reason::truncated}));
}

TEST(Hostile, ALyingStatusSectionIsRefused) {
    const wire::Bytes bytes = from_hex("53544830 00000010 00000000 5858585A");  // XXXZ announces 35 words
    EXPECT_EQ(r2sonic::parse(bytes).error(), (Error{"STH0", "words", 16, Reason::truncated}));
    const wire::Bytes none = from_hex("53544830 00000014 00000000 58585830 00000000");  // XXX0 announces none
    EXPECT_FALSE(r2sonic::parse(none));
}

TEST(Hostile, SectionSizesMustBeTrue) {
    const wire::Bytes good = r2sonic::serialise(small_bathymetry());
    for (const int size : {0, 3, 4, 112, 115, 117, 120, 255}) {
        wire::Bytes bad = good;
        bad[15] = static_cast<std::uint8_t>(size);  // of H0
        EXPECT_FALSE(r2sonic::parse(bad)) << size;
    }
}

TEST(Hostile, PaddingMustBeZero) {
    auto packet = small_bathymetry();
    packet.r0.r.resize(7);
    wire::Bytes bytes = r2sonic::serialise(packet);
    ASSERT_TRUE(r2sonic::parse(bytes));
    bytes[128 + 8 + 14] = 1;
    EXPECT_EQ(r2sonic::parse(bytes).error(), (Error{"R0", "padding", 150, Reason::wrong_constant}));
}

TEST(Hostile, PacketSizeMustBeTheSizeOfTheDatagram) {
    wire::Bytes bytes = r2sonic::serialise(small_bathymetry());
    ++bytes[7];
    EXPECT_EQ(r2sonic::parse(bytes).error().reason, Reason::truncated);
    bytes[7] = static_cast<std::uint8_t>(bytes[7] - 2);
    EXPECT_EQ(r2sonic::parse(bytes).error().reason, Reason::trailing_bytes);
}

TEST(Hostile, SectionsInAnotherOrderAreRefused) {
    wire::Bytes bytes = r2sonic::serialise(small_bathymetry());
    bytes[128] = 'Q';
    EXPECT_EQ(r2sonic::parse(bytes).error(), (Error{"BTH0", "r0", 128, Reason::wrong_section}));
    bytes[128] = 'R';
    bytes[153] = '9';  // A0 becomes A9
    EXPECT_EQ(r2sonic::parse(bytes).error(), (Error{"BTH0", "angles", 152, Reason::wrong_section}));
}

TEST(Hostile, NoDatagramAndForeignDatagramsAreRefused) {
    EXPECT_EQ(r2sonic::parse({}).error().reason, Reason::truncated);
    EXPECT_EQ(r2sonic::parse(from_hex("42 54 48")).error().reason, Reason::truncated);
    EXPECT_EQ(r2sonic::parse(from_hex("48545450 2F312E31")).error().reason, Reason::unknown_message);
}

TEST(Hostile, RandomBytesNeverDoMoreThanBeRefusedOrParse) {
    EXPECT_TRUE(rc::check([] {
        auto bytes = *rc::gen::arbitrary<wire::Bytes>();
        const auto names = {"BTH0", "AID0", "STH0", "STS0", "R2DS", "R2DD", "R2DI", "R2DC", "CMD0", "@0010"};
        const std::string name = *rc::gen::elementOf(std::vector<std::string>(names.begin(), names.end()));
        bytes.insert(bytes.begin(), name.begin(), name.end());
        for (const auto& family : inspect::families()) {
            std::size_t covered = 0;
            for (const auto& message : family.decode(bytes)) {
                RC_ASSERT(message.offset == covered);
                covered += message.size;
            }
            RC_ASSERT(covered == bytes.size());
        }
    }));
}

TEST(Hostile, FlippedBytesOfGoodDatagramsNeverCrash) {
    EXPECT_TRUE(rc::check([] {
        wire::Bytes bytes = r2sonic::serialise(arbitrary<r2sonic::Bth0>());
        for (int i = 0; i < 3; ++i) {
            bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] = *rc::gen::arbitrary<std::uint8_t>();
        }
        const auto packet = r2sonic::parse(bytes);
        if (!packet) return;
        // Sections that nobody knows are left out; what is left is a packet that comes back as it is.
        const wire::Bytes once = r2sonic::serialise(*packet);
        RC_ASSERT(once.size() <= bytes.size());
        const auto again = r2sonic::parse(once);
        RC_ASSERT(again.has_value());
        RC_ASSERT(r2sonic::serialise(*again) == once);
    }));
}

TEST(Hostile, AnArrayThatContradictsTheOthersIsCutOrFilledWhenWritten) {
    auto packet = small_bathymetry();
    packet.i1 = r2sonic::I1{.intensity = {1, 2, 3}};
    packet.angles = r2sonic::A2{.step = std::vector<std::uint16_t>(20, 5)};
    const auto back = r2sonic::parse(r2sonic::serialise(packet));
    ASSERT_TRUE(back) << back.error().what();
    const auto& got = std::get<r2sonic::Bth0>(*back);
    EXPECT_EQ(got.h0.points, 8);
    EXPECT_EQ(got.i1->intensity, (std::vector<std::uint16_t>{1, 2, 3, 0, 0, 0, 0, 0}));
    EXPECT_EQ(std::get<r2sonic::A2>(got.angles).step.size(), 8U);
}

TEST(Hostile, MoreBinsThanTheCountsCanSayAreCut) {
    const auto frame = seanet::make_frame(seanet::HeadData{.bins = wire::Bytes(70000, 7)});
    const auto message = seanet::parse(frame);
    ASSERT_TRUE(message) << message.error().what();
    EXPECT_EQ(std::get<seanet::HeadData>(*message).bins.size(), 65535U - 31);
}

}  // namespace
}  // namespace echoloop
