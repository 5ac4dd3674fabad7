#include "emulator/scenario/objects_section.h"

#include <algorithm>

#include "emulator/contract/endpoint.h"
#include "emulator/scenario/file.h"
#include "emulator/scenario/pose_section.h"

namespace echoloop::scenario {
namespace {

constexpr std::size_t most_objects = 64;

void refuse_shared_input(const Section& section, const std::string& input, const Scenario& scenario,
                         const std::vector<ScenarioObject>& objects, Problems& problems) {
    const auto refuse = [&](const std::string& other, const std::string& remedy) {
        problems.add(section.get("input")->place, section.path_of("input") + ": " + input +
                                                      " is already taken by " + other + "; " + remedy);
    };
    if (same_place(input, scenario.pose_input))
        return refuse("vehicle.input",
                      "leave it out, and lines with \"object\" and this node's name move it");
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (same_place(input, objects[i].input))
            return refuse("objects[" + std::to_string(i) + "].input", "give each an endpoint of its own");
}

void read_object(const Value& value, const std::string& path, const Scenario& scenario,
                 std::vector<ScenarioObject>& objects, Problems& problems) {
    const Section section(&value, path, {"node", "pose", "trajectory", "input"}, problems);
    if (!value.is_map()) return;
    ScenarioObject object;
    object.node = section.text("node", "");
    object.line = value.place.line;
    object.column = value.place.column;
    if (const Value* node = section.get("node")) {
        object.line = node->place.line;
        object.column = node->place.column;
    } else {
        problems.add(value.place, path + ": node is missing: the name of a node in the scene");
    }
    for (const ScenarioObject& other : objects)
        if (other.node == object.node)
            problems.add(value.place,
                         path + ".node: " + in_quotes(object.node) + " moves in two ways; keep one");
    if (const Value* pose = section.get("pose"))
        object.pose = read_pose(pose, path + ".pose", scenario, problems);
    object.trajectory = read_trajectory_name(section, scenario.file, problems);
    object.input = read_pose_endpoint(section, "input", problems);
    refuse_shared_input(section, object.input, scenario, objects, problems);
    if (!object.trajectory.empty() && (object.pose || !object.input.empty()))
        problems.add(section.get("trajectory")->key_place,
                     path + ".trajectory says where the object is; remove it, or pose and input");
    objects.push_back(std::move(object));
}

}  // namespace

std::string read_pose_endpoint(const Section& section, std::string_view key, Problems& problems) {
    const Value* value = section.get(key);
    if (value == nullptr) return {};
    const std::string uri = section.text(key, "");
    if (uri == standard_input) return uri;
    try {
        if (parse_endpoint(uri).scheme != Endpoint::Scheme::udp) return uri;
        problems.add(value->place,
                     section.path_of(key) +
                         ": udp:// only sends; poses come to udp-listen://, tcp-listen://, tcp://, "
                         "serial://, pty: or stdin");
    } catch (const std::invalid_argument& error) {
        problems.add(value->place, section.path_of(key) + ": " + error.what());
    }
    return {};
}

std::filesystem::path read_trajectory_name(const Section& section, const std::filesystem::path& file,
                                           Problems& problems) {
    const Value* value = section.get("trajectory");
    if (value == nullptr) return {};
    const auto name = file.parent_path() / section.text("trajectory", "");
    if (const auto fault = file_fault(name))
        problems.add(value->place,
                     section.path_of("trajectory") + ": " + in_quotes(name.string()) + ": " + fault->message +
                         "; a relative path starts at the scenario's folder",
                     fault->kind);
    return name;
}

bool same_place(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return false;
    if (a == standard_input || b == standard_input) return a == b;
    return clash(parse_endpoint(a), parse_endpoint(b));
}

std::vector<ScenarioObject> read_objects(const Value* value, const Scenario& scenario, Problems& problems) {
    std::vector<ScenarioObject> objects;
    if (value == nullptr || value->kind == Value::Kind::null) return objects;
    if (!value->is_sequence() || value->items.size() > most_objects) {
        problems.add(value->place, "objects: expected a list of at most 64 things that move, each a node");
        return objects;
    }
    for (std::size_t i = 0; i < value->items.size(); ++i)
        read_object(value->items[i], "objects[" + std::to_string(i) + "]", scenario, objects, problems);
    return objects;
}

}  // namespace echoloop::scenario
