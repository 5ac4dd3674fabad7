#include "emulator/scenario/device_section.h"

#include <algorithm>
#include <optional>

#include "emulator/contract/endpoint.h"
#include "emulator/scenario/driver_section.h"
#include "emulator/scenario/file.h"
#include "emulator/scenario/mount_section.h"
#include "emulator/scenario/profile_section.h"
#include "render/refraction.h"

namespace echoloop::scenario {
namespace {

constexpr std::size_t most_devices = 64;
constexpr std::size_t longest_name = 64;
constexpr std::size_t most_endpoints = 8;

/// An endpoint of a device, where it was written, and what to call it.
struct Claim {
    Endpoint endpoint;
    Place place;
    std::string path;
};

bool is_name(std::string_view text) {
    const auto letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    };
    return !text.empty() && text.size() <= longest_name && std::ranges::all_of(text, letter);
}

/// m/s, where a sonar is at the start: what its own sensor measures.
double speed_at_sonar(const Scenario& scenario, const Pose& body_from_sonar) {
    const Water& water = scenario.water;
    const RendererOptions& render = scenario.render;
    if (water.profile.empty() || render.rule == EchoRule::cerqueira2016 ||
        !render.effects.has(Effect::refraction))
        return sound_speed(water);
    const double surface = render.surface.value_or(WaterSurface{}).height;
    return sound_speed_at(water.profile, surface - (scenario.world_from_body * body_from_sonar).position.z);
}

class DeviceReader {
  public:
    DeviceReader(const Scenario& scenario, std::span<const Model> models, Problems& problems)
        : scenario_(scenario), models_(models), problems_(problems) {
        claim_input(scenario.pose_input, "vehicle.input");
        if (scenario.step_input != scenario.pose_input) claim_input(scenario.step_input, "clock.input");
        for (std::size_t i = 0; i < scenario.objects.size(); ++i)
            claim_input(scenario.objects[i].input, "objects[" + std::to_string(i) + "].input");
    }

    void read(const Value& value, std::size_t index);
    std::vector<ScenarioDevice> take() { return std::move(devices_); }

  private:
    std::string read_name(const Section& section, std::size_t index);
    const Model* read_model(const Section& section);
    std::vector<Endpoint> read_endpoints(const Section& section, const Model& model);
    std::optional<Endpoint> parse(const std::string& uri, const Claim& at, const Model& model, bool first);
    void claim(Claim claim);
    void claim_input(const std::string& uri, std::string path) {
        if (!uri.empty() && uri != standard_input)
            claims_.push_back({parse_endpoint(uri), {}, std::move(path)});
    }
    Profile read_profile(const Section& section, const Model& model);
    Profile read_file(const Section& section, const Model& model);
    void try_make(const ScenarioDevice& device, const Place& place);

