#include "emulator/scenario/water_section.h"

#include <algorithm>
#include "render/renderer.h"

namespace echoloop::scenario {
namespace {

constexpr Range depths{0, 12000, "m"};
constexpr Range speeds{1300, 1700, "m/s"};
constexpr std::size_t most_points = 1000;

/// Points at strictly increasing depths.
std::vector<SoundSpeedPoint> read_profile(const Value& value, const std::string& path, Problems& problems) {
    Checker checker(problems);
    std::vector<SoundSpeedPoint> profile;
    if (!value.is_sequence() || value.items.empty() || value.items.size() > most_points) {
        checker.fail(value, path,
                     "expected a list of 1 to 1000 depths and speeds, as in [[0, 1500], [20, 1490]], got " +
                         describe(value));
        return profile;
    }
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        const Value& pair = value.items[i];
        const auto name = path + "." + std::to_string(i);
        SoundSpeedPoint point;
        if (!pair.is_sequence() || pair.items.size() != 2) {
            checker.fail(pair, name, "expected a depth in m and a speed in m/s, got " + describe(pair));
            continue;
        }
        const bool good = checker.number(pair.items[0], name + ".0", depths, point.depth);
        if (!checker.number(pair.items[1], name + ".1", speeds, point.speed) || !good) continue;
        if (!profile.empty() && point.depth <= profile.back().depth)
            checker.fail(pair, name, "is not deeper than the point before; sort the points by depth");
        profile.push_back(point);
    }
    return profile;
}

}  // namespace

Water read_water(const Section& section, double vehicle_z, double surface_height, Problems& problems) {
    Water water;
    water.temperature = section.number("temperature", water.temperature, {-4, 40, "degC"});
    water.salinity = section.number("salinity", water.salinity, {0, 45, "g/kg"});
    water.ph = section.number("ph", water.ph, {5, 10, ""});
    water.depth = section.number(
        "depth", std::clamp(surface_height - vehicle_z, depths.minimum, depths.maximum), depths);
    if (section.get("sound_speed") != nullptr)
        water.sound_speed = section.number("sound_speed", 1500, speeds);
    if (const Value* profile = section.get("profile"))
        water.profile = read_profile(*profile, section.path_of("profile"), problems);
    return water;
}

std::optional<WaterSurface> read_surface(const Section& section, Problems& problems) {
    const Value* value = section.get("surface");
    if (value != nullptr && value->is_scalar() && !value->quoted && value->text == "none") return {};
    if (value != nullptr && !value->is_map()) {
        problems.add(value->place, section.path_of("surface") +
                                       ": expected height and roughness, or the word none, got " +
                                       describe(*value));
        return {};
    }
    const Section surface(value, section.path_of("surface"), {"height", "roughness"}, problems);
    WaterSurface read = *RendererOptions{}.surface;
    read.height = surface.number("height", read.height, {-12000, 12000, "m"});
    read.roughness = surface.number("roughness", read.roughness, {0, 10, "m"});
    return read;
}

}  // namespace echoloop::scenario
