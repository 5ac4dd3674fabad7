#include "emulator/devices/imagenex-872/settings.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace echoloop::imagenex872 {
namespace {

const char* const spec = "Imagenex 872 specification notes";

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.text(s.header, "header", "the first three letters of a reply",
           "Imagenex 872 specification notes: as the family's other heads; no public host looks at them");
    o.words(s.ceiling, "ceiling", {{"255", 255.0}, {"127", 127.0}}, "the largest sample", spec);
    o.choice(s.pings_for_starboard, "starboard_alone", {"refuse", "ping"},
             "a request for starboard without one for port before it", spec);
    o.number(s.sound_speed, "sound_speed", "m/s", 1300, 1700,
             "by which it turns ranges into times; the water has its own", "own choice");
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the reply",
             "own choice: a known host asks again 23 ms after the last echo");
    Acoustics& a = s.acoustics;
    constexpr const char* names[] = {"low", "middle", "high"};
    for (std::size_t i = 0; i < a.bands.size(); ++i) {
        const std::string name = names[i];
        f.number(a.bands[i].frequency, name + "_frequency", "Hz", 50e3, 2e6, "of the pulse");
        f.number(a.bands[i].source_level, name + "_source_level", "dB re 1 uPa at 1 m", 100, 240,
                 "on the axis, to port");
        f.degrees(a.bands[i].beam_width, name + "_beam_width", 0.05, 20,
                  "-3 dB full width along the track, two-way");
        f.degrees(a.bands[i].fan_height, name + "_fan_height", 1, 120,
                  "-3 dB full width across the track, two-way");
    }
    f.number(a.pulse_length, "pulse_length", "s", 1e-6, 10e-3, "of every pulse");
    f.degrees(a.depressions[0], "port_depression", 0, 80, "of the axis below the horizontal");
    f.degrees(a.depressions[1], "starboard_depression", 0, 80, "of the axis below the horizontal");
    f.number(a.starboard_trim, "starboard_trim", "dB", -30, 30, "source level to starboard against port");
    f.number(a.full_scale_level, "full_scale_level", "dB re 1 uPa", 0, 300,
             "of an echo at 1 m that reads full scale at no gain");
    f.common(a.horizontal, a.vertical, a.receiver);
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    if (s.header.size() != 3)
        throw std::invalid_argument("option header: '" + s.header + "' must be 3 letters");
    return s;
}

double range_of(const imagenex::SwitchCommand& command) {
    constexpr std::array ranges{10, 20, 30, 40, 50, 60, 80, 100, 125, 150, 200};
    constexpr int longest_of_high = 50;
    int range = ranges[0];
    for (const int one : ranges)
        if (one <= command.range) range = one;
    return band_of(command) == 2 ? std::min(range, longest_of_high) : range;
}

/// Byte 7; what is more than 2 is the highest.
std::size_t band_of(const imagenex::SwitchCommand& command) {
    return std::min<std::size_t>(command.reserved7, 2);
}

Shot shot_from(const imagenex::SwitchCommand& command, const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const Band& band = a.bands[band_of(command)];
    Shot shot;
    shot.bearings = {-std::numbers::pi / 2, std::numbers::pi / 2};
    shot.sides = {{a.depressions[0], band.source_level},
                  {a.depressions[1], band.source_level + a.starboard_trim}};
    shot.beam_width = band.beam_width;
    shot.fan_height = band.fan_height;
    shot.bins = points;
    shot.bin_interval = 2 * range_of(command) / settings.sound_speed / points;
    shot.frequency = band.frequency;
    shot.pulse_length = a.pulse_length;
    shot.source_level = band.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    return shot;
}

}  // namespace echoloop::imagenex872