    const Scenario& scenario_;
    std::span<const Model> models_;
    Problems& problems_;
    std::vector<ScenarioDevice> devices_;
    std::vector<std::string> names_;
    std::vector<Claim> claims_;
};

std::string DeviceReader::read_name(const Section& section, std::size_t index) {
    const Value* value = section.get("name");
    if (value == nullptr) {
        problems_.add(section.place(),
                      "device " + std::to_string(index) + " has no name; add e.g. name: micron");
        return {};
    }
    std::string name = section.text("name", "");
    if (!is_name(name)) {
        problems_.add(value->place, section.path_of("name") + ": " + in_quotes(name) +
                                        " is not a name of 1 to 64 letters, digits, '_' and '-'");
    } else if (std::ranges::find(names_, name) != names_.end()) {
        problems_.add(value->place,
                      "a device named " + in_quotes(name) + " exists already; give each its own name");
    }
    names_.push_back(name);
    return name;
}

const Model* DeviceReader::read_model(const Section& section) {
    const Value* value = section.get("model");
    if (value == nullptr) {
        problems_.add(section.place(),
                      section.path_of("model") + " is missing; `echoloop list` shows the models");
        return nullptr;
    }
    std::string name;
    if (!Checker(problems_).text(*value, section.path_of("model"), name)) return nullptr;
    const auto found = std::ranges::find(models_, name, &Model::name);
    if (found != models_.end()) return &*found;
    std::vector<std::string_view> known;
    for (const auto& model : models_) known.push_back(model.name);
    problems_.add(value->place,
                  section.path_of("model") + ": unknown model " + in_quotes(name) + suggestion(name, known));
    return nullptr;
}

std::optional<Endpoint> DeviceReader::parse(const std::string& uri, const Claim& at, const Model& model,
                                            bool first) {
    try {
        Endpoint parsed = parse_endpoint(uri);
        const auto scheme = scheme_name(parsed.scheme);
        const std::vector<std::string_view> accepted(model.endpoint_schemes.begin(),
                                                     model.endpoint_schemes.end());
        if (!first || accepted.empty() || std::ranges::find(accepted, scheme) != accepted.end())
            return parsed;
        problems_.add(at.place, at.path + ": " + model.name + " does not speak over " + in_quotes(scheme) +
                                    suggestion("", accepted));
    } catch (const std::invalid_argument& error) {
        problems_.add(at.place, at.path + ": " + error.what());
    }
    return {};
}

void DeviceReader::claim(Claim claim) {
    for (const auto& other : claims_)
        if (clash(other.endpoint, claim.endpoint)) {
            problems_.add(claim.place, claim.path + ": " + to_string(claim.endpoint) +
                                           " is already taken by " + other.path +
                                           "; give each device endpoints of its own");
            break;
        }
    claims_.push_back(std::move(claim));
}

/// Empty after a problem.
std::vector<Endpoint> DeviceReader::read_endpoints(const Section& section, const Model& model) {
    const auto path = section.path_of("endpoints");
    auto uris = model.default_endpoints;
    const Value* list = section.get("endpoints");
    if (list != nullptr &&
        (!list->is_sequence() || list->items.empty() || list->items.size() > most_endpoints)) {
        const auto example = uris.empty() ? std::string() : ", as in [\"" + uris.front() + "\"]";
        problems_.add(list->place, path + ": expected a list of 1 to 8 endpoints" + example);
        return {};
    }
    if (list != nullptr) uris.resize(std::max(uris.size(), list->items.size()));
    std::vector<Endpoint> endpoints;
    bool on_loopback = false;
    for (std::size_t i = 0; i < uris.size(); ++i) {
        const Value* given = list != nullptr && i < list->items.size() ? &list->items[i] : nullptr;
        Claim at{{}, given != nullptr ? given->place : section.place(), path + "." + std::to_string(i)};
        if (given != nullptr && !Checker(problems_).text(*given, at.path, uris[i])) continue;
        const auto parsed = parse(uris[i], at, model, i == 0);
        if (!parsed) continue;
        if (i == 0) on_loopback = parsed->listens() && is_loopback(parsed->ip);
        if (on_loopback && parsed->scheme == Endpoint::Scheme::udp && !is_loopback(parsed->ip))
            problems_.add(at.place,
                          at.path +
                              ": a device on a loopback address sends to loopback only; give the first "
                              "endpoint an address of that network");
        endpoints.push_back(*parsed);
        at.endpoint = *parsed;
        claim(std::move(at));
    }
    if (endpoints.size() < uris.size()) endpoints.clear();
    return endpoints;
}

/// The profile of `profile_file`, which begins at the scenario's folder.
Profile DeviceReader::read_file(const Section& section, const Model& model) {
    const Value& value = *section.get("profile_file");
    const auto file = scenario_.file.parent_path() / section.text("profile_file", "");
    const auto path = section.path_of("profile_file");
    if (const auto fault = file_fault(file)) {
        problems_.add(value.place,
                      path + ": " + in_quotes(file.string()) + ": " + fault->message +
                          "; a relative path starts at the scenario's folder",
                      fault->kind);
        return {};
    }
    try {
        return scenario::read_profile(read_scenario_file(file), file.string(), model, problems_);
    } catch (const ScenarioError& error) {
        problems_.add(value.place, path + ": " + error.what());
        return {};
    }
}

Profile DeviceReader::read_profile(const Section& section, const Model& model) {
    const std::size_t before = problems_.count();
    Profile profile = section.get("profile_file") == nullptr ? own_profile(model) : read_file(section, model);
    const Value* figures = section.get("profile");
    read_figures(figures, section.path_of("profile"), model, profile, problems_);
    if (problems_.count() == before)
        check_piston(profile, figures == nullptr ? section.place() : figures->place,
                     section.path_of("profile"), problems_);
    return profile;
}

void DeviceReader::try_make(const ScenarioDevice& device, const Place& place) {
    if (device.model->make == nullptr) return;
    try {
        device.model->make(device.config);
    } catch (const std::invalid_argument& error) {
        problems_.add(place, "devices." + device.name + ": " + error.what());
    }
}

void DeviceReader::read(const Value& value, std::size_t index) {
    const std::size_t before = problems_.count();
    const Value* name = value.find("name");
    const bool named = name != nullptr && name->is_scalar() && is_name(name->text);
    const Section section(
        &value, "devices." + (named ? name->text : std::to_string(index)),
        {"name", "model", "mount", "endpoints", "options", "profile", "profile_file", "driver", "pings"},
        problems_);
    if (!value.is_map()) {
        if (value.kind == Value::Kind::null) problems_.add(value.place, "a device is a name and a model");
        return;
    }
    ScenarioDevice device;
    device.name = read_name(section, index);
    device.model = read_model(section);
    read_mount(section.get("mount"), section.path_of("mount"), scenario_, device, problems_);
    if (!device.mount_input.empty() && device.mount_input != standard_input)
        claim({parse_endpoint(device.mount_input), section.get("mount")->find("input")->place,
               section.path_of("mount") + ".input"});
    if (!device.mount_input.empty() && scenario_.clock == ClockMode::free)
        problems_.add(section.get("mount")->find("input")->key_place,
                      section.path_of("mount") +
                          ".input: in a 'free' run nobody is outside to send poses; use a trajectory");
    device.line = value.place.line;
    device.column = value.place.column;
    if (device.model == nullptr) return;
    device.config.name = device.name;
    device.config.endpoints = read_endpoints(section, *device.model);
    device.config.options =
        read_options(section.get("options"), section.path_of("options"), *device.model, problems_);
    device.config.profile = read_profile(section, *device.model);
    device.config.effects = scenario_.render.effects;
    device.config.peers = scenario_.peers;
    device.config.sound_speed = speed_at_sonar(scenario_, device.body_from_sonar);
    if (problems_.count() == before) try_make(device, value.place);
    if (problems_.count() == before) read_driver(section, scenario_, device, problems_);
    devices_.push_back(std::move(device));
}

}  // namespace

std::vector<ScenarioDevice> read_devices(const Value* value, const Place& place, const Scenario& scenario,
                                         std::span<const Model> models, Problems& problems) {
    if (value == nullptr || value->kind == Value::Kind::null ||
        (value->is_sequence() && value->items.empty())) {
        problems.add(value == nullptr ? place : value->key_place,
                     "the scenario has no devices; add devices: [{name: micron, model: tritech-micron}]");
        return {};
    }
    if (!value->is_sequence() || value->items.size() > most_devices) {
        problems.add(value->place, "devices: expected a list of 1 to 64 devices, each a name and a model");
        return {};
    }
    DeviceReader reader(scenario, models, problems);
    for (std::size_t i = 0; i < value->items.size(); ++i) reader.read(value->items[i], i);
    return reader.take();
}

}  // namespace echoloop::scenario
