#include "emulator/devices/surveyor240/settings.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::surveyor240 {
namespace {

const char* const own = "own choice";

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.source_level = figure(p, "source_level");
    a.swath = deg_to_rad(figure(p, "swath"));
    a.directions = static_cast<std::size_t>(std::lround(figure(p, "directions")));
    a.angle_resolution = deg_to_rad(figure(p, "angle_resolution"));
    a.fan_height = deg_to_rad(figure(p, "fan_height"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.gain_range = figure(p, "gain_range");
    a.detection_margin = figure(p, "detection_margin");
    a.longest_range = figure(p, "longest_range");
    return a;
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"swath", "deg", "from the first direction to the last", 10, 160},
        {"directions", "", "that are looked into within the swath", 2, 256, true},
        {"angle_resolution", "deg", "-3 dB full width of one direction, across track", 0.1, 20},
        {"fan_height", "deg", "-3 dB full width of the transmit beam, along track", 0.1, 60},
        {"gain_range", "dB", "from gain index 0 to 100", 0, 120},
        {"detection_margin", "dB", "echoes that are not so far above the noise are no bottom", 0, 60},
        {"longest_range", "m", "a host may not set more; following the bottom ends here", 10, 200},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    std::vector<Option> rows{
        choice_row("pitch_sign", {"bow-up", "bow-down"},
                   "where x of the up vector is positive: asin(x) or asin(-x) is the pitch, bow up",
                   "ping-python, and the maker's page on ATTITUDE_REPORT"),
        integer_row("points", "", 15, 1, 256, "most points in one ping",
                    "maker's page: typically 10 to 15 targets in the swath"),
        number_row("attitude_period", "s", 0.1, 0, 60, "between attitude reports; 0: on request only", own),
        number_row("utc_request_period", "s", 10, 0, 3600,
                   "between questions for the time of day; 0: none is asked", own),
        number_row("message_gap", "s", 0.01, 0, 0.04,
                   "pause between messages of one moment, as points and attitude",
                   "own choice: the maker's Python package takes one message a read, and falls behind for "
                   "good where "
                   "two arrive at once over TCP"),
        number_row("temperature", "degC", -1000, -1000, 60,
                   "of the water, from the optional sensor; -1000: there is none",
                   "maker's page on YZ_POINT_DATA"),
        flag_row("pressure_sensor", false, "the optional sensor tells the pressure at the head's depth",
                 "maker's page on YZ_POINT_DATA"),
    };
    constexpr int listed_type = 103;
    auto common = cerulean_device::identity_options(listed_type, "SONAR SURVEYOR", false);
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.identity = cerulean_device::read_identity(config);
    s.bow_up_is_positive = text(o, "pitch_sign") == "bow-up";
    s.points = static_cast<std::size_t>(integer(o, "points"));
    s.attitude_period = number(o, "attitude_period");
    s.utc_request_period = number(o, "utc_request_period");
    s.message_gap = number(o, "message_gap");
    s.temperature = number(o, "temperature");
    s.pressure_sensor = flag(o, "pressure_sensor");
    s.pulse = config.effects.has(Effect::pulse);
    s.acoustics = read_acoustics(config.profile);
    return s;
}

}  // namespace echoloop::surveyor240
