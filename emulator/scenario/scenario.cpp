#include "emulator/scenario/scenario.h"

#include "emulator/scenario/clock_section.h"
#include "emulator/scenario/control_place.h"
#include "emulator/scenario/device_section.h"
#include "emulator/scenario/effects_section.h"
#include "emulator/scenario/faults_section.h"
#include "emulator/scenario/file.h"
#include "emulator/scenario/number.h"
#include "emulator/scenario/objects_section.h"
#include "emulator/scenario/override.h"
#include "emulator/scenario/pose_section.h"
#include "emulator/scenario/section.h"
#include "emulator/scenario/water_section.h"
#include "emulator/scenario/yaml.h"

namespace echoloop {
namespace {

using namespace scenario;

Value parse_tree(const std::string& text, Problems& problems) {
    try {
        return parse_yaml(text);
    } catch (const YamlError& error) {
        problems.add(error.place, error.message);
        problems.throw_if_any();
        throw;  // not reached
    }
}

std::filesystem::path read_scene(const Section& top, const std::filesystem::path& file, Problems& problems) {
    const Value* value = top.get("scene");
    if (value == nullptr) {
        problems.add(top.place(), "the scenario has no scene; add e.g. scene: scenes/tank.glb");
        return {};
    }
    const std::filesystem::path given = top.text("scene", "");
    const auto scene = file.parent_path() / given;
    if (given.empty()) {
        if (value->is_scalar()) problems.add(value->place, "scene: expected the name of a glTF file");
    } else if (const auto fault = file_fault(scene)) {
        problems.add(value->place,
                     "scene: " + in_quotes(scene.string()) + ": " + fault->message +
                         "; a relative path starts at the scenario's folder",
                     fault->kind);
    }
    return scene;
}

std::optional<GeoPlace> read_origin(const Section& top, Problems& problems) {
    const Value* value = top.get("origin");
    if (value == nullptr) return {};
    const Section origin(value, "origin", {"latitude", "longitude", "height"}, problems);
    for (const char* const key : {"latitude", "longitude"})
        if (value->is_map() && origin.get(key) == nullptr)
            problems.add(value->place, "origin." + std::string(key) +
                                           ": is missing, as in origin: {latitude: 59.4, longitude: 10.5}");
    return GeoPlace{origin.number("latitude", 0, {-geographic::steepest, geographic::steepest, "deg"}),
                    origin.number("longitude", 0, {-180, 180, "deg"}),
                    origin.number("height", 0, {-geographic::highest, geographic::highest, "m"})};
}

std::uint64_t read_seed(const Section& top, Problems& problems) {
    const Value* value = top.get("seed");
    if (value == nullptr) return 1;
    const auto seed =
        value->is_scalar() && !value->quoted ? parse_as<std::uint64_t>(value->text) : std::nullopt;
    if (!seed)
        problems.add(value->place,
                     "seed: expected a whole number, 0 to 18446744073709551615, got " + describe(*value));
    return seed.value_or(1);
}

void read_vehicle(const Section& top, Scenario& scenario, Problems& problems) {
    const Section vehicle(top.get("vehicle"), "vehicle", {"pose", "trajectory", "input"}, problems);
    scenario.world_from_body = read_pose(vehicle.get("pose"), "vehicle.pose", scenario, problems);
    scenario.pose_input = read_pose_endpoint(vehicle, "input", problems);
    const Value* value = vehicle.get("trajectory");
    if (value == nullptr) return;
    for (const auto* other : {"pose", "input"})
        if (vehicle.get(other) != nullptr)
            problems.add(
                value->key_place,
                "vehicle.trajectory says where the vehicle is; remove it or vehicle." + std::string(other));
    scenario.trajectory = read_trajectory_name(vehicle, scenario.file, problems);
}

Animations read_animations(const Section& top) {
    const auto word = top.word("animations", "loop", {"loop", "once", "off"});
    return word == "off" ? Animations::off : word == "once" ? Animations::once : Animations::loop;
}

std::string read_control(const Section& top, Problems& problems) {
    const Value* value = top.get("control");
    if (value == nullptr) return {};
    std::string text = top.text("control", "");
    try {
        if (value->is_scalar()) parse_control_place(text);
    } catch (const std::invalid_argument& error) {
        problems.add(value->place, std::string("control: ") + error.what());
    }
    return text;
}

std::vector<Network> read_peers(const Section& top, Problems& problems) {
    constexpr std::size_t most = 64;
    const Value* list = top.get("peers");
    if (list == nullptr) return {};
    if (!list->is_sequence() || list->items.empty() || list->items.size() > most) {
        problems.add(list->place, "peers: expected a list of 1 to 64 networks, as in [192.168.2.0/24]");
        return {};
    }
    std::vector<Network> peers;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
        const Value& value = list->items[i];
        const std::string path = "peers." + std::to_string(i);
        std::string text;
        if (!Checker(problems).text(value, path, text)) continue;
        try {
            peers.push_back(parse_network(text));
        } catch (const std::invalid_argument& error) {
            problems.add(value.place, path + ": " + error.what());
        }
    }
    return peers;
}

RendererOptions read_render(const Section& top, Problems& problems) {
    const Section section(top.get("render"), "render", {"rule", "context", "sampler", "pixels"}, problems);
    RendererOptions options;
    const auto rule = section.word("rule", "radiometric", {"radiometric", "cerqueira2016"});
    options.rule = rule == "radiometric" ? EchoRule::radiometric : EchoRule::cerqueira2016;
    options.context =
        section.word("context", options.context, {"auto", "osmesa", "egl-surfaceless", "egl-device"});
    options.sampler = section.word("sampler", options.sampler, {"auto", "raster", "native", "rays"});
    options.pixel_density =
        section.number("pixels", options.pixel_density, {0.1, 64, "times the usual number"});
    return options;
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::filesystem::path& file,
                        const std::vector<std::string>& set_arguments, std::span<const Model> models) {
    Problems problems(file.string(), set_arguments);
    Value root = parse_tree(text, problems);
    apply_overrides(root, set_arguments, problems);
    const Section top(&root, "",
                      {"scene", "origin", "seed", "water", "vehicle", "objects", "animations", "clock",
                       "render", "effects", "peers", "devices", "faults", "control", "sweep"},
                      problems);
    if (!root.is_map() && root.kind != Value::Kind::null) problems.throw_if_any();
    Scenario scenario;
    scenario.file = file;
    scenario.scene = read_scene(top, file, problems);
    scenario.origin = read_origin(top, problems);
    scenario.seed = read_seed(top, problems);
    read_vehicle(top, scenario, problems);
    scenario.objects = read_objects(top.get("objects"), scenario, problems);
    scenario.animations = read_animations(top);
    read_clock(top, scenario, problems);
    scenario.render = read_render(top, problems);
    read_effects(top.get("effects"), scenario.render, problems);
    const Section water(
        top.get("water"), "water",
        {"temperature", "salinity", "ph", "depth", "sound_speed", "profile", "scattering", "surface"},
        problems);
    scenario.render.surface = read_surface(water, problems);
    const double surface = scenario.render.surface.value_or(WaterSurface{}).height;
    scenario.water = read_water(water, scenario.world_from_body.position.z, surface, problems);
    scenario.peers = read_peers(top, problems);
    scenario.devices = read_devices(top.get("devices"), top.place(), scenario, models, problems);
    scenario.control = read_control(top, problems);
    scenario.faults = read_faults(top.get("faults"), scenario.devices, problems);
    problems.throw_if_any();
    return scenario;
}

Scenario load_scenario(const std::filesystem::path& file, const std::vector<std::string>& set_arguments,
                       std::span<const Model> models) {
    return parse_scenario(read_scenario_file(file), file, set_arguments, models);
}

}  // namespace echoloop
