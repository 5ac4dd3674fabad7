// The lines of the ground truth and the file that takes them, read back by nlohmann's JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "emulator/contract/error.h"
#include "emulator/truth/device_truth.h"

namespace echoloop {
namespace {

using Json = nlohmann::json;

PingTruth some_ping() {
    PingTruth ping;
    ping.device = "sonar";
    ping.transmitted = from_seconds(1.5);
    ping.due = from_seconds(1.625);
    ping.world_from_body = {{1, 2, -3}, axis_angle({0, 0, 1}, 0.5)};
    ping.sonar = {{0.5, 0, -0.25}, {0, 0, 2}};
    ping.movers = {{{4, 5, 6}, {}}};
    ping.echo.shot.ping = 7;
    ping.echo.shot.bins = 6;
    ping.echo.shot.bearings = {-0.25, 0.25};
    ping.echo.sound_speed = 1466.25;
    ping.echo.truth = {{6.5F, 6.25F}, {}};
    ping.echo.objects = {0, 2, 2, 2, 1, 0, 0, 0, 0, 0, 0, 3};
    ping.faults = {"bits flipped"};
    return ping;
}

Json line_of(const PingTruth& ping) {
    std::string text;
    append_truth_line(ping, text);
    return Json::parse(text);
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

struct TemporaryFile {
    std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / ("truth_" + std::to_string(::getpid()) + ".jsonl");
    ~TemporaryFile() { std::filesystem::remove(path); }
};

TEST(TruthLine, SaysWhatIsKnownOfAPing) {
    const Json line = line_of(some_ping());
    EXPECT_EQ(line["device"], "sonar");
    EXPECT_EQ(line["ping"], 7);
    EXPECT_EQ(line["t"], 1.5);
    EXPECT_EQ(line["due"], 1.625);
    EXPECT_EQ(line["sound_speed"], 1466.25);
    EXPECT_EQ(line["world_from_body"]["position"], Json({1, 2, -3}));
    EXPECT_EQ(line["world_from_body"]["orientation"][3], std::sin(0.25));
    EXPECT_EQ(line["sonar_velocity"], Json({0.5, 0.0, -0.25}));
    EXPECT_EQ(line["sonar_turning"], Json({0.0, 0.0, 2.0}));
    EXPECT_EQ(line["movers"][0]["position"], Json({4, 5, 6}));
    EXPECT_EQ(line["beams"], Json({-0.25, 0.25}));
    EXPECT_EQ(line["axis_range"], Json({6.5, nullptr})) << "nothing on that axis";
    EXPECT_EQ(line["nearest_range"], Json({6.25, nullptr}));
    EXPECT_EQ(line["objects"], Json::parse("[[[2,1,3],[1,4,1]],[[3,5,1]]]"))
        << "runs of object, first bin, bins";
    EXPECT_EQ(line["faults"], Json({"bits flipped"}));
}

TEST(TruthLine, KeepsNumbersAndTextThatJsonCannotHold) {
    PingTruth ping = some_ping();
    ping.echo.noise_power = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(line_of(ping)["noise_power"].is_null());
    TruthHeader header;
    header.objects = {"say \"hull\"\n", "\xFF"};
    const Json read = Json::parse(truth_header_line(header));
    EXPECT_EQ(read["echoloop_truth"], 1);
    EXPECT_EQ(read["objects"][0], header.objects[0]);
}

TEST(TruthFile, HoldsEveryLineInOrder) {
    const TemporaryFile file;
    TruthFile truth(file.path);
    truth.begin({.scenario = "a.yaml", .scene = "a.glb", .objects = {"floor"}});
    for (std::uint64_t i = 0; i < 5000; ++i) {
        PingTruth ping = some_ping();
        ping.echo.shot.ping = i;
        truth.add(ping);
    }
    truth.finish();
    const auto lines = lines_of(file.path);
    ASSERT_EQ(lines.size(), 5001);
    EXPECT_EQ(Json::parse(lines[0])["objects"], Json({"floor"}));
    for (std::uint64_t i = 0; i < 5000; ++i) ASSERT_EQ(Json::parse(lines[i + 1])["ping"], i);
    EXPECT_EQ(truth.summary().lines, 5001);
    EXPECT_EQ(truth.summary().bytes, std::filesystem::file_size(file.path));
}

TEST(TruthFile, AFullDiskStopsTheFileAndNothingElse) {
    TruthFile truth("/dev/full", {.keep_free = 0});
    truth.begin({});
    truth.finish();
    EXPECT_TRUE(truth.summary().stopped);
    EXPECT_EQ(truth.summary().lines, 0);
}

TEST(TruthFile, CountsLinesThatASlowDiskHasNoTimeFor) {
    const TemporaryFile file;
    TruthFile truth(file.path, {.most_waiting = 100});
    for (int i = 0; i < 10; ++i) truth.add(some_ping());
    truth.finish();
    EXPECT_EQ(truth.summary().lost, 10);
}

TEST(TruthFile, SaysWhyAFileCannotBeMade) {
    try {
        TruthFile truth("/nowhere/truth.jsonl");
        FAIL();
    } catch (const StartError& error) {
        EXPECT_THAT(error.what(),
                    testing::HasSubstr("/nowhere/truth.jsonl: cannot be written: No such file"));
    }
}

TEST(DeviceTruth, KnowsWhereTheVehicleIsFromItsSonar) {
    const TemporaryFile file;
    TruthFile truth(file.path);
    const Pose world_from_body{{10, 20, -5}, axis_angle({0, 0, 1}, 1)},
        body_from_sonar{{0.4, 0, 0.1}, from_rpy(0, 1, 0)};
    DeviceTruth device(&truth, "sonar", body_from_sonar);
    Echogram echogram;
    echogram.world_from_sonar = world_from_body * body_from_sonar;
    device.heard(device.of({{}, 0, echogram.world_from_sonar, {}}, {}, 0, {}, {"bit_flips 3"}, echogram),
                 {1});
    truth.finish();
    const Json line = Json::parse(lines_of(file.path).at(0));
    const double wanted[] = {10, 20, -5};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(line["world_from_body"]["position"][i], wanted[i], 1e-12);
    EXPECT_NEAR(line["world_from_body"]["orientation"][0], std::cos(0.5), 1e-12);
}

}  // namespace
}  // namespace echoloop
