#include "tools/import/terrain/given.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "emulator/contract/error.h"
#include "render/geographic.h"
#include "render/scene/limits.h"
#include "render/scene/materials.h"
#include "render/scene/seabeds.h"

namespace echoloop::worlds {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& wanted) {
    throw StartError(Exit::usage, option + ": expected " + wanted + ", got " +
                                      (value.empty() ? "nothing" : value.substr(0, 60)));
}

std::optional<double> number_of(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
    return value;
}

double number(const std::string& option, const std::string& text, double least, double most,
              const char* wanted) {
    const auto value = number_of(text);
    if (!value || *value < least || *value > most) refuse(option, text, wanted);
    return *value;
}

/// LATITUDE,LONGITUDE or LATITUDE,LONGITUDE,HEIGHT.
Origin read_origin(const std::string& text) {
    std::array<double, 3> value{};
    const std::array<double, 3> most{geographic::steepest, 180, geographic::highest};
    std::string_view rest = text;
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
        const auto comma = rest.find(',');
        const auto read = number_of(rest.substr(0, comma));
        if (count >= 3 || !read || std::abs(*read) > most[count])
            refuse("--origin", text, "LATITUDE,LONGITUDE in degrees, as in 59.4,10.5");
        value[count] = *read;
        more = comma != std::string_view::npos;
        if (more) rest.remove_prefix(comma + 1);
    }
    if (count < 2) refuse("--origin", text, "LATITUDE,LONGITUDE in degrees, as in 59.4,10.5");
    return {value[0], value[1], value[2]};
}

std::string read_material(const std::string& name) {
    if (seabed_by_name(name) != nullptr || surface_by_name(name)) return name;
    auto known = known_materials();
    for (const auto& seabed : known_seabeds()) known.push_back(seabed);
    const std::string near = nearest_of(name, known);
    std::string all;
    for (const auto& one : known) all += (all.empty() ? "" : ", ") + one;
    refuse("--material", name, (near.empty() ? "" : "perhaps " + near + ", ") + "one of: " + all);
}

}  // namespace

bool is_survey(const std::filesystem::path& file) {
    static constexpr std::array endings{".tif", ".tiff", ".asc", ".grd", ".nc", ".xyz", ".bag"};
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::ranges::find(endings, ending) != endings.end();
}

TerrainOptions terrain_options(const std::function<std::string(const char*)>& text,
                               const std::function<bool(const char*)>& flag) {
    TerrainOptions out;
    out.survey.layer = text("--layer");
    out.survey.units = text("--units");
    out.survey.crs = text("--crs");
    out.survey.local = flag("--local");
    if (out.survey.local && !out.survey.crs.empty())
        throw StartError(Exit::usage, "--local and --crs: give one of them");
    out.survey.positive = text("--positive");
    if (const auto& way = out.survey.positive; !way.empty() && way != "up" && way != "down")
        refuse("--positive", way, "up for heights or down for depths");
    if (const auto given = text("--nodata"); !given.empty())
        out.survey.nodata =
            number("--nodata", given, -1e300, 1e300, "the number that means that nothing is there");
    if (const auto given = text("--water-level"); !given.empty())
        out.survey.water_level =
            number("--water-level", given, -geographic::highest, geographic::highest, "metres, as in 350");
    if (const auto given = text("--error"); !given.empty())
        out.error = number("--error", given, 0.001, 1000, "0.001 to 1000 m");
    if (const auto given = text("--triangles"); !given.empty())
        out.triangles = static_cast<std::size_t>(
            number("--triangles", given, 2, double{scene_limits::triangles}, "2 to 16000000"));
    if (const auto given = text("--origin"); !given.empty()) out.origin = read_origin(given);
    if (const auto given = text("--material"); !given.empty()) out.material = read_material(given);
    return out;
}

}  // namespace echoloop::worlds
