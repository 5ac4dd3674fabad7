// What messages of an autopilot tell that is wrong, or not yet right: it is refused, and spoils nothing that
// comes behind it.
#include "emulator/pose/mavlink_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace echoloop {
namespace {

mavlink::Odometry odometry_at(std::uint64_t time_usec) {
    mavlink::Odometry message;
    message.time_usec = time_usec;
    message.frame_id = mavlink::frames::local_enu;
    return message;
}

/// 1e-7 degrees and mm, as on the wire.
mavlink::GlobalPositionInt place(std::int32_t latitude, std::int32_t longitude) {
    mavlink::GlobalPositionInt message;
    message.latitude = latitude;
    message.longitude = longitude;
    message.altitude = -5000;
    return message;
}

constexpr Time now = std::chrono::seconds(100);
constexpr std::int32_t toulon_latitude = 431000000, toulon_longitude = 59000000;

TEST(MavlinkPose, RefusesTimesBeyondAnyClock) {
    MavlinkPose pose;
    EXPECT_TRUE(pose.add(odometry_at(1'700'000'000'000'000), 1, now).message);  // us since 1970
    EXPECT_EQ(pose.add(odometry_at(std::numeric_limits<std::uint64_t>::max()), 1, now).reason,
              "a time that cannot be");
}

TEST(MavlinkPose, SaysWhyItTakesNoPose) {
    MavlinkPose pose;
    auto of_body = odometry_at(1'000'000);
    of_body.frame_id = 12;  // MAV_FRAME_BODY_FRD
    EXPECT_EQ(pose.add(of_body, 1, now).reason.substr(0, 21), "ODOMETRY in frame 12;");
    EXPECT_TRUE(pose.add(odometry_at(1'000'000), 1, now).message) << "what was refused spoils nothing";
    EXPECT_EQ(pose.add(odometry_at(1'100'000), 7, now).reason,
              "system 7 tells poses as well; the vehicle is system 1, which was the first to");
}

TEST(MavlinkPose, APlaceThatIsNoneOnTheGlobeIsNoFirstPlaceEither) {
    MavlinkPose pose;
    mavlink::SimState far_out;
    far_out.latitude = 1e30F;
    far_out.longitude = 6;
    EXPECT_EQ(pose.add(far_out, 1, now).reason, "a position that cannot be");
    EXPECT_EQ(pose.add(place(2'000'000'000, 0), 1, now).reason,
              "a position that cannot be");  // 200 degrees north
    const auto good = pose.add(place(toulon_latitude, toulon_longitude), 1, now);
    ASSERT_TRUE(good.message);
    EXPECT_EQ(*good.message->position, (Vec3{0, 0, -5}));
}

/// As a simulator at 149 degrees east tells it: to 1.4 m in single precision.
mavlink::SimState far_east(std::int32_t longitude) {
    mavlink::SimState message;
    message.latitude = -35.3632621F;
    message.longitude = static_cast<float>(longitude * 1e-7);
    message.exact_latitude = -353632621;
    message.exact_longitude = longitude;
    return message;
}

TEST(MavlinkPose, ASimulatorsPlaceIsAsExactAsItTellsIt) {
    MavlinkPose pose;
    constexpr std::int32_t home = 1491652374;
    ASSERT_TRUE(pose.add(far_east(home), 1, now).message);
    for (int cm = 10; cm < 200; cm += 10) {
        const auto moved =
            pose.add(far_east(home + static_cast<std::int32_t>(std::lround(cm / 0.9092))), 1, now);
        ASSERT_TRUE(moved.message);
        EXPECT_NEAR(moved.message->position->x, cm * 0.01, 0.01);
    }
}

TEST(MavlinkPose, APlaceInRoundedDegreesCountsLessThanAnyOther) {
    MavlinkPose pose;
    auto rounded = far_east(1491652374);
    rounded.exact_latitude = rounded.exact_longitude = 0;
    EXPECT_TRUE(pose.add(rounded, 1, now).message->position) << "better than none";
    EXPECT_TRUE(pose.add(place(-353632621, 1491652374), 1, now).message);
    const auto attitude_only = pose.add(rounded, 1, now);
    ASSERT_TRUE(attitude_only.message);
    EXPECT_FALSE(attitude_only.message->position);
    EXPECT_TRUE(attitude_only.message->attitude);
}

TEST(MavlinkPose, ZeroZeroIsWhatAnAutopilotSaysBeforeItsFirstFix) {
    MavlinkPose pose;
    ASSERT_TRUE(pose.add(place(0, 0), 1, now).message);
    const auto fix = pose.add(place(toulon_latitude, toulon_longitude), 1, now);
    ASSERT_TRUE(fix.message) << fix.reason;
    EXPECT_EQ(*fix.message->position, (Vec3{0, 0, -5}));
    const auto moved = pose.add(place(toulon_latitude + 100, toulon_longitude), 1, now);
    ASSERT_TRUE(moved.message);
    EXPECT_NEAR(moved.message->position->y, 1.11, 0.01);
    EXPECT_EQ(pose.add(place(0, 0), 1, now).reason, "a position that cannot be");  // the fix is lost again
}

TEST(MavlinkPose, PlacesAreInTheWorldWhereItsOriginIsKnown) {
    MavlinkPose pose(GeoPlace{59.4, 10.5, 2});
    const auto fix = pose.add(place(593900000, 105100000), 1, now);
    ASSERT_TRUE(fix.message) << fix.reason;
    // PROJ 9.1, +proj=ortho about the origin; the fix is at an altitude of -5 m.
    EXPECT_NEAR(fix.message->position->x, 568.24015, 1e-4);
    EXPECT_NEAR(fix.message->position->y, -1113.97675, 1e-4);
    EXPECT_NEAR(fix.message->position->z, -7, 1e-9);
    EXPECT_EQ(pose.add(place(0, 0), 1, now).reason, "a position that cannot be") << "no fix yet";
}

TEST(MavlinkPose, WhatHasFallenSilentMakesRoomForLesserMessages) {
    MavlinkPose pose;
    mavlink::LocalPositionNed local;
    local.x = 3;
    ASSERT_TRUE(pose.add(odometry_at(1'000'000), 1, now).message);
    EXPECT_FALSE(pose.add(local, 1, now + std::chrono::seconds(2)).message);
    const auto later = pose.add(local, 1, now + std::chrono::seconds(4));
    ASSERT_TRUE(later.message);
    EXPECT_EQ(later.message->position->y, 3);
    const auto back = pose.add(odometry_at(5'000'000), 1, now + std::chrono::seconds(5));
    ASSERT_TRUE(back.message);
    EXPECT_TRUE(back.message->position) << "the better one counts again at once";
}

TEST(MavlinkPose, AVehicleThatHasFallenSilentMakesRoomForAnother) {
    MavlinkPose pose;
    ASSERT_TRUE(pose.add(odometry_at(1'000'000), 1, now).message);
    EXPECT_FALSE(pose.add(odometry_at(1'000'000), 7, now + std::chrono::seconds(2)).message);
    EXPECT_TRUE(pose.add(odometry_at(1'000'000), 7, now + std::chrono::seconds(4)).message);
    EXPECT_FALSE(pose.add(odometry_at(1'000'000), 1, now + std::chrono::seconds(5)).message);
}

TEST(MavlinkPose, AWorldAroundZeroZeroIsAPlaceLikeAnyOther) {
    MavlinkPose pose;
    ASSERT_TRUE(pose.add(place(0, 0), 1, now).message);
    const auto moved = pose.add(place(0, 1000), 1, now);
    ASSERT_TRUE(moved.message);
    EXPECT_NEAR(moved.message->position->x, 11.13, 0.01);
}

}  // namespace
}  // namespace echoloop
