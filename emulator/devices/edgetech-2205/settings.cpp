#include "emulator/devices/edgetech-2205/settings.h"

#include <algorithm>
#include <numbers>
#include <string>

namespace echoloop::edgetech_2205 {
namespace {

const char* const spec = "EdgeTech specification notes";

void list_band(Band& band, const std::string& name, FigureList& f) {
    const auto figure = [&](double& member, const char* what, const char* unit, double low, double high,
                            const char* help) { f.number(member, name + what, unit, low, high, help); };
    figure(band.frequency, "_frequency", "Hz", 50e3, 2e6, "middle of the chirp");
    figure(band.bandwidth, "_bandwidth", "Hz", 1e3, 500e3, "of the chirp");
    figure(band.pulse_length, "_pulse_length", "s", 10e-6, 50e-3, "of the chirp");
    figure(band.source_level, "_source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis, to port");
    f.degrees(band.beam_width, name + "_beam_width", 0.05, 10, "-3 dB full width along the track, two-way");
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.whole(s.version, "protocol_version", "", 8, 13, "in every message", "as a known host sends");
    o.choice(s.replies_to_sets, "sets", {"silent", "reply"}, "whether a set is answered", spec);
    o.choice(
        s.stays_off, "shutdown", {"listen", "off"},
        "after a shutdown: waits for the next host as if switched on again, or is deaf until the run ends",
        "own choice: a vehicle would switch its power on again");
    o.choice(s.start, "start", {"silent", "low", "high", "both"},
             "subsystems that ping with both sides from the start", "a host switches them on");
    o.whole(s.samples, "samples", "", 100, 60000, "of a side, over the whole range",
            "own choice: the most that a known reader hands on");
    o.number(s.sound_speed, "sound_speed", "m/s", 1300, 1700,
             "by which it turns ranges into times; the water has its own", "own choice");
    o.number(s.processing_time, "processing_time", "s", 0, 1,
             "from the last echo to the data and the next ping", "own choice");
    o.flag(
        s.navigation, "navigation",
        "fills heading, pitch, roll, depth, course, speed and, where the world's origin is known, position",
        "own choice: files without a track are of little use; a known host writes its own over them");
    Acoustics& a = s.acoustics;
    list_band(a.bands[0], "low", f);
    list_band(a.bands[1], "high", f);
    f.number(a.bands[0].directivity_index, "low_directivity_index", "dB", 0, 60,
             "of the low frequency, against isotropic noise");
    f.degrees(a.fan_height, "fan_height", 1, 120, "-3 dB full width across the track, two-way");
    f.degrees(a.depressions[port_side], "port_depression", 0, 80, "of the axis below the horizontal");
    f.degrees(a.depressions[starboard_side], "starboard_depression", 0, 80,
              "of the axis below the horizontal");
    f.number(a.starboard_trim, "starboard_trim", "dB", -30, 30, "source level to starboard against port");
    f.common(a.horizontal, a.vertical, a.receiver);
    a.bands[1].directivity_index = a.receiver.directivity_index;
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.unix_start = config.unix_start;
    s.origin = config.origin;
    return s;
}

std::uint32_t limited_range(std::uint32_t range, std::size_t band) {
    constexpr std::uint32_t shortest = 5000, longest[] = {150000, 75000};
    return std::clamp(range, shortest, longest[band]);
}

std::uint32_t interval_of(const Subsystem& subsystem, const Settings& settings) {
    const double window = 2e-3 * subsystem.range / settings.sound_speed;
    return static_cast<std::uint32_t>(1e9 * window / settings.samples);
}

double ping_time(const Subsystem& subsystem, const Settings& settings) {
    return 1e-9 * interval_of(subsystem, settings) * settings.samples + settings.processing_time;
}

Shot shot_from(const Subsystem& subsystem, std::size_t band, const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const Band& b = a.bands[band];
    Shot shot;
    shot.bearings = {-std::numbers::pi / 2, std::numbers::pi / 2};
    shot.sides = {{a.depressions[port_side], b.source_level},
                  {a.depressions[starboard_side], b.source_level + a.starboard_trim}};
    shot.beam_width = b.beam_width;
    shot.fan_height = a.fan_height;
    shot.bins = settings.samples;
    shot.bin_interval = 1e-9 * interval_of(subsystem, settings);
    shot.frequency = b.frequency;
    shot.pulse_length = b.pulse_length;
    shot.bandwidth = b.bandwidth;
    shot.source_level = b.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.receiver.directivity_index = b.directivity_index;
    shot.interval = ping_time(subsystem, settings);
    return shot;
}

}  // namespace echoloop::edgetech_2205
