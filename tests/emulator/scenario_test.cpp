// What a good scenario becomes, how --set changes it, and that no bytes can hurt the loader.
#include "emulator/scenario/scenario.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <chrono>
#include <fstream>

#include "tests/emulator/scenario_folder.h"
#include "tests/emulator/scenario_models.h"

namespace echoloop {
namespace {

using test::in_scenario_folder;
using test::test_models;
using testing::ElementsAre;
using testing::HasSubstr;

Scenario parse(const std::string& text, const std::vector<std::string>& sets = {}) {
    in_scenario_folder();
    return parse_scenario(text, "t.yaml", sets, test_models());
}

std::string refusal(const std::string& text, const std::vector<std::string>& sets = {}) {
    try {
        parse(text, sets);
    } catch (const ScenarioError& error) {
        return error.what();
    }
    return "accepted";
}

constexpr auto smallest = "scene: s.glb\ndevices: [{name: micron, model: tritech-micron}]\n";

constexpr auto complete = R"(
scene: s.glb
seed: 18446744073709551615
water: {temperature: 4.5, salinity: 0, ph: 7, depth: 12, sound_speed: 1480}
vehicle:
  pose: {position: [1, -2.5, -3], rpy_deg: [0, 0, 90]}
clock: {mode: scaled, rate: 5}
render: {rule: cerqueira2016, context: osmesa, pixels: 2}
devices:
  - name: front
    model: tritech-micron
    mount: {position: [0.4, 0, 0.1], rpy_deg: [180, 0, 0]}
    endpoints: ["serial:///dev/ttyUSB0:115200"]
    options: {gain: 20, bins: 200, inverted: true, profile: miniking, serial_number: 0042}
  - {name: fan, model: r2sonic-2024, endpoints: ["udp-listen://localhost:4000"]}
)";

TEST(Scenario, leaves_every_optional_key_at_its_default) {
    const auto scenario = parse(smallest);
    EXPECT_EQ(scenario.scene, "s.glb");
    EXPECT_EQ(scenario.seed, 1);
    EXPECT_EQ(scenario.water, Water{});
    EXPECT_EQ(scenario.world_from_body, Pose{});
    EXPECT_EQ(scenario.clock, ClockMode::real);
    EXPECT_EQ(scenario.render.rule, EchoRule::radiometric);
    EXPECT_EQ(scenario.render.context, "auto");
    ASSERT_EQ(scenario.devices.size(), 1);
    const auto& device = scenario.devices[0];
    EXPECT_EQ(device.model, &test_models()[2]);
    EXPECT_EQ(device.body_from_sonar, Pose{});
    EXPECT_THAT(device.config.endpoints, ElementsAre("pty:/tmp/echoloop/micron"));
    EXPECT_EQ(std::get<double>(device.config.options.at("gain")), 50);
    EXPECT_EQ(std::get<std::int64_t>(device.config.options.at("bins")), 400);
    EXPECT_EQ(device.config.options.size(), 5);
    EXPECT_EQ(device.line, 2);
    EXPECT_EQ(device.column, 11);
}

TEST(Scenario, reads_every_key) {
    const auto scenario = parse(complete);
    EXPECT_EQ(scenario.seed, 18446744073709551615ULL);
    EXPECT_EQ(scenario.water, (Water{4.5, 0, 7, 12, 1480}));
    EXPECT_EQ(scenario.clock, ClockMode::scaled);
    EXPECT_EQ(scenario.clock_rate, 5);
    EXPECT_EQ(scenario.render.rule, EchoRule::cerqueira2016);
    EXPECT_EQ(scenario.render.context, "osmesa");
    EXPECT_EQ(scenario.render.pixel_density, 2);
    ASSERT_EQ(scenario.devices.size(), 2);
    const auto& options = scenario.devices[0].config.options;
    EXPECT_EQ(std::get<double>(options.at("gain")), 20);
    EXPECT_EQ(std::get<std::int64_t>(options.at("bins")), 200);
    EXPECT_TRUE(std::get<bool>(options.at("inverted")));
    EXPECT_EQ(std::get<std::string>(options.at("profile")), "miniking");
    EXPECT_EQ(std::get<std::string>(options.at("serial_number")), "0042");
    EXPECT_EQ(scenario.devices[0].config.sound_speed, 1480);
}

TEST(Scenario, poses_are_metres_and_degrees_in_ENU) {
    const auto scenario = parse(complete);
    // A yaw of 90 degrees turns the bow from east to north.
    const Vec3 bow = scenario.world_from_body * Vec3{1, 0, 0};
    EXPECT_NEAR(bow.x, 1, 1e-12);
    EXPECT_NEAR(bow.y, -1.5, 1e-12);
    EXPECT_NEAR(bow.z, -3, 1e-12);
    // A roll of 180 degrees puts the head upside down.
    const Vec3 top = scenario.devices[0].body_from_sonar * Vec3{0, 0, 1};
    EXPECT_NEAR(top.z, 0.1 - 1, 1e-12);
}

TEST(Scenario, fills_endpoints_that_are_left_out_from_the_models_defaults) {
    EXPECT_THAT(parse(complete).devices[1].config.endpoints,
                ElementsAre("udp-listen://127.0.0.1:4000", "udp://127.0.0.1:65400"));
}

TEST(Scenario, takes_more_endpoints_than_the_default_for_the_device_to_judge) {
    const auto scenario = parse(smallest, {"devices.micron.endpoints=[pty:/tmp/a, pty:/tmp/b]"});
    EXPECT_THAT(scenario.devices[0].config.endpoints, ElementsAre("pty:/tmp/a", "pty:/tmp/b"));
}

TEST(Scenario, takes_the_depth_and_the_sound_speed_from_where_the_vehicle_is) {
    const auto scenario = parse(smallest, {"vehicle.pose.position=[0, 0, -100]"});
    EXPECT_EQ(scenario.water.depth, 100);
    EXPECT_DOUBLE_EQ(scenario.devices[0].config.sound_speed, mackenzie_sound_speed(10, 35, 100));
    EXPECT_EQ(parse(smallest, {"vehicle.pose.position=[0, 0, 5]"}).water.depth, 0);
}

TEST(Scenario, gives_each_device_a_seed_of_its_own_that_others_do_not_change) {
    const auto alone = parse(smallest);
    const auto both = parse(
        "scene: s.glb\ndevices:\n- {name: fan, model: r2sonic-2024}\n- {name: micron, model: "
        "tritech-micron}\n");
    EXPECT_EQ(alone.devices[0].config.seed, both.devices[1].config.seed);
    EXPECT_NE(both.devices[0].config.seed, both.devices[1].config.seed);
    EXPECT_NE(parse(smallest, {"seed=2"}).devices[0].config.seed, alone.devices[0].config.seed);
}

TEST(Scenario, finds_the_scene_beside_the_file) {
    in_scenario_folder();
    std::filesystem::create_directories("below");
    std::ofstream("below/t.yaml") << "scene: ../s.glb\ndevices: [{name: a, model: r2sonic-2024}]\n";
    EXPECT_EQ(load_scenario("below/t.yaml", {}, test_models()).scene, "below/../s.glb");
}

TEST(Override, changes_devices_by_name_and_by_number) {
    const auto scenario = parse(complete, {"devices.front.options.gain=75", "devices.1.name=renamed",
                                           "seed=7", "vehicle.pose.position=[0,0,-9]"});
    EXPECT_EQ(std::get<double>(scenario.devices[0].config.options.at("gain")), 75);
    EXPECT_EQ(scenario.devices[1].name, "renamed");
    EXPECT_EQ(scenario.seed, 7);
    EXPECT_EQ(scenario.world_from_body.position.z, -9);
}

TEST(Override, makes_maps_that_the_file_does_not_have) {
    const auto scenario =
        parse(smallest, {"water.temperature=4", "devices.micron.endpoints=[pty:/tmp/other]"});
    EXPECT_EQ(scenario.water.temperature, 4);
    EXPECT_THAT(scenario.devices[0].config.endpoints, ElementsAre("pty:/tmp/other"));
}

TEST(Override, the_last_one_counts) { EXPECT_EQ(parse(smallest, {"seed=2", "seed=3"}).seed, 3); }

TEST(ScenarioLimits, an_alias_may_be_used_and_is_read_each_time) {
    const auto scenario = parse(
        "scene: s.glb\ndevices:\n- {name: a, model: tritech-micron, options: &o {gain: 1}}\n"
        "- {name: b, model: tritech-micron, options: *o, endpoints: ['pty:/tmp/b']}\n");
    EXPECT_EQ(std::get<double>(scenario.devices[1].config.options.at("gain")), 1);
}

TEST(ScenarioLimits, an_alias_bomb_is_refused_early) {
    std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 30; ++i) {
        const auto last = "*a" + std::to_string(i - 1);
        bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last;
        for (int k = 0; k < 9; ++k) bomb += ", " + last;
        bomb += "]\n";
    }
    EXPECT_THAT(refusal(bomb), HasSubstr("more than 20000 values, aliases counted"));
}

