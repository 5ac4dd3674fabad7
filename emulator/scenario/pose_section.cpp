#include "emulator/scenario/pose_section.h"

#include <optional>

#include "render/scene/scene.h"
#include "render/scene/scene_origin.h"

namespace echoloop::scenario {
namespace {

constexpr double farthest = 1e6;  ///< m

std::optional<GeoPlace> origin_for(const Value& value, const std::string& path, const Scenario& scenario,
                                   Problems& problems) {
    if (scenario.origin) return scenario.origin;
    if (scenario.scene.empty()) return std::nullopt;  // said already
    try {
        if (const auto origin = scene_origin(scenario.scene)) return origin;
        problems.add(value.place, path +
                                      ": nothing says where the world lies on the Earth; add origin: "
                                      "{latitude: ..., longitude: ...} to the scenario");
    } catch (const SceneError& error) {
        problems.add(value.place, path + ": " + error.what());
    }
    return std::nullopt;
}

/// One of each pair, and no position.
bool is_whole(const Section& pose, const Value& at, const std::string& path, Problems& problems) {
    for (const char* const key : {"latitude", "longitude"})
        if (pose.get(key) == nullptr)
            return problems.add(at.place, path + "." + key + ": is missing, as in {latitude: 59.4, " +
                                              "longitude: 10.5, depth: 3}"),
                   false;
    if (const Value* position = pose.get("position"))
        return problems.add(position->key_place,
                            path + ".position: latitude and longitude say where it is; remove one of them"),
               false;
    if ((pose.get("altitude") == nullptr) == (pose.get("depth") == nullptr))
        return problems.add(at.place, path +
                                          ": altitude or depth in m belongs to latitude and longitude, one "
                                          "of them"),
               false;
    return true;
}

}  // namespace

Pose pose_of(const Section& section) {
    const Vec3 position = section.triple("position", {-farthest, farthest, "m"});
    const Vec3 rpy = section.triple("rpy_deg", {-360, 360, "deg"});
    return {position, from_rpy(deg_to_rad(rpy.x), deg_to_rad(rpy.y), deg_to_rad(rpy.z))};
}

Pose read_pose(const Value* value, const std::string& path, const Scenario& scenario, Problems& problems) {
    const Section section(value, path, {"position", "rpy_deg", "latitude", "longitude", "altitude", "depth"},
                          problems);
    Pose pose = pose_of(section);
    bool is_on_earth = false;
    for (const char* const key : {"latitude", "longitude", "altitude", "depth"})
        is_on_earth = is_on_earth || section.get(key) != nullptr;
    if (!is_on_earth || !is_whole(section, *value, path, problems)) return pose;
    constexpr Range height{-geographic::highest, geographic::highest, "m"};
    const GeoPlace place{section.number("latitude", 0, {-90, 90, "deg"}),
                         section.number("longitude", 0, {-360, 360, "deg"}),
                         section.number("altitude", 0, height) - section.number("depth", 0, height)};
    const auto origin = origin_for(*section.get("latitude"), path + ".latitude", scenario, problems);
    if (!origin) return pose;
    pose.position = enu_from_place(*origin, place);
    if (norm(pose.position) <= farthest) return pose;  // false for a place on the Earth's other half
    problems.add(section.get("latitude")->place,
                 path + ".latitude: more than 1000 km from the world's origin; is the origin right?");
    return {};
}

}  // namespace echoloop::scenario
