#include "emulator/devices/nmea-echosounder/settings.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "emulator/option_rows.h"
#include "emulator/options.h"

namespace echoloop::nmea_echosounder {
namespace {

const char* const standard = "NMEA 0183, as makers' manuals quote it";

void check_talker(const std::string& talker) {
    const bool good = talker.size() == 2 && std::all_of(talker.begin(), talker.end(), [](char c) {
                          return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                      });
    if (!good)
        throw std::invalid_argument("option 'talker': '" + talker +
                                    "' is no talker identifier; write two capital letters like SD");
}

/// "DPT DBT" to its words, each of them known and possible with this offset.
std::vector<std::string> read_sentences(const std::string& words, double offset) {
    static const std::vector<std::string> known{"DPT", "DBT", "MTW", "DBS", "DBK"};
    std::istringstream in(words);
    std::vector<std::string> all;
    for (std::string word; in >> word; all.push_back(word)) {
        if (std::find(known.begin(), known.end(), word) == known.end())
            throw std::invalid_argument("option 'sentences': '" + word +
                                        "' is not known; write some of DPT DBT MTW DBS DBK");
        if (word == "DBS" && offset < 0)
            throw std::invalid_argument("sentence DBS needs 'offset' up to the water line, so not negative");
        if (word == "DBK" && offset > 0)
            throw std::invalid_argument("sentence DBK needs 'offset' down to the keel, so not positive");
    }
    if (all.empty()) throw std::invalid_argument("option 'sentences' is empty; write e.g. DPT DBT MTW");
    return all;
}

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.frequency = figure(p, "frequency");
    a.pulse_length = figure(p, "pulse_length");
    a.source_level = figure(p, "source_level");
    a.beam_width = deg_to_rad(figure(p, "beam_width"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    return a;
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"frequency", "Hz", "of the tone", 10e3, 2e6},
        {"pulse_length", "s", "of every pulse", 10e-6, 10e-3},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"beam_width", "deg", "of the conical beam, -3 dB full width, two-way", 1, 90},
        {"blanking", "m", "nothing nearer is taken for the bottom", 0, 20},
        {"detection_margin", "dB", "that a bottom stands above the noise", 0, 60},
        {"edge_level", "dB", "below the strongest echo, where the bottom's leading edge counts", 0, 40},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    return {
        text_row("talker", "SD", "talker identifier of every sentence", standard),
        text_row("sentences", "DPT DBT MTW", "in this order after each ping; also DBS and DBK", standard),
        number_row("rate", "Hz", 1, 0.05, 20, "pings a second; less where range or line need longer",
                   "own choice: usual for sounders on a 4800 bit/s line"),
        integer_row("decimals", "", 2, 0, 3, "of depths", "own choice; makers write 1 to 3"),
        number_row("offset", "m", 0, -50, 50,
                   "of DPT: positive up to the water line, negative down to the keel", standard),
        choice_row("dpt_fields", {"3", "2"}, "3: with the range in use, from version 3.0 on", standard),
        choice_row("no_bottom", {"empty", "silent"},
                   "empty: depth sentences with null fields; silent: none, MTW alone",
                   "recorded sentences of sounders without a bottom"),
        number_row("range", "m", 100, 1, 1000, "greatest depth that it listens for", "own choice"),
        number_row("sound_speed", "m/s", 1500, 1300, 1700,
                   "by which it turns times into depths; the water has its own", "usual setting of sounders"),
        number_row("temperature", "degC", 10, -4, 40, "in MTW",
                   "own choice: the scenario's own default; give the water's"),
        number_row("processing", "s", 0.02, 0, 1, "from the end of listening to the first sentence",
                   "own estimate"),
        number_row("baud", "bit/s", 4800, 0, 4e6,
                   "line rate of pty and TCP endpoints; 0: not paced; not of UDP",
                   "NMEA 0183: 4800; 38400 for high-speed talkers (0183-HS)"),
    };
}

double Settings::period() const { return std::max(1 / rate, window() + processing); }

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.style = {text(o, "talker"), static_cast<int>(integer(o, "decimals"))};
    check_talker(s.style.talker);
    s.offset = number(o, "offset");
    s.sentences = read_sentences(text(o, "sentences"), s.offset);
    s.range_in_dpt = text(o, "dpt_fields") == "3";
    s.silent_without_bottom = text(o, "no_bottom") == "silent";
    s.rate = number(o, "rate");
    s.range = number(o, "range");
    s.sound_speed = number(o, "sound_speed");
    s.temperature = number(o, "temperature");
    s.processing = number(o, "processing");
    s.baud = number(o, "baud");
    s.acoustics = read_acoustics(config.profile);
    s.bottom = {2 * figure(config.profile, "blanking") / s.sound_speed,
                figure(config.profile, "detection_margin"), figure(config.profile, "edge_level")};
    return s;
}

Shot shot_from(const Settings& settings) {
    constexpr double bins_per_pulse = 5, most_bins = 20000;
    const Acoustics& a = settings.acoustics;
    Shot shot;
    shot.bearings = {0.0};
    shot.beam_width = shot.fan_height = a.beam_width;
    const double bins = settings.window() * bins_per_pulse / a.pulse_length;
    shot.bins = static_cast<std::size_t>(std::clamp(std::ceil(bins), 1.0, most_bins));
    shot.bin_interval = settings.window() / static_cast<double>(shot.bins);
    shot.frequency = a.frequency;
    shot.pulse_length = a.pulse_length;
    shot.source_level = a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.receiver.bandwidth = 1 / a.pulse_length;
    shot.interval = settings.period();
    return shot;
}

}  // namespace echoloop::nmea_echosounder
