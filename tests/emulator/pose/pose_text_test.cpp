// Poses as text: lines of JSON and trajectory files, good ones by literal values and bad ones by their
// reasons.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulator/contract/error.h"
#include "emulator/pose/message.h"
#include "emulator/pose/trajectory_file.h"

namespace echoloop::test {
namespace {

using testing::HasSubstr;

void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(norm(a - b), 1e-9) << a.x << ' ' << a.y << ' ' << a.z; }

Vec3 nose(Quat attitude) { return rotate(attitude, {1, 0, 0}); }
Vec3 roof(Quat attitude) { return rotate(attitude, {0, 0, 1}); }

PoseMessage good(std::string_view line) {
    const PoseText text = parse_pose_line(line);
    EXPECT_EQ(text.reason, "") << line;
    return text.message.value_or(PoseMessage{});
}

TEST(PoseLine, OwnWords) {
    const auto full =
        good(R"({"t": 2.5, "position": [1, -2, -3.5], "orientation": [0.70710678, 0, 0, 0.70710678]})");
    EXPECT_EQ(full.time, 2.5);
    expect_near(full.position.value(), {1, -2, -3.5});
    expect_near(nose(full.attitude.value()), {0, 1, 0});  // yaw 90 deg looks north
    const auto angles = good(R"({"position": [0, 0, 0], "rpy_deg": [0, 90, 0], "comment": "looks down"})");
    EXPECT_FALSE(angles.time);
    expect_near(nose(angles.attitude.value()), {0, 0, -1});
}

TEST(PoseLine, PlacesOnTheGlobe) {
    const auto fix = good(R"({"t": 1, "latitude": 59.4, "longitude": -10.5, "altitude": -3})");
    EXPECT_EQ(fix.place, (GeoPlace{59.4, -10.5, -3}));
    EXPECT_FALSE(fix.position);
    EXPECT_FALSE(fix.attitude) << "a fix knows none";
    const auto whole = good(R"({"latitude": 1, "longitude": 2, "depth": 30, "rpy_deg": [0, 90, 0]})");
    EXPECT_EQ(whole.place, (GeoPlace{1, 2, -30}));
    expect_near(nose(whole.attitude.value()), {0, 0, -1});
    for (const auto& [line, reason] : {
             std::pair{R"({"latitude": 59.4, "altitude": 0})", "longitude is missing"},
             {R"({"longitude": 59.4, "altitude": 0})", "latitude is missing"},
             {R"({"latitude": 59.4, "longitude": 1})", "\"altitude\" or \"depth\""},
             {R"({"latitude": 59.4, "longitude": 1, "depth": 1, "altitude": 1})", "one of them"},
             {R"({"latitude": 91, "longitude": 1, "depth": 1})", "within 90"},
             {R"({"latitude": 1, "longitude": 361, "depth": 1})", "within 360"},
             {R"({"latitude": "1N", "longitude": 361, "depth": 1})", "finite number"},
             {R"({"latitude": 1, "longitude": 1, "depth": 1, "position": [1, 2, 3]})", "give one of them"},
         })
        EXPECT_THAT(parse_pose_line(line).reason, HasSubstr(reason)) << line;
}

TEST(Trajectory, OnTheGlobe) {
    const std::string text =
        "t,latitude,longitude,altitude,qw,qx,qy,qz\n0,59.4,10.5,-3,1,0,0,0\n1,59.39,10.51,-4,1,0,0,0\n";
    const Track track = parse_trajectory(text, "way.csv", GeoPlace{59.4, 10.5, 0});
    EXPECT_LT(norm(track.at(Time{0})->pose.position - Vec3{0, 0, -3}), 1e-9);
    // PROJ 9.1, +proj=ortho about the origin.
    EXPECT_LT(norm(track.at(std::chrono::seconds(1))->pose.position - Vec3{568.24015, -1113.97675, -4}),
              1e-4);
    try {
        parse_trajectory(text, "way.csv");
        ADD_FAILURE() << "nobody knows where that is";
    } catch (const StartError& error) {
        EXPECT_THAT(error.what(), HasSubstr("way.csv:1: nothing says where the world lies"));
    }
    EXPECT_THROW(parse_trajectory("t,latitude,longitude,altitude,qw,qx,qy,qz\n0,95,10.5,-3,1,0,0,0\n",
                                  "way.csv", GeoPlace{59.4, 10.5, 0}),
                 StartError);
}

TEST(PoseLine, MayNameAnObjectOfTheScene) {
    EXPECT_EQ(good(R"({"position": [0, 0, 0]})").object, "");
    EXPECT_EQ(good(R"({"object": "auv", "position": [0, 0, 0], "rpy_deg": [0, 0, 90]})").object, "auv");
    EXPECT_EQ(good(R"({"object": "auv", "position": [1, 2, 3], "attitude": [0, 0, 0]})").object, "auv");
    for (const char* name : {"7", "\"\"", "null", "[\"auv\"]"})
        EXPECT_THAT(
            parse_pose_line("{\"position\": [0, 0, 0], \"object\": " + std::string(name) + "}").reason,
            HasSubstr("object: expected the name of a node"));
}

TEST(PoseLine, ArduPilotSpeaksNorthEastDown) {
    // 10 m north, 5 m east, 3 m down, heading east, level.
    const auto east =
        good(R"({"timestamp": 7, "imu": {}, "position": [10, 5, 3], "attitude": [0, 0, 1.5707963267948966],
                               "velocity": [0, 0, 0]})");
    EXPECT_EQ(east.time, 7);
    expect_near(east.position.value(), {5, 10, -3});
    expect_near(nose(east.attitude.value()), {1, 0, 0});
    expect_near(roof(east.attitude.value()), {0, 0, 1});
    // Positive pitch lifts the nose there, positive roll drops the right side.
    expect_near(
        nose(good(R"({"position": [0, 0, 0], "attitude": [0, 1.5707963267948966, 0]})").attitude.value()),
        {0, 0, 1});
    expect_near(
        roof(good(R"({"position": [0, 0, 0], "attitude": [1.5707963267948966, 0, 0]})").attitude.value()),
        {1, 0, 0});
    const auto same = good(
        R"({"timestamp": 7, "position": [10, 5, 3], "quaternion": [0.7071067811865476, 0, 0, 0.7071067811865476]})");
    expect_near(nose(same.attitude.value()), nose(east.attitude.value()));
}

