#include "emulator/devices/imagenex-deltat/settings.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::delta_t {
namespace {

const char* const spec = "Imagenex specification notes";
const char* const own = "own choice";

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.frequency = figure(p, "frequency");
    a.source_level = figure(p, "source_level");
    a.fan_height = deg_to_rad(figure(p, "fan_height"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.intensity_reference = figure(p, "intensity_reference");
    a.detection_margin = figure(p, "detection_margin");
    return a;
}

unsigned whole(const Options& o, std::string_view name) {
    return static_cast<unsigned>(std::stoul(text(o, name)));
}

Controls read_start(const Options& o, double true_sound_speed) {
    Controls c;
    c.range = whole(o, "range");
    c.gain = static_cast<unsigned>(integer(o, "gain"));
    c.sector = whole(o, "sector");
    const std::string& width = text(o, "beam_width");
    c.beam_width = width == "wide" ? 3 : width == "normal" ? 1.5 : 0.75;
    c.beams = whole(o, "beams");
    const double speed = number(o, "sound_speed");
    c.sound_speed = speed > 0 ? speed : true_sound_speed;
    return c;
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"frequency", "Hz", "of the pulse; in the 83P as kHz", 10e3, 10e6},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"fan_height", "deg", "-3 dB full width of the transmit beam, along track", 0.1, 60},
        {"intensity_reference", "dB re 1 uPa", "level after gain that reads 65535", 0, 300},
        {"detection_margin", "dB", "echoes that are not so far above the noise are no bottom", 0, 60},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    return {
        choice_row("range",
                   {"20", "5", "10", "30", "40", "50", "60", "80", "100", "150", "200", "250", "300"},
                   "m, until a host sets another", own),
        integer_row("gain", "dB", 3, 0, 20, "until a host sets another", "own choice, as DUNE's default"),
        choice_row("sector", {"120", "30", "60", "90"}, "deg, until a host sets another", own),
        choice_row("beam_width", {"normal", "wide", "narrow"},
                   "1.5, 3 or 0.75 deg, until a host sets another", own),
        choice_row("beams", {"240", "480", "120"}, "until a host sets another",
                   "own choice: with 480 and intensity a datagram is longer than the 2048 bytes that some "
                   "hosts read"),
        number_row("sound_speed", "m/s", 0, 0, 1600,
                   "in the 83P until a host sets another; 0: the true one. It changes no range",
                   "own choice: what an operator would have entered"),
        flag_row("intensity", true, "an 83P has intensities, too", own),
        choice_row("range_steps", {"5000", "500"}, "of a range, in the ranges of an 83P",
                   "own choice of the two that there are: 500 would break 0.5 % of a depth in a long range"),
        number_row("smoothing", "beam widths", 4, 0, 10,
                   "on either side of a beam, over which the bottom is taken as straight; 0: each beam alone",
                   "own choice: beams overlap, and speckle would move each by up to 2 % of the depth"),
        flag_row("orientation", true,
                 "pitch, roll and heading are measured, positive with bow up, starboard down",
                 "own choice: signs are not public"),
        choice_row("floats", {"zeros", "big", "little"},
                   "float fields of an 83P: all zero, or filled in this byte order", spec),
        choice_row("month", {"upper", "mixed"}, "NOV, or Nov as in other files of the maker", spec),
        choice_row(
            "ec_sound_speed", {"auto", "big", "little"},
            "byte order of the sound speed in an EC; auto: big-endian, little-endian where that is not "
            "within 1400 to 1600 m/s",
            spec),
        number_row("frame_rate", "Hz", 20, 0.1, 50, "most pings a second",
                   "maker's data sheet of 2006: better than 20 frames per second"),
        number_row("processing", "s", 0.01, 0, 1, "from the end of the range to the datagram", own),
    };
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.start = read_start(o, config.sound_speed);
    s.acoustics = read_acoustics(config.profile);
    const std::string &order = text(o, "ec_sound_speed"), &floats = text(o, "floats");
    s.speed_order = order == "big"      ? SpeedOrder::big
                    : order == "little" ? SpeedOrder::little
                                        : SpeedOrder::automatic;
    s.floats = floats == "big" ? Floats::big : floats == "little" ? Floats::little : Floats::zeros;
    s.upper_month = text(o, "month") == "upper";
    s.fine_ranges = text(o, "range_steps") == "5000";
    s.smoothing = number(o, "smoothing");
    s.intensity = flag(o, "intensity");
    s.orientation = flag(o, "orientation");
    s.frame_rate = number(o, "frame_rate");
    s.processing = number(o, "processing");
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::delta_t
