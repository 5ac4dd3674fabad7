// Packed arrays of a bathymetry packet against closed forms.
#include "protocols/r2sonic/beams.h"

#include <gtest/gtest.h>

#include <cmath>

namespace echoloop::r2sonic {
namespace {

TEST(Beams, EquiAngleRunsFromFirstToLastInEqualSteps) {
    const auto a = angles(A0{.first = -1, .last = 1, .more = {}}, 5);
    EXPECT_EQ(a, (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
    EXPECT_EQ(angles(A0{.first = 0.25, .last = 1, .more = {}}, 1), (std::vector<double>{0.25}));
    EXPECT_TRUE(angles(A0{}, 0).empty());
}

TEST(Beams, EquiDistantSumsTheStepsIncludingItsOwn) {
    const A2 a2{.first = -1, .scale = 0.5, .more = {}, .step = {0, 1, 3}};
    EXPECT_EQ(angles(a2), (std::vector<double>{-1, -0.5, 1}));
}

TEST(Beams, TheSumOfStepsIs32Bit) {
    const A2 a2{.first = 0, .scale = 1, .more = {}, .step = {0, 65535, 65535}};
    EXPECT_EQ(angles(a2)[2], 131070);
}

TEST(Beams, PackedAnglesFollowTheGivenOnesToHalfAStep) {
    std::vector<double> given;
    for (int n = 0; n < 256; ++n) given.push_back(std::atan((n - 127.5) / 80));
    const A2 a2 = pack_angles(given);
    const auto got = angles(a2);
    ASSERT_EQ(got.size(), given.size());
    EXPECT_EQ(a2.step[0], 0);
    for (std::size_t n = 0; n < given.size(); ++n) EXPECT_NEAR(got[n], given[n], 0.51 * a2.scale) << n;
}

// 20859 to 20861 in every one of 923 real pings.
TEST(Beams, TheLargestStepIs65535OverPi) {
    for (const double depth : {40.0, 80.0, 300.0}) {
        std::vector<double> given;
        for (int n = 0; n < 256; ++n) given.push_back(std::atan((n - 127.5) / depth) + 0.01 * depth / 300);
        const A2 a2 = pack_angles(given);
        EXPECT_NEAR(*std::max_element(a2.step.begin(), a2.step.end()), 20860, 1) << depth;
    }
}

TEST(Beams, PackingNoOneOrEqualAnglesDividesByNothing) {
    EXPECT_TRUE(pack_angles({}).step.empty());
    const std::vector<double> same{0.5, 0.5};
    EXPECT_EQ(angles(pack_angles(same)), (std::vector<double>{0.5, 0.5}));
}

TEST(Beams, PackedTimesAreRoundedAndHeldInRange) {
    const std::vector<double> seconds{0, 0.0024, 0.0026, 1e9, -1, std::nan("")};
    EXPECT_EQ(pack_times(seconds, 0.001F).r, (std::vector<std::uint16_t>{0, 2, 3, 65535, 0, 0}));
    const auto times = two_way_times(R0{.scale = 0.5, .r = {4}});
    EXPECT_EQ(times[0], 2.0);
}

TEST(Beams, QualityOfPointZeroIsTheTopNibble) {
    const std::vector<std::uint8_t> nibbles{0xB, 7, 0, 0, 0, 0, 0, 1, 0xF};
    const Q0 q0 = pack_quality(nibbles);
    EXPECT_EQ(q0.flags, (std::vector<std::uint32_t>{0xB7000001, 0xF0000000}));
    for (std::size_t point = 0; point < nibbles.size(); ++point)
        EXPECT_EQ(quality_of(q0, point), nibbles[point]);
    EXPECT_EQ(quality_of(q0, 16), 0);
}

}  // namespace
}  // namespace echoloop::r2sonic