TEST(PoseLine, MayTellVelocities) {
    const auto own =
        good(R"({"position": [0, 0, 0], "velocity": [1, 2, 3], "angular_velocity": [0.1, 0.2, 0.3]})");
    expect_near(own.velocity.value(), {1, 2, 3});
    expect_near(own.turning.value(), {0.1, 0.2, 0.3});
    const auto ned = good(R"({"timestamp": 7, "imu": {"gyro": [0.1, 0.2, 0.3], "accel_body": [0, 0, -9.8]},
                              "position": [0, 0, 0], "attitude": [0, 0, 0], "velocity": [1, 2, 3]})");
    expect_near(ned.velocity.value(), {2, 1, -3});
    expect_near(ned.turning.value(), {0.1, -0.2, -0.3});
    EXPECT_FALSE(good(R"({"position": [0, 0, 0]})").velocity);
}

TEST(PoseLine, RefusesWithAReason) {
    const std::pair<const char*, const char*> lines[] = {
        {"", "no JSON"},
        {"{\"position\": [1, 2", "no JSON"},
        {"[1, 2, 3]", "expected a JSON object"},
        {"{}", "\"position\""},
        {R"({"position": [1, 2]})", "3 numbers"},
        {R"({"position": [1, 2, "3"]})", "finite number"},
        {R"({"position": [1, 2, 1e999]})", "no JSON"},
        {R"({"position": [0, 0, 2e6]})", "1000 km"},
        {R"({"position": [0, 0, 0], "orientation": [1, 1, 0, 0]})", "length is not 1"},
        {R"({"position": [0, 0, 0], "orientation": [0, 0, 0, 0]})", "length is not 1"},
        {R"({"position": [0, 0, 0], "orientation": [1, 0, 0, 0], "rpy_deg": [0, 0, 0]})", "one of them"},
        {R"({"position": [0, 0, 0], "t": "now"})", "finite number"},
        {R"({"position": [0, 0, 0], "t": 1e300})", "no time"},
        {R"({"position": [0, 0, 0], "attitude": [0, 0]})", "3 numbers"},
        {R"({"position": [0, 0, 0], "velocity": 3})", "velocity: expected a list of 3 numbers"},
        {R"({"position": [0, 0, 0], "angular_velocity": [0, 0, 200]})", "angular_velocity: more than 100"},
        {R"({"position": [0, 0, 0], "attitude": [0, 0, 0], "imu": {"gyro": [1]}})", "gyro: expected"},
    };
    for (const auto& [line, reason] : lines) {
        const PoseText text = parse_pose_line(line);
        EXPECT_FALSE(text.message) << line;
        EXPECT_THAT(text.reason, HasSubstr(reason)) << line;
    }
    parse_pose_line(std::string(100000, '['));  // must come back
}

