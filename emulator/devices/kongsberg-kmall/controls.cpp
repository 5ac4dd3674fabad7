#include "emulator/devices/kongsberg-kmall/controls.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "emulator/devices/kongsberg-kmall/ping.h"

namespace echoloop::kongsberg_kmall {
namespace {

std::string text_of(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// A number of digits and a point, in bounds.
std::optional<double> number_in(std::string_view text, double low, double high) {
    constexpr std::size_t longest = 20;
    if (text.empty() || text.size() > longest || text.find_first_not_of("0123456789.") != text.npos)
        return {};
    const std::string digits(text);
    char* end = nullptr;
    const double value = std::strtod(digits.c_str(), &end);
    if (*end != 0 || !(value >= low && value <= high)) return {};
    return value;
}

/// An edge of the fan, deg from below.
bool set_edge(std::string_view text, double& edge) {
    const auto degrees = number_in(text, 5, 75);
    if (degrees) edge = deg_to_rad(*degrees);
    return degrees.has_value();
}

bool set_depth(std::string_view text, Settings& s) {
    const auto depth = number_in(text, 1, 600);
    if (depth) s.max_depth = depth;
    return depth.has_value();
}

bool set_spacing(std::string_view text, Settings& s) {
    if (text != "Equidistance" && text != "Equiangle") return false;
    s.equidistant = text == "Equidistance";
    return true;
}

bool set_frequency(std::string_view text, Settings& s) {
    for (const double khz : {200.0, 300.0, 400.0})
        if (text == text_of("%.0fkHz", khz)) {
            s.tune(khz * 1e3);
            return true;
        }
    return false;
}

bool set_rate(std::string_view text, Settings& s) {
    const auto rate = number_in(text, 0.1, 50);
    if (rate) s.ping_rate = *rate;
    return rate.has_value();
}

bool set_water_column(std::string_view text, Settings& s) {
    if (text == "0" || text == "1") s.water_column = text == "1";
    return text == "0" || text == "1";
}

struct Value {
    const char* name;   ///< in a known driver's list of 2019
    const char* token;  ///< in a K-Controller's file of 2020; "": not known
    std::string (*get)(const Settings&);
    bool (*set)(std::string_view, Settings&);
};

const Value named_values[] = {
    {"RUNT_PARAM_PU_ANGLE_PORT_RX1", "SSPA1",
     [](const Settings& s) { return text_of("%g", rad_to_deg(s.port_edge)); },
     [](std::string_view text, Settings& s) { return set_edge(text, s.port_edge); }},
    {"RUNT_PARAM_PU_ANGLE_STARB_RX1", "SSSA1",
     [](const Settings& s) { return text_of("%g", rad_to_deg(s.starboard_edge)); },
     [](std::string_view text, Settings& s) { return set_edge(text, s.starboard_edge); }},
    {"RUNT_PARAM_PU_BEAM_SPACING", "SSBS",
     [](const Settings& s) { return std::string(s.equidistant ? "Equidistance" : "Equiangle"); },
     set_spacing},
    {"RUNT_PARAM_PU_MAX_DEPTH", "SDMA", [](const Settings& s) { return text_of("%g", max_depth(s)); },
     set_depth},
    {"RUNT_PARAM_PU_MAX_PING_FREQ", "SDPM1",
     [](const Settings& s) { return text_of("%.0fkHz", s.frequency / 1e3); }, set_frequency},
    {"RUNT_PARAM_PU_PING_MODE", "STPF", [](const Settings& s) { return text_of("%.2f", s.ping_rate); },
     set_rate},
    {"RUNT_PARAM_PU_WATERCOL", "", [](const Settings& s) { return std::string(s.water_column ? "1" : "0"); },
     set_water_column},
};

}  // namespace

double max_depth(const Settings& s) { return s.max_depth.value_or(s.range * edge_cosine(s)); }

bool set_value(std::string_view assignment, Settings& settings) {
    const std::size_t equals = assignment.find('=');
    if (equals == 0 || equals == assignment.npos) return false;
    const std::string_view name = assignment.substr(0, equals);
    for (const Value& value : named_values)
        if (name == value.name || name == value.token)
            return value.set(assignment.substr(equals + 1), settings);
    return false;
}

std::string values_as_json(const Settings& settings) {
    std::string json;
    for (const Value& value : named_values)
        json += std::string(json.empty() ? "[" : ",") + "{\"id\":\"" + value.name + "\",\"value\":\"" +
                value.get(settings) + "\"}";
    return json + "]";
}

std::string values_as_xml(const Settings& settings) {
    std::string xml = "<ALL_TOKENS>\n";
    for (const Value& value : named_values) {
        if (*value.token == 0) continue;
        xml += std::string("<TOKEN>\n<ID>") + value.token + "</ID>\n<VALUE>" + value.get(settings) +
               "</VALUE>\n</TOKEN>\n";
    }
    return xml + "</ALL_TOKENS>\n";
}

}  // namespace echoloop::kongsberg_kmall
