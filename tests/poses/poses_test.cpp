// The parts of the pose programs that need no middleware: lines, stamps, frames, command lines, rosbridge's
// JSON.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "emulator/contract/error.h"
#include "emulator/pose/message.h"
#include "tools/poses/common/frames.h"
#include "tools/poses/common/line.h"
#include "tools/poses/common/options.h"
#include "tools/poses/rosbridge/messages.h"

namespace echoloop::poses {
namespace {

TEST(PoseLine, IsExact) {
    const Pose pose{{1.0 / 3, -0.0, 1e-7}, {0.5, -0.5, 0.5, -0.5}};
    EXPECT_EQ(
        pose_line(pose, "", "t", 1'500'000'001),
        R"({"t": 1.500000001, "position": [0.3333333333333333, -0, 1e-07], "orientation": [0.5, -0.5, 0.5, -0.5]})");
    EXPECT_EQ(pose_line({}, "a \"ball\"\n\xFF", "now", {}).substr(0, 38),
              "{\"object\": \"a \\\"ball\\\"\\n\\ufffd\", \"posi");
    EXPECT_EQ(step_line(-250'000'000), R"({"now": -0.25})");
}

TEST(PoseLine, IsWhatTheEmulatorReads) {
    const Pose pose{{1.0 / 3, 2e-9, -123456.789}, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}};
    const auto read = parse_pose_line(pose_line(pose, "", "t", 12));
    ASSERT_TRUE(read.message) << read.reason;
    EXPECT_EQ(read.message->position, pose.position);
    EXPECT_EQ(read.message->time, 12e-9);
}

TEST(PoseLine, TellsVelocitiesThatTheEmulatorReads) {
    const auto read = parse_pose_line(pose_line({}, "", "t", 12, {Vec3{1, 2, 3}, Vec3{0.1, 0.2, 0.3}}));
    ASSERT_TRUE(read.message) << read.reason;
    EXPECT_EQ(read.message->velocity, (Vec3{1, 2, 3}));
    EXPECT_EQ(read.message->turning, (Vec3{0.1, 0.2, 0.3}));
    const double none = std::numeric_limits<double>::quiet_NaN();
    const auto half = parse_pose_line(pose_line({}, "", "t", 12, {Vec3{1e9, 2, 3}, Vec3{none, 0, 0}}));
    ASSERT_TRUE(half.message) << half.reason;
    EXPECT_FALSE(half.message->velocity || half.message->turning);
}

TEST(PoseLine, OfAFixTellsAPlaceOnTheEarthAndNoAttitude) {
    const auto read = parse_pose_line(fix_line({59.4, -10.5, -3.25}, "ball", "t", 12));
    ASSERT_TRUE(read.message) << read.reason;
    EXPECT_EQ(read.message->place, (GeoPlace{59.4, -10.5, -3.25}));
    EXPECT_FALSE(read.message->attitude || read.message->position);
    EXPECT_EQ(read.message->object, "ball");
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(fault_of_fix({-90, 360, 0}), "");
    EXPECT_NE(fault_of_fix({1, 2, none}).find("no altitude"), std::string::npos);
    for (const auto& wrong : {std::array{90.1, 0.0, 0.0}, {0.0, 361.0, 0.0}, {none, 0.0, 0.0}})
        EXPECT_NE(fault_of_fix(wrong), "");
}

TEST(PoseLine, RefusesWhatTheEmulatorWould) {
    EXPECT_EQ(fault_of({{1, 2, 3}, {1, 0, 0, 0}}), "");
    EXPECT_NE(fault_of({{1, 2, 3}, {0, 0, 0, 0}}).find("not filled it in"), std::string::npos);
    EXPECT_NE(fault_of({{1, 2, 3}, {0, 0, 0, 1.02}}), "");
    EXPECT_NE(fault_of({{std::numeric_limits<double>::quiet_NaN(), 2, 3}, {1, 0, 0, 0}}), "");
    EXPECT_NE(fault_of({{1e6, 1e6, 0}, {1, 0, 0, 0}}), "");
}

TEST(Stamps, AreNoneIfNobodyFilledThemIn) {
    EXPECT_EQ(stamp_of(2, 5), 2'000'000'005);
    EXPECT_FALSE(stamp_of(0, 0));
    EXPECT_FALSE(stamp_of(-1, 0));
    EXPECT_FALSE(stamp_of(1, 1'000'000'000));
    EXPECT_FALSE(stamp_of(std::numeric_limits<std::int64_t>::max(), 0));
}

BodyPose edge(const std::string& parent, const std::string& child, std::optional<Nanoseconds> stamp, double x,
              std::array<double, 4> q = {1, 0, 0, 0}) {
    return {parent, child, stamp, {x, 0, 0}, q};
}

TEST(Frames, PutTheChainTogether) {
    Frames frames("map");
    std::string why;
    EXPECT_FALSE(frames.newest("base", why));
    EXPECT_NE(why.find("'map' to 'base'"), std::string::npos);
    const double half = std::sqrt(0.5);
    frames.add({edge("/odom", "base", 20, 1), edge("base", "keel", 99, 2)}, false);
    frames.add({edge("base", "keel", 99, 2)}, true);
    frames.add({edge("map", "odom", 10, 4, {half, 0, 0, half})}, false);  // a quarter turn to port
    const auto keel = frames.newest("keel", why);
    ASSERT_TRUE(keel);
    EXPECT_EQ(keel->stamp, 20);
    EXPECT_NEAR(keel->position[0], 4, 1e-12);
    EXPECT_NEAR(keel->position[1], 3, 1e-12);
    EXPECT_FALSE(frames.newest("keel", why)) << "the same again";
    frames.add({edge("odom", "base", 21, 1)}, false);
    EXPECT_TRUE(frames.newest("keel", why));
}

TEST(Frames, InARingEnd) {
    Frames frames("map");
    std::string why;
    frames.add({edge("a", "b", 1, 0), edge("b", "a", 1, 0)}, false);
    EXPECT_FALSE(frames.newest("a", why));
    EXPECT_NE(why, "");
}

std::optional<Options> options(std::vector<const char*> words) {
    words.insert(words.begin(), "program");
    const Program program{"program", "", "", "", true, true};
    return read_options(static_cast<int>(words.size()), words.data(), program);
}

TEST(CommandLine, SaysWhereEveryPoseComesFrom) {
    const auto read =
        options({"--topic", "/tf#base_link", "--object", "ball=/ball", "--object", "crane=/tf#hook", "--to",
                 "tcp://localhost:9501", "--frame", "ned", "--step", "--zero", "2.5"});
    ASSERT_TRUE(read);
    ASSERT_EQ(read->sources.size(), 3u);
    EXPECT_EQ(read->sources[0].entry, "base_link");
    EXPECT_EQ(read->sources[1].object, "ball");
    EXPECT_EQ(read->sources[2].topic, "/tf");
    EXPECT_EQ(topics_of(*read), (std::vector<std::string>{"/tf", "/ball"}));
    EXPECT_EQ(to_string(read->to), "tcp://127.0.0.1:9501");
    EXPECT_EQ(read->zero, 2'500'000'000);
    EXPECT_TRUE(read->ned && read->step);
}

TEST(CommandLine, RefusesWithARemedy) {
    EXPECT_THROW(options({}), StartError);
    EXPECT_THROW(options({"--topic", "/a", "--to", "udp-listen://127.0.0.1:1"}), StartError);
    EXPECT_THROW(options({"--topic", "/a", "--type", "/a"}), StartError);
    EXPECT_THROW(options({"--topic", "/a", "--zero", "x"}), StartError);
}

TEST(Rosbridge, HearsBothGenerations) {
    const std::string place = R"("x": 1, "y": 2, "z": 3)", turn = R"("x": 0, "y": 0, "z": 0, "w": 1)";
    const auto said = [&](const std::string& stamp) {
        return read_rosbridge(
            R"({"op": "publish", "topic": "/odom", "msg": {"child_frame_id": "base", "header": {"stamp": )" +
            stamp + R"(, "frame_id": "odom"}, "pose": {"pose": {"position": {)" + place +
            R"(}, "orientation": {)" + turn + R"(}}}, "twist": {"twist": {"linear": {)" + place +
            R"(}, "angular": {"x": 4, "y": 5, "z": null}}}}})");
    };
    for (const char* stamp : {R"({"secs": 3, "nsecs": 7})", R"({"sec": 3, "nanosec": 7})"}) {
        const auto heard = said(stamp);
        ASSERT_EQ(heard.bodies.size(), 1u) << heard.reason;
        EXPECT_EQ(heard.topic, "/odom");
        EXPECT_EQ(heard.bodies[0].stamp, 3'000'000'007);
        EXPECT_EQ(heard.bodies[0].name, "base");
        EXPECT_EQ(heard.bodies[0].parent, "odom");
        EXPECT_EQ(heard.bodies[0].position, (std::array<double, 3>{1, 2, 3}));
        EXPECT_EQ(heard.bodies[0].velocity, (std::array<double, 3>{1, 2, 3}));
        EXPECT_FALSE(heard.bodies[0].turning) << "null is no number";
        EXPECT_EQ(heard.bodies[0].orientation, (std::array<double, 4>{1, 0, 0, 0}));
    }
    EXPECT_NE(said("{}").reason, "");
    EXPECT_NE(said(R"({"sec": 1.5, "nanosec": 0})").reason, "");
    EXPECT_EQ(
        read_rosbridge(R"({"op": "publish", "topic": "/clock", "msg": {"clock": {"sec": 2, "nanosec": 1}}})")
            .clock,
        2'000'000'001);
}

TEST(Rosbridge, HearsAFix) {
    const auto said = [](const std::string& status, const std::string& altitude) {
        return read_rosbridge(
            R"({"op": "publish", "topic": "/fix", "msg": {"header": {"stamp": {"sec": 3, "nanosec": 7}, "frame_id": "gps"}, )"
            R"("status": {"status": )" +
            status + R"(, "service": 1}, "latitude": 59.4, "longitude": 10.5, "altitude": )" + altitude +
            R"(, "position_covariance": [0, 0, 0, 0, 0, 0, 0, 0, 0], "position_covariance_type": 0}})");
    };
    const auto heard = said("0", "-3");
    ASSERT_EQ(heard.bodies.size(), 1u) << heard.reason;
    EXPECT_EQ(heard.bodies[0].fix, (std::array<double, 3>{59.4, 10.5, -3}));
    EXPECT_EQ(heard.bodies[0].stamp, 3'000'000'007);
    EXPECT_NE(said("-1", "-3").reason.find("has no fix"), std::string::npos);
    ASSERT_EQ(said("0", "null").bodies.size(), 1u);
    EXPECT_NE(fault_of_fix(*said("0", "null").bodies[0].fix), "");
}

TEST(Rosbridge, SurvivesAStatusThatNestsWithoutEnd) {
    const std::size_t deep = 1'000'000;
    const auto heard =
        read_rosbridge(R"({"op": "status", "msg": )" + std::string(deep, '[') + std::string(deep, ']') + "}");
    EXPECT_NE(heard.reason, "");
    EXPECT_EQ(read_rosbridge(R"({"op": "status", "msg": "no"})").reason, R"(rosbridge says: "no")");
}

}  // namespace
}  // namespace echoloop::poses