TEST(Trajectory, CsvWithAndWithoutAHeaderAndTumSayTheSame) {
    const char* texts[] = {
        "t,x,y,z,qw,qx,qy,qz\n100,0,0,-3,1,0,0,0\n102,4,0,-3,0.70710678,0,0,0.70710678\n",
        "100, 0, 0, -3, 1, 0, 0, 0\r\n102, 4, 0, -3, 0.70710678, 0, 0, 0.70710678\r\n",
        "x,y,z,t,qx,qy,qz,qw\n0,0,-3,100,0,0,0,1\n4,0,-3,102,0,0,0.70710678,0.70710678",
        "\xEF\xBB\xBFt,x,y,z,qw,qx,qy,qz\n100,0,0,-3,1,0,0,0\n102,4,0,-3,0.70710678,0,0,0.70710678\n",
        "# timestamp tx ty tz qx qy qz qw\n100 0 0 -3 0 0 0 1\n\n102 4 0 -3  0 0 0.70710678 0.70710678\n",
    };
    for (const char* text : texts) {
        const Track track = parse_trajectory(text, "dive.csv");
        EXPECT_EQ(track.last(), std::chrono::seconds(2));
        const Pose middle = track.at(std::chrono::seconds(1))->pose;
        expect_near(middle.position, {2, 0, -3});
        EXPECT_LT(norm(nose(middle.orientation) - Vec3{std::sqrt(0.5), std::sqrt(0.5), 0}), 1e-7);
        const auto after = track.at(std::chrono::seconds(100));
        expect_near(after->pose.position, {4, 0, -3});
        EXPECT_FALSE(after->stale);
    }
}

TEST(Trajectory, FaultsNameFileLineAndReason) {
    const std::pair<const char*, const char*> texts[] = {
        {"", "dive.csv: there are no poses"},
        {"0 0 0 0 0 0 1", "dive.csv:1: expected 8 numbers"},
        {"0,0,0,0,1,0,0,0\n1,0,0,zero,1,0,0,0", "dive.csv:2: 'zero' is not a finite number"},
        {"0,0,0,nan,1,0,0,0", "'nan' is not a finite number"},
        {"0,0,0,0,1,0,0,0\n0,0,0,0,1,0,0,0", "dive.csv:2: the time must be later"},
        {"0,0,0,0,1,1,0,0", "length is not 1"},
        {"0,0,0,9e9,1,0,0,0", "1000 km"},
        {"t,x,y,z,qw,qx,qy,roll\n", "it has 'roll'"},
        {"t,x,y\n", "the header must name"},
        {"time,x,y,z,qw,qx,qy,qz\n", "the header must name each of t,x,y,z,qw,qx,qy,qz once; it has 'time'"},
    };
    for (const auto& [text, reason] : texts) try {
            parse_trajectory(text, "dive.csv");
            ADD_FAILURE() << text;
        } catch (const StartError& error) {
            EXPECT_THAT(error.what(), HasSubstr(reason));
            EXPECT_EQ(error.exit(), Exit::data);
        }
}

}  // namespace
}  // namespace echoloop::test
