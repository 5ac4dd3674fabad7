// What side lobes may bring to a fan's beams comes from every beam of it.
#include "emulator/devices/family/multibeam/ring.h"

#include <gtest/gtest.h>

#include "tests/emulator/devices/seabed_echo.h"

namespace echoloop::test {
namespace {

using multibeam::SideLobes;

/// A fan of so many beams, of which one hears `power` uPa^2 in bin 7.
Echogram one_beam_hears(std::size_t beams, std::size_t beam, float power) {
    Echogram echogram;
    echogram.shot = wide_fan(30);
    echogram.shot.bearings.resize(beams);
    echogram.values.assign(beams * echogram.shot.bins, 0.0F);
    echogram.values[beam * echogram.shot.bins + 7] = power;
    return echogram;
}

TEST(MultibeamRing, HearsEveryBeamAlike) {
    constexpr std::size_t beams = 6;  // more than are added at once, and some beside
    const SideLobes first(one_beam_hears(beams, 0, 1));
    ASSERT_GT(first.likely()[7], 0);
    ASSERT_GT(first.possible()[7], first.likely()[7]);
    Echogram all = one_beam_hears(beams, 0, 1);
    for (std::size_t beam = 1; beam < beams; ++beam) {
        const SideLobes other(one_beam_hears(beams, beam, 1));
        EXPECT_EQ(other.likely()[7], first.likely()[7]) << beam;
        EXPECT_EQ(other.possible()[7], first.possible()[7]) << beam;
        EXPECT_EQ(other.likely()[6], 0);
        all.values[beam * all.shot.bins + 7] = 1;
    }
    EXPECT_FLOAT_EQ(SideLobes(all).likely()[7], beams * first.likely()[7]);
}

}  // namespace
}  // namespace echoloop::test
