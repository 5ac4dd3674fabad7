// Poses between poses: closed forms of interpolation, and what a track says where it knows nothing.
#include "emulator/pose/track.h"

#include <gtest/gtest.h>

namespace echoloop::test {
namespace {

using std::chrono::milliseconds;

Pose at(double x, double yaw_deg) { return {{x, 0, -3}, from_rpy(0, 0, deg_to_rad(yaw_deg))}; }

double yaw_of(const Pose& pose) {
    const Vec3 nose = rotate(pose.orientation, {1, 0, 0});
    return rad_to_deg(std::atan2(nose.y, nose.x));
}

TEST(Slerp, TurnsAtAConstantRateTheShortWay) {
    for (double part : {0.0, 0.25, 0.5, 0.9, 1.0}) {
        EXPECT_NEAR(yaw_of(between(at(0, 10), at(4, 50), part)), 10 + 40 * part, 1e-9);
        EXPECT_NEAR(between(at(0, 10), at(4, 50), part).position.x, 4 * part, 1e-12);
        const double across = yaw_of(between(at(0, 170), at(0, -170), part));
        EXPECT_NEAR(std::remainder(across - (170 + 20 * part), 360), 0, 1e-9);
    }
}

TEST(Slerp, TheSignOfAQuaternionDoesNotMatter) {
    const Quat a = from_rpy(0.1, 0.2, 0.3), b = from_rpy(-0.3, 0.4, 1.2), minus_b{-b.w, -b.x, -b.y, -b.z};
    const Vec3 v{1, 2, 3};
    EXPECT_LT(norm(rotate(slerp(a, b, 0.3), v) - rotate(slerp(a, minus_b, 0.3), v)), 1e-12);
}

TEST(Track, LiesBetweenItsPoses) {
    Track track;
    EXPECT_FALSE(track.at({}));
    track.add(milliseconds(1000), at(0, 0));
    track.add(milliseconds(2000), at(1, 90));
    EXPECT_EQ(track.at({})->pose.position.x, 0);  // before the first
    EXPECT_NEAR(track.at(milliseconds(1500))->pose.position.x, 0.5, 1e-12);
    EXPECT_NEAR(yaw_of(track.at(milliseconds(1500))->pose), 45, 1e-9);
}

TEST(Track, GoesOnForAWhileThenIsWhereItWasLastThenIsStale) {
    Track track({.extrapolation = 1.5, .stale_after = 1});
    track.add({}, at(0, 0));
    track.add(milliseconds(100), at(0.1, 1));
    EXPECT_NEAR(track.at(milliseconds(240))->pose.position.x, 0.24, 1e-9);
    EXPECT_NEAR(yaw_of(track.at(milliseconds(240))->pose), 2.4, 1e-6);
    EXPECT_NEAR(track.at(milliseconds(260))->pose.position.x, 0.1, 1e-9);  // where it was last

    EXPECT_FALSE(track.at(milliseconds(900))->stale);
    EXPECT_TRUE(track.at(milliseconds(1200))->stale);
}

TEST(Track, PosesThatComeSeldomAreNotCarriedOn) {
    Track track({.extrapolation = 1.5, .steady = 0.5});
    track.add({}, at(0, 0));
    track.add(milliseconds(800), at(4, 0));
    EXPECT_EQ(track.at(milliseconds(900))->pose.position.x, 4);
}

TEST(Track, AJumpHasNothingBetweenItsEnds) {
    Track track({.fastest = 20});
    EXPECT_TRUE(track.add({}, at(0, 0)));
    EXPECT_FALSE(track.add(milliseconds(100), at(1000, 0)));
    EXPECT_EQ(track.at(milliseconds(99))->pose.position.x, 0);
    EXPECT_EQ(track.at(milliseconds(150))->pose.position.x, 1000);  // and it does not fly on
}

TEST(Track, TimeThatGoesBackBeginsAnew) {
    Track track;
    track.add(milliseconds(1000), at(5, 0));
    track.add(milliseconds(10), at(7, 0));
    EXPECT_EQ(track.size(), 1U);
    EXPECT_EQ(track.at(milliseconds(2000))->pose.position.x, 7);
}

TEST(Track, ForgetsTheOldest) {
    Track track({.most = 10});
    for (int i = 0; i < 100; ++i) track.add(milliseconds(i), at(i * 1e-3, 0));
    EXPECT_EQ(track.size(), 10U);
    EXPECT_EQ(track.first(), milliseconds(90));
}

}  // namespace
}  // namespace echoloop::test
