#include "emulator/devices/norbit-wbms/settings.h"

#include <algorithm>
#include <stdexcept>

namespace echoloop::norbit_device {
namespace {

const char* const spec = "Norbit WBMS specification notes";
const char* const document = "Norbit TN-180196, WBMS DFD External";
const char* const own = "own choice";

/// A text that an answer can carry as a word.
void describe_word(std::string& word, const std::string& name, const char* help, const char* source,
                   OptionList& o) {
    o.text(word, name, help, source);
    const bool plain =
        std::all_of(word.begin(), word.end(), [](char c) { return c > ' ' && c <= '~' && c != '#'; });
    if (word.empty() || word.size() > 64 || !plain)
        throw std::invalid_argument("option " + name + ": '" + word +
                                    "' must be 1 to 64 printable ASCII characters without blanks and '#'");
}

void describe_packets(Settings& s, OptionList& o) {
    using norbit::BeamMode, norbit::Sample;
    o.choice(s.forward_looking, "system", {"bathymetry", "forward-looking"},
             "values at the start of mode (1, 0), flip (1, 0) and gate mode (1, 0)", document);
    o.words(s.beam_mode, "beam_mode",
            {{"256EA", BeamMode::ea256}, {"512EA", BeamMode::ea512}, {"256ED", BeamMode::ed256}},
            "beams at equal angles or equal distances", spec);
    o.words(s.sample, "sample",
            {{"s16", Sample::s16}, {"u8", Sample::u8}, {"u16", Sample::u16}, {"f32", Sample::f32}},
            "type of the water column's samples",
            "Norbit WBMS specification notes: a known reader accepts s16 only");
    o.whole(s.version, "version", "", 0, 4294967295.0, "in every packet", spec);
    o.choice(s.hertz_in_water_column, "water_column_frequency", {"kHz", "Hz"},
             "unit of frequency and bandwidth there", spec);
    o.choice(s.whole_vga_gains, "water_column_vga", {"f32", "s32"}, "type of the gains g1 and g2 there",
             spec);
    o.flag(s.newer_fields, "newer_fields",
           "fills what the document reserves: time uncertainty, multi-ping, raw sound speed, flags of "
           "points",
           spec);
}

void describe_answers(Settings& s, OptionList& o) {
    o.flag(s.power, "power", "pings from the start, without set_power 1", document);
    o.number(s.command_pause, "command_pause", "s", 0.01, 10,
             "silence after which a command without a line end is executed",
             "own choice: a known driver sends no line ends and waits 0.5 s for its answer");
    o.number(s.temperature, "temperature", "degC", -20, 100, "answered to 'temperature'", own);
    describe_word(s.revision, "revision", "in the greeting and answered to 'revision'",
                  "Norbit TN-180197 1D: the sonar in its pictures", o);
    describe_word(s.serial, "serial", "answered to 'serial'", own, o);
    describe_word(s.part_number, "partno", "answered to 'partno'",
                  "own choice: a part number of the maker's drawings", o);
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the packets",
             "own choice: from the last echo to the packets; 60 Hz is reached up to 5 m");
}

void describe_profile(Acoustics& a, std::string_view serial, FigureList& f) {
    f.number(a.reference_frequency, "reference_frequency", "Hz", 80e3, 1e6,
             "at which the beam widths are given");
    f.degrees(a.receive_beam_width, "receive_beam_width", 0.05, 20, "-3 dB full width across track");
    f.degrees(a.transmit_beam_width, "transmit_beam_width", 0.05, 60, "-3 dB full width along track");
    f.degrees(a.forward_fan_height, "forward_fan_height", 0.05, 60,
              "-3 dB full width along track of the forward-looking system");
    f.degrees(a.widest_swath, "widest_swath", 10, 340, "wider opening angles are limited to it");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis at amplitude 15");
    f.number(a.full_scale, "full_scale", "dB re 1 uPa", 50, 300, "reads full scale at 0 dB gain");
    f.number(a.largest_gain, "largest_gain", "dB", 0, 120, "digital");
    multibeam::list_figures(a.detection, f);
    f.common(a.horizontal, a.vertical, a.receiver);
    f.stave_errors(a.errors, serial);
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_packets(s, o);
    describe_answers(s, o);
    describe_profile(s.acoustics, s.serial, f);
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.sound_speed = config.sound_speed;
    s.unix_start = config.unix_start;
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    return s;
}

}  // namespace echoloop::norbit_device
