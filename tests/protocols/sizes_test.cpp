// The sizes that the specifications print, against the tables.
#include <gtest/gtest.h>

#include "protocols/r2sonic/codec.h"
#include "protocols/r2sonic/layouts.h"
#include "protocols/seanet/codec.h"
#include "protocols/seanet/layouts.h"

namespace echoloop {
namespace {

using wire::fixed_size;

// SeaNet: total bytes of the frame, of which 14 are header and LF.
template <class M>
constexpr std::size_t frame_size = *fixed_size<M>() + 14;

static_assert(frame_size<seanet::ReBoot> == 14 && frame_size<seanet::SendVersion> == 14);
static_assert(frame_size<seanet::SendBBUser> == 14 && frame_size<seanet::StopAlives> == 14);
static_assert(frame_size<seanet::SendData> == 18);
static_assert(frame_size<seanet::HeadCommand> == 66);
static_assert(frame_size<seanet::HeadCommandDual> == 82);
static_assert(frame_size<seanet::HeadCommandGain> == 31);
static_assert(frame_size<seanet::HeadCommandReverse> == 15);
static_assert(frame_size<seanet::Alive> == 22);
static_assert(frame_size<seanet::VersionData> == 25);
static_assert(frame_size<seanet::FpgaCalData> == 80);
static_assert(frame_size<seanet::FpgaVersionData> == 28);
static_assert(!fixed_size<seanet::BBUserData>() && !fixed_size<seanet::HeadData>());

// R2Sonic: bodies of sections without their 4-byte headers, whole datagrams of discovery.
static_assert(fixed_size<r2sonic::H0>() == 116 - 4);
static_assert(fixed_size<r2sonic::A0>() == 36 - 4);
static_assert(fixed_size<r2sonic::G0>() == 16 - 4);
static_assert(fixed_size<r2sonic::R2ds>() == 24);
static_assert(fixed_size<r2sonic::R2dd>() == 44);
static_assert(fixed_size<r2sonic::R2di>() == 72);
static_assert(fixed_size<r2sonic::R2dc>() == 164);
static_assert(fixed_size<r2sonic::Command>() == 8);

struct SeanetSize {
    seanet::Message message;
    std::size_t total;
    const char* ascii;
    std::uint8_t byte9;
};

class SeanetSizes : public ::testing::TestWithParam<SeanetSize> {};

TEST_P(SeanetSizes, FrameLengthAndByte9AreThoseOfTheTable) {
    const wire::Bytes bytes = seanet::encode(GetParam().message);
    ASSERT_EQ(bytes.size(), GetParam().total);
    EXPECT_EQ(std::string(bytes.begin() + 1, bytes.begin() + 5), GetParam().ascii);
    EXPECT_EQ(bytes[5] + 256 * bytes[6] + 6, static_cast<int>(GetParam().total));
    EXPECT_EQ(bytes[9], GetParam().byte9);
    EXPECT_EQ(bytes.back(), '\n');
}

INSTANTIATE_TEST_SUITE_P(Specification, SeanetSizes,
                         ::testing::Values(SeanetSize{seanet::ReBoot{}, 14, "0008", 0x03},
                                           SeanetSize{seanet::SendData{}, 18, "000C", 0x07},
                                           SeanetSize{seanet::HeadCommand{}, 66, "003C", 0x37},
                                           SeanetSize{seanet::HeadCommandDual{}, 82, "004C", 0x47},
                                           SeanetSize{seanet::HeadCommandGain{}, 31, "0019", 0x14},
                                           SeanetSize{seanet::HeadCommandReverse{}, 15, "0009", 0x04},
                                           SeanetSize{seanet::Alive{}, 22, "0010", 0x0B},
                                           SeanetSize{seanet::VersionData{}, 25, "0013", 0x0E},
                                           SeanetSize{seanet::BBUserData{}, 264, "0102", 0xFD},
                                           SeanetSize{seanet::FpgaCalData{}, 80, "004A", 0x45},
                                           SeanetSize{seanet::FpgaVersionData{}, 28, "0016", 0x11},
                                           SeanetSize{seanet::HeadData{.bins = wire::Bytes(4)}, 49, "002B",
                                                      0x00},
                                           SeanetSize{seanet::AuxData{wire::Bytes(6)}, 22, "0010", 0x0B},
                                           SeanetSize{seanet::ProfilerCommand{}, 82, "004C", 0x47},
                                           SeanetSize{seanet::ProfilerGainCommand{}, 31, "0019", 0x14}));

TEST(SeanetSizes, Byte9OfHeadDataCanBeTheLowByteOfLengthMinus5) {
    const seanet::Message line = seanet::HeadData{.bins = wire::Bytes(400)};
    const auto bytes = seanet::encode(line, {.head_data_remaining = seanet::HeadDataRemaining::low_byte});
    EXPECT_EQ(bytes[9], 0xB2);  // 400 + 39 - 5 = 434, the value that the specification reports
    EXPECT_EQ(seanet::encode(line)[9], 0);
}

TEST(SeanetSizes, OlderBBUserDataOf175BytesIsLegal) {
    seanet::BBUserData older;
    older.rest.resize(27);
    const auto frame = seanet::make_frame(older);
    EXPECT_EQ(seanet::encode(frame).size(), 175U);
    ASSERT_TRUE(seanet::parse(frame));
    for (const std::size_t wrong : {26U, 28U, 115U, 117U}) {
        auto bad = frame;
        bad.payload.resize(frame.payload.size() - 27 + wrong);
        EXPECT_FALSE(seanet::parse(bad)) << wrong;
    }
}

r2sonic::Bth0 bathymetry(std::size_t points, bool equi_distant, bool intensities) {
    r2sonic::Bth0 packet;
    packet.r0.r.resize(points);
    if (equi_distant) packet.angles = r2sonic::A2{.step = std::vector<std::uint16_t>(points)};
    if (intensities) packet.i1 = r2sonic::I1{.intensity = std::vector<std::uint16_t>(points)};
    packet.q0.flags.resize((points + 7) / 8);
    return packet;
}

TEST(R2SonicSizes, DatagramsOf256PointsAreThoseOfTheSpecification) {
    EXPECT_EQ(r2sonic::serialise(bathymetry(256, true, true)).size(), 1864U);
    EXPECT_EQ(r2sonic::serialise(bathymetry(256, false, true)).size(), 1352U);
    EXPECT_EQ(r2sonic::serialise(bathymetry(256, true, false)).size(), 1864U - 520U);
    auto verbose = bathymetry(256, true, true);
    verbose.g1 = r2sonic::G1{.gate = std::vector<r2sonic::Gate>(256)};
    EXPECT_EQ(r2sonic::serialise(verbose).size(), 1864U + 520U);
}

TEST(R2SonicSizes, SectionsOfTheBigDatagramStandWhereTheSpecificationSaysAndAreZeroPaddedOtherwise) {
    const auto bytes = r2sonic::serialise(bathymetry(256, true, true));
    const auto tag = [&](std::size_t at) { return std::string(bytes.begin() + at, bytes.begin() + at + 2); };
    EXPECT_EQ(tag(12) + tag(128) + tag(648) + tag(1196) + tag(1716) + tag(1732), "H0R0A2I1G0Q0");
    const auto odd = bathymetry(3, false, false);
    const auto padded = r2sonic::serialise(odd);
    EXPECT_EQ(padded[128 + 3], 16);  // R0: 4 + 4 + 3 * 2, padded to 16
    EXPECT_EQ(padded.size(), 12U + 116 + 16 + 36 + 16 + 8);
}

TEST(R2SonicSizes, AGoodImagePackingIs1328Bytes) {
    r2sonic::Aid0Data part;
    part.m0.beams = 256;
    part.m0.bins = 5;
    part.m0.data.resize(1280);
    EXPECT_EQ(r2sonic::serialise(part).size(), 1328U);
}

TEST(R2SonicSizes, CommandDatagramsHaveTheLengthsSeen) {
    EXPECT_EQ(r2sonic::serialise(r2sonic::Cmd0{std::vector<r2sonic::Command>(32)}).size(), 260U);
    EXPECT_EQ(r2sonic::serialise(r2sonic::Cmd0{std::vector<r2sonic::Command>(44)}).size(), 356U);
}

}  // namespace
}  // namespace echoloop
