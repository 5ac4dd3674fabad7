#include "emulator/devices/nmea-echosounder/settings.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

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

}  // namespace

std::vector<Option> option_table() {
    std::vector<Option> rows{
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
        number_row("temperature", "degC", 10, -4, 40, "in MTW",
                   "own choice: the scenario's own default; give the water's"),
        number_row("baud", "bit/s", 4800, 0, 4e6,
                   "line rate of pty and TCP endpoints; 0: not paced; not of UDP",
                   "NMEA 0183: 4800; 38400 for high-speed talkers (0183-HS)"),
    };
    for (Option& row : echosounder::common_options()) rows.push_back(std::move(row));
    return rows;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.sounding = echosounder::read_sounding(config);
    s.style = {text(o, "talker"), static_cast<int>(integer(o, "decimals"))};
    check_talker(s.style.talker);
    s.offset = number(o, "offset");
    s.sentences = read_sentences(text(o, "sentences"), s.offset);
    s.range_in_dpt = text(o, "dpt_fields") == "3";
    s.silent_without_bottom = text(o, "no_bottom") == "silent";
    s.temperature = number(o, "temperature");
    return s;
}

}  // namespace echoloop::nmea_echosounder
