// Where a mount is at any time: at rest, by its law, by a file.
#include "emulator/pose/mount.h"

#include <gtest/gtest.h>

#include <fstream>

namespace echoloop {
namespace {

class MountTest : public testing::Test {
  protected:
    Mount mount() { return {scenario_, device_, clock_, nullptr}; }
    /// Degrees that its x axis looks up, and to port.
    static std::pair<double, double> looks(const Pose& pose) {
        const Vec3 x = rotate(pose.orientation, {1, 0, 0});
        return {rad_to_deg(std::asin(x.z)), rad_to_deg(std::atan2(x.y, x.x))};
    }

    asio::io_context io_;
    RealClock clock_{io_, 1, std::nullopt};
    Scenario scenario_;
    ScenarioDevice device_;
};

TEST_F(MountTest, IsFixedUnlessItMoves) {
    device_.body_from_sonar = {{1, 2, 3}, from_rpy(0, 0.5, 0)};
    const Mount fixed = mount();
    EXPECT_EQ(fixed.body_from_sonar(from_seconds(7)), device_.body_from_sonar);
    EXPECT_FALSE(fixed.summary());
}

TEST_F(MountTest, NodsAndPansAboutItsOwnAxes) {
    device_.body_from_sonar.position = {1, 0, 0};
    device_.mount_swing = {MountSwing::Axis::pitch, deg_to_rad(20), 4};
    const Mount nodding = mount();
    EXPECT_NEAR(looks(nodding.body_from_sonar({})).first, 0, 1e-9);
    EXPECT_NEAR(looks(nodding.body_from_sonar(from_seconds(1))).first, -20, 1e-9)
        << "a positive pitch looks down";
    EXPECT_NEAR(looks(nodding.body_from_sonar(from_seconds(3))).first, 20, 1e-9);
    EXPECT_NEAR(looks(nodding.body_from_sonar(from_seconds(1.0 / 3))).first, -10, 1e-6) << "sin 30 deg";
    EXPECT_EQ(nodding.body_from_sonar(from_seconds(1)).position.x, 1);
    device_.mount_swing = {MountSwing::Axis::yaw, deg_to_rad(30), 2};
    EXPECT_NEAR(looks(mount().body_from_sonar(from_seconds(0.5))).second, 30, 1e-9);
}

TEST_F(MountTest, FollowsAFile) {
    const auto file = std::filesystem::path(testing::TempDir()) / "mount.csv";
    std::ofstream(file) << "t,x,y,z,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n2,0,0,-1,1,0,0,0\n";
    device_.mount_trajectory = file;
    EXPECT_NEAR(mount().body_from_sonar(from_seconds(1)).position.z, -0.5, 1e-9);
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace echoloop
