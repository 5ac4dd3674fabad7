// Where the movers of a scene are at a time of the run, and what a scenario says about them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "emulator/contract/model.h"
#include "emulator/pose/movers.h"
#include "emulator/scenario/scene.h"

namespace echoloop {
namespace {

const std::filesystem::path config = std::filesystem::path(ECHOLOOP_SOURCE_DIR) / "config";

/// The tank with `text` added to its scenario; files lie in a folder of the test's own.
struct Tank {
    std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("movers_" + std::to_string(::getpid()));

    Tank() { std::filesystem::create_directories(folder); }
    Tank(const Tank&) = delete;
    Tank& operator=(const Tank&) = delete;
    ~Tank() { std::filesystem::remove_all(folder); }

    Scenario scenario(const std::string& text) const {
        return parse_scenario("scene: " + (config / "scenes/tank.glb").string() + "\n" + text +
                                  "\ndevices: [{name: head, model: tritech-micron}]\n",
                              folder / "tank.yaml", {}, models());
    }
    std::string fault(const std::string& text) const {
        try {
            load_scene(scenario(text));
        } catch (const ScenarioError& error) {
            return error.what();
        }
        return "loads";
    }
};

TEST(Movers, ATrajectoryMovesItsNode) {
    const Tank tank;
    std::ofstream(tank.folder / "way.csv") << "t,x,y,z,qw,qx,qy,qz\n0,1,0,-2,1,0,0,0\n10,4,0,-2,1,0,0,0\n";
    const Scenario scenario = tank.scenario("objects: [{node: ball, trajectory: way.csv}]");
    const auto scene = load_scene(scenario);
    ASSERT_EQ(scene->movers().size(), 1);
    EXPECT_EQ(scene->movers()[0].name, "ball");
    EXPECT_NEAR(scene->movers()[0].rest.position.x, -3, 1e-6) << "where the file puts it";
    Movers movers(scenario, scene);
    EXPECT_NEAR(movers.at(from_seconds(5)).at(0).position.x, 2.5, 1e-9);
    EXPECT_NEAR(movers.motions(from_seconds(5)).at(0).velocity.x, 0.3, 1e-6);
    EXPECT_EQ(movers.motions(from_seconds(11)).at(0), Motion{});
    EXPECT_NEAR(movers.reach().at(0), 0.4, 0.3) << "a ball of 0.4 m: the corner of its box at most";
}

TEST(Movers, APlaceInTheScenarioCountsFromTheStart) {
    const Tank tank;
    const Scenario scenario =
        tank.scenario("objects: [{node: post, pose: {position: [2, 1, -4], rpy_deg: [0, 90, 0]}}]");
    Movers movers(scenario, load_scene(scenario));
    EXPECT_EQ(movers.at({}).at(0).position, (Vec3{2, 1, -4}));
}

TEST(Movers, WithoutObjectsNothingMoves) {
    const Tank tank;
    const auto scene = load_scene(tank.scenario(""));
    EXPECT_TRUE(scene->movers().empty());
    EXPECT_EQ(scene->still_nodes(), scene->nodes().size());
}

TEST(Movers, AnUnknownNodeIsNamedWithItsPlaceAndItsNeighbour) {
    const Tank tank;
    EXPECT_THAT(
        tank.fault("objects: [{node: bal}]"),
        testing::HasSubstr("tank.yaml:2:18: objects: the scene has no node 'bal'; did you mean 'ball'?"));
    EXPECT_THAT(tank.fault("objects: [{node: ball}, {node: ball}]"), testing::HasSubstr("moves in two ways"));
    EXPECT_THAT(tank.fault("objects: [{pose: {position: [0, 0, 0]}}]"),
                testing::HasSubstr("node is missing"));
    EXPECT_THAT(tank.fault("objects: [{node: ball, trajectory: no.csv}]"),
                testing::HasSubstr("objects[0].trajectory: "));
    EXPECT_THAT(tank.fault("objects: [{node: ball, input: 'udp://127.0.0.1:1'}]"),
                testing::HasSubstr("only sends"));
    EXPECT_THAT(tank.fault("objects: {node: ball}"), testing::HasSubstr("expected a list"));
    EXPECT_THAT(tank.fault("animations: sometimes"),
                testing::HasSubstr("animations: unknown value 'sometimes'"));
}

}  // namespace
}  // namespace echoloop
