#include "emulator/devices/nmea-echosounder/settings.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "emulator/contract/endpoint.h"

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

std::vector<std::string> split(const std::string& words) {
    std::istringstream in(words);
    return {std::istream_iterator<std::string>(in), {}};
}

/// Each of them is known and possible with this offset.
void check_sentences(const std::vector<std::string>& sentences, double offset) {
    static const std::vector<std::string> known{"DPT", "DBT", "MTW", "DBS", "DBK"};
    for (const std::string& word : sentences) {
        if (std::find(known.begin(), known.end(), word) == known.end())
            throw std::invalid_argument("option 'sentences': '" + word +
                                        "' is not known; write some of DPT DBT MTW DBS DBK");
        if (word == "DBS" && offset < 0)
            throw std::invalid_argument("sentence DBS needs 'offset' up to the water line, so not negative");
        if (word == "DBK" && offset > 0)
            throw std::invalid_argument("sentence DBK needs 'offset' down to the keel, so not positive");
    }
    if (sentences.empty()) throw std::invalid_argument("option 'sentences' is empty; write e.g. DPT DBT MTW");
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.text(s.style.talker, "talker", "talker identifier of every sentence", standard);
    std::string sentences = "DPT DBT MTW";
    o.text(sentences, "sentences", "in this order after each ping; also DBS and DBK", standard);
    s.sentences = split(sentences);
    o.number(s.sounding.rate, "rate", "Hz", 0.05, 20,
             "pings a second; less if the range or the line needs longer",
             "own choice: usual for sounders on a 4800 bit/s line");
    o.whole(s.style.decimals, "decimals", "", 0, 3, "of depths", "own choice; makers write 1 to 3");
    o.number(s.offset, "offset", "m", -50, 50,
             "of DPT: positive up to the water line, negative down to the keel", standard);
    o.words(s.range_in_dpt, "dpt_fields", {{"3", true}, {"2", false}},
            "3: with the range in use, from version 3.0 on", standard);
    o.choice(s.silent_without_bottom, "no_bottom", {"empty", "silent"},
             "empty: depth sentences with null fields; silent: only MTW",
             "recorded sentences of sounders without a bottom");
    o.number(s.sounding.range, "range", "m", 1, 1000, "greatest depth that it listens for", "own choice");
    o.number(s.temperature, "temperature", "degC", -4, 40, "in MTW",
             "own choice: the scenario's own default; give the water's");
    o.number(s.sounding.baud, "baud", "bit/s", 0, 4e6,
             "line rate of pty and TCP endpoints, not of UDP; 0: not paced",
             "NMEA 0183: 4800; 38400 for high-speed talkers (0183-HS)");
    describe(s.sounding, o, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    s.sounding.baud = line_rate(config.endpoints, s.sounding.baud);
    s.sounding.sensors = Sensors(config.random_key, config.effects);
    check_talker(s.style.talker);
    check_sentences(s.sentences, s.offset);
    return s;
}

}  // namespace echoloop::nmea_echosounder
