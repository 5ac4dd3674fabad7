#include "emulator/devices/norbit-wbms/settings.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::norbit_device {
namespace {

const char* const spec = "Norbit WBMS specification notes";
const char* const document = "Norbit TN-180196, WBMS DFD External";
const char* const own = "own choice";

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.reference_frequency = figure(p, "reference_frequency");
    a.receive_beam_width = deg_to_rad(figure(p, "receive_beam_width"));
    a.transmit_beam_width = deg_to_rad(figure(p, "transmit_beam_width"));
    a.forward_fan_height = deg_to_rad(figure(p, "forward_fan_height"));
    a.widest_swath = deg_to_rad(figure(p, "widest_swath"));
    a.source_level = figure(p, "source_level");
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.full_scale = figure(p, "full_scale");
    a.largest_gain = figure(p, "largest_gain");
    a.detection_margin = figure(p, "detection_margin");
    a.processing = figure(p, "processing_time");
    return a;
}

norbit::BeamMode read_beam_mode(const std::string& word) {
    if (word == "512EA") return norbit::BeamMode::ea512;
    return word == "256ED" ? norbit::BeamMode::ed256 : norbit::BeamMode::ea256;
}

norbit::Sample read_sample(const std::string& word) {
    if (word == "u8") return norbit::Sample::u8;
    if (word == "u16") return norbit::Sample::u16;
    return word == "f32" ? norbit::Sample::f32 : norbit::Sample::s16;
}

/// A word that an answer can carry.
std::string read_word(const Options& options, const std::string& name) {
    const std::string& word = text(options, name);
    const bool plain =
        std::all_of(word.begin(), word.end(), [](char c) { return c > ' ' && c <= '~' && c != '#'; });
    if (word.empty() || word.size() > 64 || !plain)
        throw std::invalid_argument("option " + name + ": '" + word +
                                    "' must be 1 to 64 printable ASCII characters without blanks and '#'");
    return word;
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"reference_frequency", "Hz", "at which the beam widths hold", 80e3, 1e6},
        {"receive_beam_width", "deg", "-3 dB full width across track", 0.05, 20},
        {"transmit_beam_width", "deg", "-3 dB full width along track", 0.05, 60},
        {"forward_fan_height", "deg", "-3 dB full width along track of the forward-looking system", 0.05, 60},
        {"widest_swath", "deg", "wider opening angles are cut", 10, 340},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis at amplitude 15", 100, 240},
        {"full_scale", "dB re 1 uPa", "reads full scale at 0 dB gain", 50, 300},
        {"largest_gain", "dB", "digital", 0, 120},
        {"detection_margin", "dB", "echoes that are not so far above the noise are no bottom", 0, 60},
        {"processing_time", "s", "from the last echo to the packets", 0, 1},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    return {
        choice_row("system", {"bathymetry", "forward-looking"},
                   "values at the start of mode (1, 0), flip (1, 0) and gate mode (1, 0)", document),
        choice_row("beam_mode", {"256EA", "512EA", "256ED"}, "beams at equal angles or equal distances",
                   spec),
        choice_row("sample", {"s16", "u8", "u16", "f32"}, "type of the water column's samples",
                   "Norbit WBMS specification notes: a known reader accepts s16 only"),
        integer_row("version", "", 4, 0, 4294967295.0, "in every packet", spec),
        choice_row("water_column_frequency", {"kHz", "Hz"}, "unit of frequency and bandwidth there", spec),
        choice_row("water_column_vga", {"f32", "s32"}, "type of the gains g1 and g2 there", spec),
        flag_row("newer_fields", false,
                 "fills what the document reserves: time uncertainty, multi-ping, raw sound speed, flags of "
                 "points",
                 spec),
        flag_row("power", false, "pings from the start, without set_power 1", document),
        number_row("command_pause", "s", 0.1, 0.01, 10,
                   "silence after which a command without a line's end is obeyed",
                   "own choice: a known driver sends no line ends and waits 0.5 s for its answer"),
        number_row("temperature", "degC", 25, -20, 100, "answered to 'temperature'", own),
        text_row("revision", "10.3.6", "in the greeting and answered to 'revision'",
                 "Norbit TN-180197 1D: the sonar in its pictures"),
        text_row("serial", "1001", "answered to 'serial'", own),
        text_row("partno", "12004", "answered to 'partno'",
                 "own choice: a part number of the maker's drawings"),
    };
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.forward_looking = text(o, "system") == "forward-looking";
    s.beam_mode = read_beam_mode(text(o, "beam_mode"));
    s.sample = read_sample(text(o, "sample"));
    s.version = static_cast<std::uint32_t>(integer(o, "version"));
    s.hertz_in_water_column = text(o, "water_column_frequency") == "Hz";
    s.whole_vga_gains = text(o, "water_column_vga") == "s32";
    s.newer_fields = flag(o, "newer_fields");
    s.power = flag(o, "power");
    s.command_pause = number(o, "command_pause");
    s.temperature = number(o, "temperature");
    s.revision = read_word(o, "revision");
    s.serial = read_word(o, "serial");
    s.part_number = read_word(o, "partno");
    s.sound_speed = config.sound_speed;
    s.unix_start = config.unix_start;
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    s.acoustics = read_acoustics(config.profile);
    return s;
}

}  // namespace echoloop::norbit_device
