#include "emulator/devices/imagenex-deltat/settings.h"

namespace echoloop::delta_t {
namespace {

const char* const spec = "Imagenex specification notes";
const char* const own = "own choice";

void describe_start(Controls& c, OptionList& o) {
    o.words(c.range, "range",
            {{"20", 20},
             {"5", 5},
             {"10", 10},
             {"30", 30},
             {"40", 40},
             {"50", 50},
             {"60", 60},
             {"80", 80},
             {"100", 100},
             {"150", 150},
             {"200", 200},
             {"250", 250},
             {"300", 300}},
            "m, until a host sets another", own);
    o.whole(c.gain, "gain", "dB", 0, 20, "until a host sets another", "own choice, as DUNE's default");
    o.words(c.sector, "sector", {{"120", 120}, {"30", 30}, {"60", 60}, {"90", 90}},
            "deg, until a host sets another", own);
    o.words(c.beam_width, "beam_width", {{"normal", 1.5}, {"wide", 3}, {"narrow", 0.75}},
            "1.5, 3 or 0.75 deg, until a host sets another", own);
    o.words(c.beams, "beams", {{"240", 240}, {"480", 480}, {"120", 120}}, "until a host sets another",
            "own choice: with 480 and intensity a datagram is longer than the 2048 bytes that some "
            "hosts read");
    c.sound_speed = 0;
    o.number(c.sound_speed, "sound_speed", "m/s", 0, 1600,
             "reported in the 83P until a host sets another; 0: the true one. It changes no range",
             "own choice: what an operator would have entered");
}

void describe_profile(Settings& s, OptionList& o) {
    o.flag(s.intensity, "intensity", "an 83P also has intensities", own);
    o.words(s.fine_ranges, "range_steps", {{"5000", true}, {"500", false}},
            "steps in which an 83P counts ranges up to the range setting",
            "own choice of the two that there are: 500 would break 0.5 % of a depth in a long range");
    o.number(
        s.smoothing, "smoothing", "beam widths", 0, 10,
        "width on either side of a beam over which the bottom is assumed to be straight; 0: each beam alone",
        "own choice: beams overlap, and speckle would move each by up to 2 % of the depth");
    o.flag(s.orientation, "orientation",
           "pitch, roll and heading are measured, positive with bow up, starboard down",
           "own choice: signs are not public");
    o.choice(s.floats, "floats", {"zeros", "big", "little"},
             "float fields of an 83P: all zero, or filled in this byte order", spec);
    o.words(s.upper_month, "month", {{"upper", true}, {"mixed", false}},
            "NOV, or Nov as in other files of the maker", spec);
    o.choice(s.speed_order, "ec_sound_speed", {"auto", "big", "little"},
             "byte order of the sound speed in an EC; auto: big-endian, or little-endian if that is not 1400 "
             "to 1600 m/s",
             spec);
}

void describe_pace(Settings& s, OptionList& o) {
    o.number(s.frame_rate, "frame_rate", "Hz", 0.1, 50, "most pings a second",
             "maker's data sheet of 2006: better than 20 frames per second");
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the end of the range to the datagram",
             own);
    o.whole(s.serial, "serial", "", 0, 4294967295.0,
            "serial number, which no datagram has; tells whose staves they are", own);
}

void describe(Acoustics& a, std::uint32_t serial, FigureList& f) {
    f.number(a.frequency, "frequency", "Hz", 10e3, 10e6, "of the pulse; in the 83P as kHz");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.fan_height, "fan_height", 0.1, 60, "-3 dB full width of the transmit beam, along track");
    f.number(a.intensity_reference, "intensity_reference", "dB re 1 uPa", 0, 300,
             "level after gain that reads 65535");
    multibeam::list_figures(a.detection, f);
    f.common(a.horizontal, a.vertical, a.receiver);
    f.stave_errors(a.errors, std::to_string(serial));
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_start(s.start, o);
    describe_profile(s, o);
    describe_pace(s, o);
    describe(s.acoustics, s.serial, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    if (!(s.start.sound_speed > 0)) s.start.sound_speed = config.sound_speed;
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::delta_t
