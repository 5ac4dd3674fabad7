// Speckle of a fan that looks straight down: what its way along the track leaves of it.
#include <gtest/gtest.h>

#include <cmath>

#include "render/acoustics/chain.h"
#include "render/acoustics/pattern.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

/// Of intensities at two places, the mean over beams, bins and beginnings.
double left_after(double way, Vec3 along) {
    Shot shot = test::fan(60, 1, 61, 400, 100);
    shot.beam_width = deg_to_rad(0.5);
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.vertical = {ApertureShape::line, 1};
    shot.frequency = 400e3;
    shot.receiver.bins = BinRule::sample;
    const double aperture = TwoWayPattern(shot.vertical, shot.fan_height).aperture().length_in_wavelengths() *
                            1500 / shot.frequency;
    const Quat down = axis_angle({0, 1, 0}, std::numbers::pi / 2);
    AcousticChain chain(Effects::none().set(Effect::pulse).set(Effect::speckle));
    const auto at = [&](Vec3 place) {
        std::vector<float> values(shot.bearings.size() * shot.bins, 1.0F);
        chain.apply(shot, {place, down}, 1500, {}, values);
        return values;
    };
    double sum = 0, squares = 0, both = 0, count = 0;
    for (int begin = 0; begin < 12; ++begin) {
        const Vec3 place{1.7 * begin, -0.9 * begin, 0};
        const auto here = at(place), there = at(place + way * aperture * along);
        for (std::size_t i = 0; i < here.size(); ++i, ++count) {
            sum += here[i], squares += here[i] * here[i], both += here[i] * there[i];
        }
    }
    const double mean = sum / count;
    return (both / count - mean * mean) / (squares / count - mean * mean);
}

// The fan is a plain line along its track and heard one way: transform of the squared pattern at 2 x /
// lambda, as V30 has it.
TEST(SpeckleBelow, MovesByTheApertureAlongTheTrack) {
    EXPECT_NEAR(left_after(0.1, {1, 0, 0}), 0.643, 0.07);
    EXPECT_NEAR(left_after(0.25, {1, 0, 0}), 0.251, 0.07);
    EXPECT_LT(left_after(0.6, {1, 0, 0}), 0.1);
    EXPECT_NEAR(left_after(0.1, {0.6, 0.8, 0}), 0.643, 0.07) << "whichever way the track leads";
    EXPECT_GT(left_after(0.0005, {1, 0, 0}), 0.97);
}

}  // namespace
}  // namespace echoloop
