#include "emulator/scenario/water_section.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "render/acoustics/sea_surface.h"
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

struct Turbidity {
    std::string_view word;
    double strength;  ///< Sv, dB re 1 m^-1
};
constexpr double pure = -95, clear = -75;
/// Middles of the ranges for 0.3 to 1 MHz, of the order of Medwin & Clay, Fundamentals of Acoustical
/// Oceanography (1998), and Wiebe et al. (1997); that it is the middle is an own choice. Pure is as much as
/// the zeros between echoes leave that an Imagenex 852 recorded in a lake.
constexpr std::array<Turbidity, 4> turbidities{
    {{"pure", pure}, {"clear", clear}, {"coastal", -62}, {"turbid", -48}}};
constexpr Range strengths{-150, 0, "dB"};
constexpr const char* scattering_example =
    "expected pure, clear, coastal, turbid or none, or dB, as in -70, or a list of depths in m and dB, as in "
    "[[0, "
    "-50], [10, -70]]";

std::vector<ScatteringPoint> read_layers(const Value& value, const std::string& path, Problems& problems) {
    Checker checker(problems);
    std::vector<ScatteringPoint> points;
    if (value.items.empty() || value.items.size() > most_points)
        checker.fail(value, path, std::string(scattering_example) + "; 1 to 1000 points");
    for (std::size_t i = 0; i < std::min(value.items.size(), most_points); ++i) {
        const Value& pair = value.items[i];
        const auto name = path + "." + std::to_string(i);
        ScatteringPoint point;
        if (!pair.is_sequence() || pair.items.size() != 2) {
            checker.fail(pair, name, "expected a depth in m and a strength in dB, got " + describe(pair));
            continue;
        }
        const bool good = checker.number(pair.items[0], name + ".0", depths, point.depth);
        if (!checker.number(pair.items[1], name + ".1", strengths, point.strength) || !good) continue;
        if (!points.empty() && point.depth <= points.back().depth)
            checker.fail(pair, name, "is not deeper than the point before; sort the points by depth");
        points.push_back(point);
    }
    return points;
}

/// g/kg; below is fresh water (Venice system, 1958).
constexpr double least_salt = 0.5;

/// Where the file says nothing, fresh water is that of a tank or a lake and pure, and the sea is clear.
std::vector<ScatteringPoint> read_scattering(const Section& section, double salinity, Problems& problems) {
    const Value* value = section.get("scattering");
    const std::string path = section.path_of("scattering");
    if (value == nullptr) return {{0, salinity < least_salt ? pure : clear}};
    if (value->is_sequence()) return read_layers(*value, path, problems);
    if (value->is_scalar() && !value->quoted) {
        if (value->text == "none") return {};
        for (const Turbidity& turbidity : turbidities)
            if (value->text == turbidity.word) return {{0, turbidity.strength}};
        ScatteringPoint point;
        const bool is_number =
            !value->text.empty() && value->text.find_first_not_of("+-.0123456789eE") == std::string::npos;
        if (is_number && Checker(problems).number(*value, path, strengths, point.strength)) return {point};
        if (is_number) return {};
    }
    problems.add(value->place, path + ": " + scattering_example + ", got " + describe(*value));
    return {};
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
    water.scattering = read_scattering(section, water.salinity, problems);
    return water;
}

std::optional<WaterSurface> read_surface(const Section& section, Problems& problems) {
    constexpr double light_air = 1.5;  // m/s, as the roughness: own choice
    const Value* value = section.get("surface");
    if (value != nullptr && value->is_scalar() && !value->quoted && value->text == "none") return {};
    if (value != nullptr && !value->is_map()) {
        problems.add(value->place, section.path_of("surface") +
                                       ": expected height, wind and roughness, or the word none, got " +
                                       describe(*value));
        return {};
    }
    const Section surface(value, section.path_of("surface"), {"height", "wind", "roughness"}, problems);
    WaterSurface read = *RendererOptions{}.surface;
    read.height = surface.number("height", read.height, {-12000, 12000, "m"});
    const bool has_wind = surface.get("wind") != nullptr;
    read.wind = surface.number("wind", light_air, {0, 40, "m/s"});
    if (has_wind) read.roughness = wave_height(read.wind);
    read.roughness = surface.number("roughness", read.roughness, {0, 10, "m"});
    if (!has_wind && read.roughness == 0) read.wind = 0;
    if (has_wind) read.slope = surface_slope(read.wind);
    return read;
}

}  // namespace echoloop::scenario
