// What happens to a data set whose writing is slower than its sonars, or cannot go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <future>

#include "emulator/contract/error.h"
#include "emulator/dataset/dataset.h"
#include "render/scene/scene.h"

namespace echoloop {
namespace {

namespace fs = std::filesystem;

struct Folder {
    fs::path path = fs::path(testing::TempDir()) / ("dataset_" + std::to_string(::getpid()));
    fs::path set = path / "set";
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

/// A sonar of 8 beams before a wall, 10 m ahead.
DatasetStart start(bool waits) {
    const std::vector<Mesh> meshes{
        {"wall", {}, {{10, -9, -9}, {10, 9, -9}, {10, 9, 9}, {10, -9, 9}}, {}, {0, 2, 1, 0, 3, 2}}};
    DatasetStart start{.header = {}, .turns = {false}, .scene = Scene::from_meshes(meshes), .waits = waits};
    start.header.devices.push_back({"sonar", "model", {}});
    return start;
}

PingTruth ping(std::uint64_t number) {
    PingTruth ping;
    ping.device = "sonar";
    Shot& shot = ping.echo.shot;
    shot.ping = number;
    for (int i = 0; i < 8; ++i) shot.bearings.push_back(0.02 * i);
    shot.beam_width = 0.02, shot.fan_height = 0.2, shot.bin_interval = 1e-4, shot.bins = 200;
    ping.echo.sound_speed = 1500;
    ping.echo.values.assign(shot.beams() * shot.bins, 1e6F);
    ping.echo.objects.assign(ping.echo.values.size(), 1);
    return ping;
}

std::size_t lines_of(const fs::path& file) {
    std::ifstream in(file);
    std::size_t lines = 0;
    for (std::string line; std::getline(in, line);) ++lines;
    return lines;
}

TEST(Dataset, LeavesPingsOutAndCountsThemWhereNobodyMayWait) {
    const Folder folder;
    Dataset dataset(folder.set, {.keep_free = 0, .most_waiting = 1});
    dataset.begin(start(false));
    constexpr std::uint64_t all = 300;
    for (std::uint64_t i = 1; i <= all; ++i) {
        dataset.heard(0, ping(i));
        dataset.said(0, 0, "reply");
    }
    dataset.finish();
    const DatasetSummary summary = dataset.summary();
    EXPECT_GT(summary.lost, 0);
    EXPECT_EQ(summary.pings + summary.lost, all);
    EXPECT_EQ(lines_of(folder.set / "index.jsonl"), summary.pings);
    EXPECT_EQ(fs::file_size(folder.set / "wire" / "sonar.bin"), 5 * summary.pings)
        << "what is said for a ping that is left out is not another's";
}

TEST(Dataset, HasEveryPingWhereTimeWaits) {
    const Folder folder;
    Dataset dataset(folder.set, {.keep_free = 0, .most_waiting = 1});
    dataset.begin(start(true));
    for (std::uint64_t i = 1; i <= 100; ++i) dataset.heard(0, ping(i));
    EXPECT_FALSE(fs::exists(folder.set)) << "it is not whole yet";
    dataset.finish();
    EXPECT_EQ(dataset.summary().lost, 0);
    EXPECT_EQ(lines_of(folder.set / "index.jsonl"), 100);
}

TEST(Dataset, OnAFullDiskNobodyWaitsForEverAndNothingIsLeft) {
    const Folder folder;
    {
        std::promise<void> told;
        Dataset dataset(folder.set, {.keep_free = ~0ULL >> 1, .most_waiting = 1});
        DatasetStart first = start(true);
        first.failed = [&] { told.set_value(); };
        dataset.begin(std::move(first));
        told.get_future().wait();
        for (std::uint64_t i = 1; i <= 100; ++i) dataset.heard(0, ping(i));
        try {
            dataset.finish();
            ADD_FAILURE();
        } catch (const StartError& error) {
            EXPECT_EQ(error.exit(), Exit::io);
            EXPECT_THAT(error.what(), testing::ContainsRegex(
                                          "/coco.json: the disk is nearly full; make room on that disk"));
        }
    }
    EXPECT_TRUE(fs::is_empty(folder.path));
}

TEST(Dataset, IsMadeByOneAtATimeAndNeverOverAnother) {
    const Folder folder;
    const Dataset first(folder.set);
    EXPECT_THROW(Dataset second(folder.set), StartError);
    fs::create_directory(folder.path / "there");
    EXPECT_THROW(Dataset third(folder.path / "there"), StartError);
}

}  // namespace
}  // namespace echoloop
