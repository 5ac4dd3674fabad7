// What a good scenario becomes, and how --set changes it.
#include "emulator/scenario/scenario.h"

#include <gmock/gmock.h>

#include <fstream>

#include "emulator/scenario/profile_section.h"
#include "tests/emulator/scenario_texts.h"

namespace echoloop {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Scenario, leaves_every_optional_key_at_its_default) {
    const auto scenario = parse(smallest);
    EXPECT_EQ(scenario.scene, "s.glb");
    EXPECT_EQ(scenario.seed, 1);
    EXPECT_EQ(scenario.water, (Water{10, 35, 8, 0, {}, {}, {{0, -75}}}));
    EXPECT_EQ(scenario.world_from_body, Pose{});
    EXPECT_EQ(scenario.clock, ClockMode::real);
    EXPECT_EQ(scenario.render.rule, EchoRule::radiometric);
    EXPECT_EQ(scenario.render.context, "auto");
    EXPECT_EQ(scenario.render.sampler, "auto");
    ASSERT_EQ(scenario.devices.size(), 1);
    const auto& device = scenario.devices[0];
    EXPECT_EQ(device.model, &test_models()[2]);
    EXPECT_EQ(device.body_from_sonar, Pose{});
    EXPECT_THAT(device.config.endpoints, ElementsAre(parse_endpoint("pty:/tmp/echoloop/micron")));
    EXPECT_EQ(std::get<double>(device.config.options.at("gain")), 50);
    EXPECT_EQ(std::get<std::int64_t>(device.config.options.at("bins")), 400);
    EXPECT_EQ(device.config.options.size(), 5);
    EXPECT_EQ(device.line, 2);
    EXPECT_EQ(device.column, 11);
}

TEST(Scenario, reads_every_key) {
    const auto scenario = parse(complete);
    EXPECT_EQ(scenario.seed, 18446744073709551615ULL);
    EXPECT_EQ(scenario.water, (Water{4.5, 0, 7, 12, 1480, {}, {{0, -95}}}));
    EXPECT_EQ(scenario.clock, ClockMode::scaled);
    EXPECT_EQ(scenario.clock_rate, 5);
    EXPECT_EQ(scenario.render.rule, EchoRule::cerqueira2016);
    EXPECT_EQ(scenario.render.context, "osmesa");
    EXPECT_EQ(scenario.render.sampler, "rays");
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

constexpr auto on_earth = R"(
scene: s.glb
origin: {latitude: 59.4, longitude: 10.5, height: 100}
vehicle: {pose: {latitude: 59.401, longitude: 10.502, altitude: 97, rpy_deg: [0, 0, 90]}}
objects: [{node: buoy, pose: {latitude: 59.4, longitude: 10.5, depth: -100}}]
devices: [{name: micron, model: tritech-micron}]
)";

TEST(Scenario, places_on_the_earth_become_metres) {
    const auto scenario = parse(on_earth);
    // A minute of latitude is 1856.9 m at 59.4 deg N, one of longitude 947.4 m: WGS 84's radii of curvature.
    EXPECT_NEAR(scenario.world_from_body.position.x, 947.4 * 0.12, 0.1);
    EXPECT_NEAR(scenario.world_from_body.position.y, 1856.9 * 0.06, 0.1);
    EXPECT_DOUBLE_EQ(scenario.world_from_body.position.z, -3);
    EXPECT_EQ(scenario.world_from_body.orientation, from_rpy(0, 0, deg_to_rad(90)));
    ASSERT_TRUE(scenario.objects[0].pose);
    EXPECT_EQ(scenario.objects[0].pose->position, (Vec3{0, 0, 0}));
    EXPECT_DOUBLE_EQ(parse(on_earth, {"vehicle.pose.altitude=90"}).world_from_body.position.z, -10);
}

TEST(Scenario, places_on_the_earth_count_from_the_scenes_origin) {
    in_scenario_folder();
    std::ofstream("o.gltf") << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [],
        "extras": {"sonar": {"origin": {"latitude": 59.4, "longitude": 10.5, "height": 10}}}}]})";
    std::string text = on_earth;
    text.erase(text.find("origin:"), text.find("vehicle:") - text.find("origin:"));
    EXPECT_THAT(refusal(text), HasSubstr("vehicle.pose.latitude: "));
    EXPECT_DOUBLE_EQ(parse(text, {"scene=o.gltf"}).world_from_body.position.z, 87);
    std::ofstream("o.gltf") << R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}]})";
    EXPECT_THAT(
        refusal(text, {"scene=o.gltf"}),
        HasSubstr("vehicle.pose.latitude: nothing says where the world lies on the Earth; add origin"));
}

