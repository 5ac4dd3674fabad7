// How fast bodies move: as their source tells, or by their poses; without steps, and nothing at rest.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "emulator/pose/mavlink_pose.h"
#include "emulator/pose/mount.h"
#include "emulator/pose/trajectory_file.h"
#include "emulator/pose/whereabouts.h"

namespace echoloop {
namespace {

using namespace std::chrono_literals;

void expect_near(Vec3 a, Vec3 b, double off = 1e-9) {
    EXPECT_LT(norm(a - b), off) << a.x << ' ' << a.y << ' ' << a.z;
}

PoseMessage pose(Vec3 position, double yaw = 0) { return {{}, position, from_rpy(0, 0, yaw)}; }

TEST(MotionOfATrajectory, IsThatOfItsStretches) {
    const Track track = parse_trajectory(
        "0 0 0 -3 0 0 0 1\n10 5 0 -3 0 0 0.70710678118654752 0.70710678118654752\n20 5 20 -3 0 0 "
        "0.70710678118654752 0.70710678118654752\n",
        "way");
    expect_near(track.motion(5s).velocity, {0.5, 0, 0});
    expect_near(track.motion(5s).turning, {0, 0, std::numbers::pi / 20});
    expect_near(track.motion(0s).velocity, {0.5, 0, 0});
    expect_near(track.motion(15s).velocity, {0, 2, 0});
    EXPECT_EQ(track.motion(15s).turning, Vec3{});
    EXPECT_EQ(track.motion(21s), Motion{}) << "after the last row it rests";
    expect_near(track.motion(10s).velocity, {0.25, 1, 0}, 1e-6);  // a corner is no step
    for (Time t = 9800ms; t < 10200ms; t += 1ms)
        EXPECT_LT(norm(track.motion(t + 1ms).velocity - track.motion(t).velocity), 0.025);
}

/// Poses of a body that goes by `way` come every `interval`, each told at its time; returns how it is thought
/// to move each millisecond.
std::vector<Motion> listened(Time interval, Time end, const std::function<PoseMessage(double)>& way) {
    Whereabouts where({}, false);
    std::vector<Motion> out;
    for (Time t{}; t < end; t += 1ms) {
        if (t % interval == 0ns) where.tell(t, way(to_seconds(t)));
        out.push_back(where.motion(t));
    }
    return out;
}

TEST(MotionOfAnInput, HasNoStepsAndLagsByTwoIntervalsAtMost) {
    // 2 m to both sides in 6 s: 2.1 m/s, and 2.2 m/s^2 at most.
    const double pace = 2 * std::numbers::pi / 6;
    for (const Time interval : {10ms, 50ms, 200ms}) {
        const auto heard = listened(interval, 12s, [&](double t) {
            return pose({2 * std::sin(pace * t), 0, -3}, 0.5 * std::sin(pace * t));
        });
        const double lag = to_seconds(interval) + std::max(0.1, to_seconds(interval)) / 2,
                     most = 2 * pace * pace;
        for (std::size_t i = 2000; i < heard.size(); ++i) {
            const double t = static_cast<double>(i) * 1e-3;
            EXPECT_NEAR(heard[i].velocity.x, 2 * pace * std::cos(pace * (t - lag)), 0.02) << i;
            EXPECT_NEAR(heard[i].turning.z, 0.5 * pace * std::cos(pace * (t - lag)), 0.01) << i;
            EXPECT_LT(std::abs(heard[i].velocity.x - heard[i - 1].velocity.x), 1.5 * most * 1e-3) << i;
        }
    }
}

TEST(MotionOfAnInput, KnowsNothingAcrossAJump) {
    const auto heard = listened(20ms, 2s, [](double t) { return pose({0.3 * t + (t >= 1 ? 50 : 0), 0, 0}); });
    for (std::size_t i = 200; i < heard.size(); ++i) {
        EXPECT_LT(norm(heard[i].velocity), 0.3 + 1e-6) << i;
        if (i < 1000 || i >= 1200) {
            EXPECT_NEAR(heard[i].velocity.x, 0.3, 1e-6) << i;
        }
    }
}

TEST(MotionOfAnInput, IsNothingAtRestAndWhenPosesEnd) {
    for (const Motion& motion : listened(30ms, 1s, [](double) { return pose({1.1, -2.3, -3.7}, 0.7); }))
        EXPECT_EQ(motion, Motion{});
    Whereabouts where({}, false);
    for (Time t{}; t <= 1s; t += 20ms) where.tell(t, pose({to_seconds(t), 0, 0}));
    expect_near(where.motion(1010ms).velocity, {1, 0, 0}, 1e-6);
    EXPECT_EQ(where.motion(1500ms), Motion{});
}

TEST(MotionOfAnInput, IsWhatIsToldForASecond) {
    Whereabouts where({}, false);
    PoseMessage told = pose({});
    told.velocity = {1, 2, 3}, told.turning = {0.1, 0.2, 0.3};
    where.tell(1s, told);
    EXPECT_EQ(where.motion(1s).velocity, (Vec3{1, 2, 3}));
    EXPECT_EQ(where.motion(1900ms).turning, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(where.motion(2100ms), Motion{});
    EXPECT_EQ(where.motion(900ms), Motion{});
}

TEST(MotionOfAnInput, AVelocityThatNobodyFilledInTellsNothing) {
    const auto heard = listened(20ms, 1s, [](double t) {
        PoseMessage told = pose({t, 0, 0});
        told.velocity = Vec3{}, told.turning = Vec3{};
        return told;
    });
    expect_near(heard.back().velocity, {1, 0, 0}, 1e-6);
}

TEST(MotionInStep, IsThatOfTheStepsSoFar) {
    Whereabouts where({}, true);
    Time now{};
    const auto step = [&](double x) {
        where.tell_with_next_step(pose({x, 0, 0}));
        where.step(now, now + 50ms);
        now += 50ms;
    };
    for (int i = 0; i < 20; ++i) step(0.01 * i);
    expect_near(where.motion(now).velocity, {0.2, 0, 0}, 1e-6);
    expect_near(where.motion(now - 30ms).velocity, {0.2, 0, 0}, 1e-6);
    where.step(now, now + 1s);  // nothing told: it has not moved
    EXPECT_EQ(where.motion(now + 1s), Motion{});
}

TEST(MotionOfAMount, SwingsByItsLaw) {
    asio::io_context io;
    RealClock clock{io, 1, std::nullopt};
    ScenarioDevice device;
    device.mount_swing = {MountSwing::Axis::pitch, deg_to_rad(20), 4};
    const Mount mount({}, device, clock, nullptr);
    for (const double t : {0.0, 0.3, 1.7}) {
        const Motion motion = mount.motion(from_seconds(t));
        const Motion by_poses = motion_between(mount.body_from_sonar(from_seconds(t)),
                                               mount.body_from_sonar(from_seconds(t + 1e-4)), 1e-4);
        expect_near(motion.turning, by_poses.turning, 1e-4);
        EXPECT_EQ(motion.velocity, Vec3{});
    }
}

/// Against what two poses a tenth of a millisecond apart say.
TEST(MotionTogether, HasTheLeverArmInIt) {
    const Motion body{{1, -0.5, 0.2}, {0.1, -0.2, 0.5}}, mount{{0, 0, 0.3}, {0, 0.4, 0}};
    const Pose world_from_body{{3, 4, -5}, from_rpy(0.1, 0.2, 1.3)},
        body_from_sonar{{2, 0.5, -0.3}, from_rpy(0.3, 0.9, -0.4)};
    const auto later = [](const Pose& pose, const Motion& motion, double t) {
        const double turned = norm(motion.turning) * t;
        return Pose{pose.position + t * motion.velocity,
                    pose.orientation * axis_angle(1 / norm(motion.turning) * motion.turning, turned)};
    };
    constexpr double t = 1e-5;
    const Motion found = together(world_from_body, body, body_from_sonar, mount);
    const Motion by_poses =
        motion_between(world_from_body * body_from_sonar,
                       later(world_from_body, body, t) * later(body_from_sonar, mount, t), t);
    expect_near(found.velocity, by_poses.velocity, 1e-4);
    expect_near(found.turning, by_poses.turning, 1e-4);
}

TEST(MavlinkMotion, OdometryTellsItInTheAxesOfTheBody) {
    mavlink::Odometry m;  // it looks east and goes ahead, turns to starboard and rolls to starboard
    const double half = std::sqrt(0.5);
    m.q = {static_cast<float>(half), 0, 0, static_cast<float>(half)};
    m.vx = 1, m.vz = 0.2F, m.roll_speed = 0.1F, m.yaw_speed = 0.3F;
    m.frame_id = mavlink::frames::local_ned, m.child_frame_id = mavlink::frames::body_frd;
    const auto told = MavlinkPose().add(m, 1, 1s).message;
    ASSERT_TRUE(told);
    expect_near(told->velocity.value(), {1, 0, -0.2}, 1e-6);
    expect_near(told->turning.value(), {0.1, 0, -0.3}, 1e-6);
    m.child_frame_id = mavlink::frames::local_ned;  // north
    expect_near(MavlinkPose().add(m, 1, 1s).message->velocity.value(), {0, 1, -0.2}, 1e-6);
    m.vx = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(MavlinkPose().add(m, 1, 1s).message->velocity);
    m.vx = 1e6F;
    EXPECT_EQ(MavlinkPose().add(m, 1, 1s).reason, "a velocity that cannot be");
    m.vx = 1, m.child_frame_id = 3;
    EXPECT_FALSE(MavlinkPose().add(m, 1, 1s).message->velocity) << "in no frame that is known";
}

TEST(MavlinkMotion, OtherMessagesTellTheirPart) {
    mavlink::LocalPositionNed place;
    place.vx = 1, place.vy = 2, place.vz = 3;
    expect_near(MavlinkPose().add(place, 1, 1s).message->velocity.value(), {2, 1, -3}, 1e-6);
    mavlink::Attitude attitude;
    attitude.roll_speed = 0.1F, attitude.pitch_speed = 0.2F, attitude.yaw_speed = 0.3F;
    const auto turns = MavlinkPose().add(attitude, 1, 1s).message;
    expect_near(turns->turning.value(), {0.1, -0.2, -0.3}, 1e-6);
    EXPECT_FALSE(turns->velocity);
    mavlink::GlobalPositionInt global;
    global.vx = 100, global.vz = -50;
    expect_near(MavlinkPose().add(global, 1, 1s).message->velocity.value(), {0, 1, 0.5}, 1e-6);
}

}  // namespace
}  // namespace echoloop
