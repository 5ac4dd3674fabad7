#include "emulator/scenario/objects_section.h"

#include <algorithm>

#include "emulator/endpoint.h"
#include "emulator/scenario/device_section.h"
#include "emulator/scenario/file.h"

namespace echoloop::scenario {
namespace {

constexpr std::size_t most_objects = 64;

void read_object(const Value& value, const std::string& path, const std::filesystem::path& file,
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
    if (const Value* pose = section.get("pose")) object.pose = read_pose(pose, path + ".pose", problems);
    object.trajectory = read_trajectory_name(section, file, problems);
    object.input = read_pose_endpoint(section, "input", problems);
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
                         "; a relative name begins at the scenario's folder",
                     fault->kind);
    return name;
}

std::vector<ScenarioObject> read_objects(const Value* value, const std::filesystem::path& file,
                                         Problems& problems) {
    std::vector<ScenarioObject> objects;
    if (value == nullptr || value->kind == Value::Kind::null) return objects;
    if (!value->is_sequence() || value->items.size() > most_objects) {
        problems.add(value->place, "objects: expected a list of at most 64 things that move, each a node");
        return objects;
    }
    for (std::size_t i = 0; i < value->items.size(); ++i)
        read_object(value->items[i], "objects[" + std::to_string(i) + "]", file, objects, problems);
    return objects;
}

}  // namespace echoloop::scenario