TEST(Scenario, places_on_the_earth_are_told_whole) {
    const auto told = [](const std::string& pose) {
        return refusal("scene: s.glb\norigin: {latitude: 59.4, longitude: 10.5}\nvehicle: {pose: {" + pose +
                       "}}\ndevices: [{name: micron, model: tritech-micron}]\n");
    };
    EXPECT_THAT(told("latitude: 59.4, depth: 3"),
                HasSubstr("t.yaml:3:17: vehicle.pose.longitude: is missing"));
    EXPECT_THAT(told("latitude: 59.4, longitude: 10.5"), HasSubstr("altitude or depth in m belongs to"));
    EXPECT_THAT(told("latitude: 59.4, longitude: 10.5, depth: 3, altitude: 3"), HasSubstr("one of them"));
    EXPECT_THAT(told("latitude: 59.4, longitude: 10.5, depth: 3, position: [0, 0, 0]"),
                HasSubstr("vehicle.pose.position: latitude and longitude say where it is"));
    EXPECT_THAT(told("latitude: 91, longitude: 10.5, depth: 3"), HasSubstr("vehicle.pose.latitude"));
    EXPECT_THAT(told("latitude: -59.4, longitude: 10.5, depth: 3"), HasSubstr("is the origin right?"));
    EXPECT_THAT(told("altitude: 3"), HasSubstr("latitude: is missing"));
    EXPECT_EQ(told("latitude: 59.4, longitude: 10.5, depth: 3"), "accepted");
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

std::string with_mount(const std::string& mount, const std::string& more = "") {
    return "scene: s.glb\n" + more + "devices: [{name: micron, model: tritech-micron, mount: {" + mount +
           "}}]\n";
}

TEST(Scenario, a_mount_may_move) {
    const auto device =
        parse(with_mount("rpy_deg: [0, 10, 0], swing: {axis: yaw, angle_deg: 30, period: 4}")).devices[0];
    EXPECT_EQ(device.mount_swing.axis, MountSwing::Axis::yaw);
    EXPECT_NEAR(device.mount_swing.angle, deg_to_rad(30), 1e-12);
    EXPECT_EQ(device.mount_swing.period, 4);
    EXPECT_EQ(parse(with_mount("input: 'udp-listen://127.0.0.1:9600'")).devices[0].mount_input,
              "udp-listen://127.0.0.1:9600");
    const auto refused = [](const std::string& text) {
        try {
            parse(text);
        } catch (const ScenarioError& error) {
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    EXPECT_THAT(refused(with_mount("swing: {}, input: stdin")),
                HasSubstr("devices.micron.mount.input: the mount moves in two ways"));
    EXPECT_THAT(refused(with_mount("swing: {axis: up}")), HasSubstr("roll"));
    EXPECT_THAT(refused(with_mount("position: [0, 0, 0], trajectory: none.csv")), HasSubstr("none.csv"));
    EXPECT_THAT(refused(with_mount("input: 'udp-listen://127.0.0.1:9500'",
                                   "vehicle: {input: 'udp-listen://127.0.0.1:9500'}\n")),
                HasSubstr("127.0.0.1:9500"));
}

TEST(Scenario, whole_numbers_may_be_hexadecimal) {
    const auto bins = [&](const std::string& text) {
        const auto scenario = parse(
            "scene: s.glb\ndevices: [{name: p, model: tritech-micron, options: {bins: " + text + "}}]\n");
        return std::get<std::int64_t>(scenario.devices[0].config.options.at("bins"));
    };
    EXPECT_EQ(bins("0x1f4"), 500);
    EXPECT_EQ(bins("0x5DC"), 1500);
    EXPECT_EQ(bins("500"), 500);
    for (const char* wrong : {"0x", "0x-1", "0xG", "0x1FFFFFFFF", "8003h", "'0x10'"})
        EXPECT_THROW(bins(wrong), ScenarioError) << wrong;
}

TEST(Scenario, fills_endpoints_that_are_left_out_from_the_models_defaults) {
    EXPECT_THAT(
        parse(complete).devices[1].config.endpoints,
        ElementsAre(parse_endpoint("udp-listen://127.0.0.1:4000"), parse_endpoint("udp://127.0.0.1:65400")));
}

TEST(Scenario, takes_more_endpoints_than_the_default_for_the_device_to_judge) {
    const auto scenario = parse(smallest, {"devices.micron.endpoints=[pty:/tmp/a, pty:/tmp/b]"});
    EXPECT_THAT(scenario.devices[0].config.endpoints,
                ElementsAre(parse_endpoint("pty:/tmp/a"), parse_endpoint("pty:/tmp/b")));
}

TEST(Scenario, takes_the_depth_and_the_sound_speed_from_where_the_vehicle_is) {
    const auto scenario = parse(smallest, {"vehicle.pose.position=[0, 0, -100]"});
    EXPECT_EQ(scenario.water.depth, 100);
    EXPECT_DOUBLE_EQ(scenario.devices[0].config.sound_speed, mackenzie_sound_speed(10, 35, 100));
    EXPECT_EQ(parse(smallest, {"vehicle.pose.position=[0, 0, 5]"}).water.depth, 0);
}

TEST(Scenario, finds_the_scene_beside_the_file) {
    in_scenario_folder();
    std::filesystem::create_directories("below");
    std::ofstream("below/t.yaml") << "scene: ../s.glb\ndevices: [{name: a, model: r2sonic-2024}]\n";
    EXPECT_EQ(load_scenario("below/t.yaml", {}, test_models()).scene, "below/../s.glb");
}

TEST(Effects, are_all_on_and_each_goes_off_by_its_name) {
    EXPECT_EQ(parse(smallest).render.effects, Effects{});
    for (const auto& row : effect_rows) {
        const auto effects = parse(smallest, {"effects." + std::string(row.name) + "=off"}).render.effects;
        EXPECT_EQ(effects, Effects{}.set(row.effect, false)) << row.name;
    }
}

TEST(Effects, all_counts_before_the_names_wherever_it_stands) {
    const auto text = std::string(smallest) + "effects: {noise: on, all: off, tvg: true}\n";
    EXPECT_EQ(parse(text).render.effects, Effects::none().set(Effect::noise).set(Effect::tvg));
    const auto fewer = parse(text, {"effects.noise=false"});
    EXPECT_EQ(fewer.render.effects, Effects::none().set(Effect::tvg));
    EXPECT_EQ(fewer.devices[0].config.effects, fewer.render.effects) << "the device does its own gain";
}

TEST(Effects, speckle_may_have_a_shape) {
    const auto scenario = parse(smallest, {"effects.all=off", "effects.speckle={shape: 4}"});
    EXPECT_EQ(scenario.render.speckle.shape, 4);
    EXPECT_EQ(scenario.render.effects, Effects::none().set(Effect::speckle));
    EXPECT_EQ(parse(smallest).render.speckle.shape, std::numeric_limits<double>::infinity());
}

TEST(WaterSection, says_what_floats_in_it) {
    using Points = std::vector<ScatteringPoint>;
    const auto of = [](const char* set) { return parse(smallest, {set}).water.scattering; };
    EXPECT_EQ(parse(smallest).water.scattering, of("water.scattering=clear"));
    EXPECT_EQ(of("water.salinity=0"), of("water.scattering=pure"));
    EXPECT_EQ(of("water.scattering=none"), Points{});
    EXPECT_EQ(of("water.scattering=-66.5"), (Points{{0, -66.5}}));
    EXPECT_EQ(of("water.scattering=[[0, -50], [10, -70]]"), (Points{{0, -50}, {10, -70}}));
    EXPECT_LT(of("water.scattering=clear")[0].strength, of("water.scattering=turbid")[0].strength);
    EXPECT_THAT(
        refusal(smallest, {"water.scattering=murky"}),
        HasSubstr("water.scattering: expected pure, clear, coastal, turbid or none, or dB, as in -70"));
    EXPECT_THAT(refusal(smallest, {"water.scattering=12"}), HasSubstr("-150 to 0 dB"));
    EXPECT_THAT(refusal(smallest, {"water.scattering=[[5, -50], [2, -60]]"}), HasSubstr("sort the points"));
}

TEST(WaterSection, the_wind_makes_waves) {
    const auto of = [](const char* set) { return *parse(smallest, {set}).render.surface; };
    EXPECT_EQ(of("water.surface={wind: 5}").wind, 5);
    EXPECT_NEAR(of("water.surface={wind: 5}").slope, 0.095, 0.001);
    EXPECT_NEAR(of("water.surface={wind: 10}").roughness, 0.53, 0.01);
    EXPECT_EQ(of("water.surface={wind: 10, roughness: 0.2}").roughness, 0.2);
    EXPECT_EQ(of("water.surface={roughness: 0}").wind, 0) << "a mirror";
    EXPECT_THAT(refusal(smallest, {"water.surface={wind: -1}"}), HasSubstr("0 to 40 m/s"));
}

TEST(WaterSection, has_a_profile_and_a_surface) {
    const auto layered =
        parse(smallest, {"water.profile=[[0, 1500], [20, 1490]]", "vehicle.pose={position: [0, 0, -10]}"});
    EXPECT_EQ(layered.water.profile, (std::vector<SoundSpeedPoint>{{0, 1500}, {20, 1490}}));
    EXPECT_DOUBLE_EQ(layered.devices[0].config.sound_speed, 1495) << "what the head's own sensor measures";
    EXPECT_EQ(parse(smallest).render.surface->height, 0);
    const auto rough = parse(smallest, {"water.surface={height: 2, roughness: 0.05}"});
    EXPECT_EQ(rough.render.surface->roughness, 0.05);
    EXPECT_EQ(rough.water.depth, 2) << "the vehicle at z = 0 is 2 m deep";
    EXPECT_FALSE(parse(smallest, {"water.surface=none"}).render.surface.has_value());
}

double source_level(const Scenario& scenario) {
    return figure(scenario.devices[0].config.profile, "source_level");
}

TEST(ProfileSection, a_scenario_may_override_single_figures) {
    EXPECT_EQ(source_level(parse(smallest)), 206);
    const auto louder = parse(smallest, {"devices.micron.profile={source_level: 210, aperture: piston}"});
    EXPECT_EQ(source_level(louder), 210);
    const auto& profile = louder.devices[0].config.profile;
    EXPECT_EQ(profile.at("source_level").source, "scenario");
    EXPECT_EQ(figure_of<std::string>(profile, "aperture"), "piston");
    EXPECT_EQ(profile.at("bits").source, "own choice") << "the others stay";
}

TEST(ProfileSection, a_scenario_may_bring_a_file_of_its_own) {
    in_scenario_folder();
    std::ofstream("mine.yaml") << "model: tritech-micron\nbits: {value: 12, source: bench}\n"
                                  "source_level: {value: 190, unit: dB re 1 uPa, source: tank}\n"
                                  "aperture: {value: piston, source: drawing}\n";
    const auto scenario = parse(smallest, {"devices.micron.profile_file=mine.yaml"});
    EXPECT_EQ(source_level(scenario), 190);
    EXPECT_EQ(source_level(parse(smallest, {"devices.micron.profile_file=mine.yaml",
                                            "devices.micron.profile.source_level=191"})),
              191);
}

TEST(ProfileSection, a_broken_file_is_refused_with_its_own_places) {
    in_scenario_folder();
    std::ofstream("broken.yaml") << "model: r2sonic-2024\n"
                                    "source_level: {value: 600, unit: dB, sorce: tank}\n"
                                    "bits: 24\n"
                                    "gain: {value: 3, source: tank}\n";
    const auto text = refusal(smallest, {"devices.micron.profile_file=broken.yaml"});
    EXPECT_THAT(text, StartsWith("broken.yaml:1:")) << "in the order of the file";
    EXPECT_THAT(text, HasSubstr("broken.yaml:1:8: model: expected 'tritech-micron', the model of the device, "
                                "got text 'r2sonic-2024'"));
    EXPECT_THAT(text, HasSubstr("broken.yaml:2:23: source_level.value: 600 is out of range"));
    EXPECT_THAT(text,
                HasSubstr("broken.yaml:2:34: source_level.unit: expected 'dB re 1 uPa', got text 'dB'"));
    EXPECT_THAT(text, HasSubstr("broken.yaml:2:38: unknown key 'sorce' in source_level; did you mean "
                                "'source'?"));
    EXPECT_THAT(text, HasSubstr("source_level.source is missing; name the document"));
    EXPECT_THAT(text, HasSubstr("broken.yaml:3:7: bits: expected keys and values, got the number '24'"));
    EXPECT_THAT(text, HasSubstr("broken.yaml:4:1: unknown key 'gain' in the profile"));
    EXPECT_THAT(text, HasSubstr("figure 'aperture' is missing; add aperture: {value: , "));
}

TEST(ProfileSection, a_broken_profile_of_the_program_itself_is_refused) {
    Model model = test_models()[2];
    model.profile = "model: tritech-micron\nbits: {value: [}\n";
    try {
        own_profile(model);
        FAIL() << "accepted";
    } catch (const ScenarioError& error) {
        EXPECT_THAT(error.what(), HasSubstr("config/devices/tritech-micron.yaml:2:"));
        EXPECT_THAT(error.what(), HasSubstr("not YAML"));
    }
}

TEST(Yaml, a_tab_is_named_where_it_stands) {
    for (const char* text : {"scene: a.glb\nwater:\n\tdepth: 1\n", "scene: a.glb\nwater:\n  \tdepth: 1\n"}) {
        try {
            parse(text);
            FAIL() << "accepted";
        } catch (const ScenarioError& error) {
            EXPECT_THAT(error.what(), HasSubstr(":3:"));
            EXPECT_THAT(error.what(), HasSubstr("begins with a tab"));
        }
    }
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
    EXPECT_THAT(scenario.devices[0].config.endpoints, ElementsAre(parse_endpoint("pty:/tmp/other")));
}

TEST(Override, the_last_one_counts) { EXPECT_EQ(parse(smallest, {"seed=2", "seed=3"}).seed, 3); }

}  // namespace
}  // namespace echoloop
