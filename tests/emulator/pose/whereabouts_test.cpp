// Poses in step with the run: what a ping between two of them sees, and that nothing is guessed beyond the
// last.
#include "emulator/pose/whereabouts.h"

#include <gtest/gtest.h>

namespace echoloop {
namespace {

using namespace std::chrono_literals;

PoseMessage at_x(double x) { return {{}, Vec3{x, 0, 0}, Quat{}}; }

class InStep : public testing::Test {
  protected:
    void step(Time to) {
        where_.step(now_, to);
        now_ = to;
    }
    double x(Time time) const { return where_.at(time).pose.position.x; }

    Whereabouts where_{{{7, 0, 0}, {}}, true};
    Time now_{};
};

TEST_F(InStep, APoseBelongsToTheStepThatFollowsIt) {
    step(100ms);
    EXPECT_EQ(x(100ms), 7);  // nobody has told anything
    where_.tell_with_next_step(at_x(1));
    step(200ms);
    EXPECT_EQ(x(150ms), 1);
    EXPECT_EQ(x(200ms), 1);
    where_.tell_with_next_step(at_x(9));
    where_.tell_with_next_step(at_x(2));  // of several the last counts
    EXPECT_EQ(x(200ms), 1);
    step(300ms);
    EXPECT_EQ(x(200ms), 1);
    EXPECT_DOUBLE_EQ(x(250ms), 1.5);
    EXPECT_EQ(x(300ms), 2);
}

TEST_F(InStep, AStepWithoutAPoseSaysThatItHasNotMoved) {
    where_.tell_with_next_step(at_x(1));
    step(100ms);
    where_.tell_with_next_step(at_x(2));
    step(200ms);
    step(300ms);
    EXPECT_EQ(x(250ms), 2);  // not on to 2.5
    where_.tell_with_next_step(at_x(3));
    step(400ms);
    EXPECT_EQ(x(300ms), 2);
    EXPECT_DOUBLE_EQ(x(350ms), 2.5);
}

TEST_F(InStep, PosesWithTimesOfTheRunMayComeAheadAndSeveralAStep) {
    for (const int i : {1, 2, 3, 4}) where_.tell(i * 50ms, at_x(i));
    step(100ms);
    EXPECT_DOUBLE_EQ(x(75ms), 1.5);
    step(200ms);
    EXPECT_DOUBLE_EQ(x(175ms), 3.5);
    EXPECT_EQ(x(200ms), 4);
}

// What is seen at the time of a pose must not depend on whether the next one has arrived.
TEST_F(InStep, AtTheTimeOfAPoseItIsThatPoseToTheLastBit) {
    const Quat odd{0.9238795042037964, 0.1, 0.2, 0.3090};
    const double length = std::sqrt(odd.w * odd.w + odd.x * odd.x + odd.y * odd.y + odd.z * odd.z);
    const Quat unit{odd.w / length, odd.x / length, odd.y / length, odd.z / length};
    where_.tell_with_next_step(at_x(0.1));
    step(100ms);
    where_.tell_with_next_step({{}, Vec3{0.3, 0, 0}, unit});
    step(200ms);
    const Quat before = where_.at(200ms).pose.orientation;
    where_.tell_with_next_step({{}, Vec3{0.7, 0, 0}, Quat{}});
    step(300ms);
    const Quat after = where_.at(200ms).pose.orientation;
    EXPECT_EQ(x(200ms), 0.3);
    for (const Quat& seen : {before, after}) {
        EXPECT_EQ(seen.w, unit.w);
        EXPECT_EQ(seen.z, unit.z);
    }
}

}  // namespace
}  // namespace echoloop
