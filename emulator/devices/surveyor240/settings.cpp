#include "emulator/devices/surveyor240/settings.h"

namespace echoloop::surveyor240 {
namespace {

const char* const own = "own choice";

void describe_options(Settings& s, OptionList& o) {
    o.words(s.bow_up_is_positive, "pitch_sign", {{"bow-up", true}, {"bow-down", false}},
            "whether the pitch, bow up, is asin(x) or asin(-x) of the up vector",
            "ping-python, and the maker's page on ATTITUDE_REPORT");
    o.whole(s.points, "points", "", 1, 256, "most points in one ping",
            "maker's page: typically 10 to 15 targets in the swath");
    o.number(s.attitude_period, "attitude_period", "s", 0, 60, "between attitude reports; 0: on request only",
             own);
    o.number(s.utc_request_period, "utc_request_period", "s", 0, 3600,
             "time between requests for the time of day; 0: no requests", own);
    o.number(s.datagram_gap, "datagram_gap", "s", 0, 0.04,
             "pause between messages of the same moment, such as points and attitude",
             "own choice: the maker's Python package takes one message a read, and falls behind for "
             "good where two arrive at once over TCP");
    o.number(s.temperature, "temperature", "degC", -1000, 60,
             "of the water, from the optional sensor; -1000: no sensor", "maker's page on YZ_POINT_DATA");
    o.flag(s.pressure_sensor, "pressure_sensor",
           "the optional sensor reports the pressure at the head's depth", "maker's page on YZ_POINT_DATA");
    describe(s.identity, o);
    o.number(s.processing_time, "processing_time", "s", 0, 1,
             "from the last range step to the points and the next ping", own);
    o.whole(s.serial, "serial", "", 0, 4294967295.0,
            "serial number, which no message has; tells whose staves they are", own);
}

void describe_profile(Acoustics& a, std::uint32_t serial, FigureList& f) {
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.swath, "swath", 10, 160, "from the first direction to the last");
    f.whole(a.directions, "directions", 2, 256, "number of directions within the swath");
    f.degrees(a.angle_resolution, "angle_resolution", 0.1, 20,
              "-3 dB full width of one direction, across track");
    f.degrees(a.fan_height, "fan_height", 0.1, 60, "-3 dB full width of the transmit beam, along track");
    f.number(a.gain_range, "gain_range", "dB", 0, 120, "from gain index 0 to 100");
    multibeam::list_figures(a.detection, f);
    f.number(a.longest_range, "longest_range", "m", 10, 200,
             "the longest that a host may set, and that following the bottom uses");
    f.common(a.horizontal, a.vertical, a.receiver);
    f.stave_errors(a.errors, std::to_string(serial));
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_options(s, o);
    describe_profile(s.acoustics, s.serial, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    s.identity.line.bits_per_second = line_rate(config.endpoints, s.identity.baud);
    s.pulse = config.effects.has(Effect::pulse);
    return s;
}

}  // namespace echoloop::surveyor240