TEST(ScenarioLimits, long_text_behind_many_aliases_is_refused) {
    std::string text = "a: &a " + std::string(500'000, 'x') + "\nb: [*a";
    for (int i = 0; i < 10'000; ++i) text += ", *a";
    EXPECT_THAT(refusal(text + "]\n"), HasSubstr("too much text, aliases counted"));
}

TEST(ScenarioLimits, deep_nesting_is_refused) {
    EXPECT_THAT(refusal("a: " + std::string(100, '[') + std::string(100, ']')),
                HasSubstr("nested deeper than 64"));
    EXPECT_NE(refusal(std::string(500'000, '[')), "accepted");
    EXPECT_NE(refusal(std::string(500'000, '{')), "accepted");
    EXPECT_NE(refusal(std::string(200'000, '-')), "accepted");
}

TEST(ScenarioLimits, a_value_that_contains_itself_is_refused) {
    EXPECT_THAT(refusal("a: &a [*a]\n"), HasSubstr("t.yaml:1:8: an alias to a value that contains it"));
}

TEST(ScenarioLimits, so_many_faults_that_nobody_reads_them_are_cut) {
    std::string text(smallest);
    for (int i = 0; i < 5000; ++i) text += "key" + std::to_string(i) + ": 1\n";
    try {
        parse(text);
        FAIL() << "accepted";
    } catch (const ScenarioError& error) {
        EXPECT_EQ(error.problems().size(), 101);
    }
}

TEST(ScenarioFile, says_what_is_wrong_with_the_file_itself) {
    in_scenario_folder();
    const auto exit_and_text = [](const std::filesystem::path& file) {
        try {
            load_scenario(file, {}, test_models());
        } catch (const ScenarioError& error) {
            return std::to_string(static_cast<int>(error.exit())) + " " + error.what();
        }
        return std::string("accepted");
    };
    std::filesystem::create_directories("folder");
    std::ofstream("large.yaml") << std::string((1 << 20) + 1, '#');
    EXPECT_EQ(exit_and_text("none.yaml"), "66 none.yaml: no such file");
    EXPECT_EQ(exit_and_text("folder"), "66 folder: not a regular file");
    EXPECT_EQ(exit_and_text("/dev/zero"), "66 /dev/zero: not a regular file");
    EXPECT_EQ(exit_and_text("large.yaml"), "78 large.yaml: larger than 1 MiB; this is not a scenario");
}

RC_GTEST_PROP(ScenarioBytes, random_bytes_are_refused_or_read_and_never_crash, (const std::string& bytes)) {
    refusal(bytes);
    refusal(smallest + bytes);
    refusal(smallest, {bytes, "devices.micron." + bytes});
}

RC_GTEST_PROP(ScenarioBytes, a_scenario_with_one_changed_byte_is_refused_or_read, ()) {
    std::string text(complete);
    text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
    refusal(text);
    refusal(text.substr(0, *rc::gen::inRange<std::size_t>(0, text.size())));
}

}  // namespace
}  // namespace echoloop
