#include "emulator/devices/micron-echosounder/settings.h"

#include <algorithm>
#include <utility>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::micron_echosounder {
namespace {

const char* const spec = "SeaNet specification notes";
const char* const manual = "maker's manual of the Micron Echosounder";
const std::vector<std::string> formats{"3P3", "3P2", "mm", "nmea"};
const std::vector<std::string> no_echoes{"zero", "maximum", "silent"};

/// The enumerator at the place of `word` among `words`, which has it.
template <class Enum>
Enum choice(const std::vector<std::string>& words, const std::string& word) {
    return static_cast<Enum>(std::find(words.begin(), words.end(), word) - words.begin());
}

}  // namespace

std::vector<Option> option_table() {
    std::vector<Option> rows{
        choice_row("format", formats,
                   "3P3: xxx.xxxm CR LF; 3P2: xxx.xxm CR LF; mm: whole millimetres, dmm LF; nmea: $PADBT",
                   spec),
        choice_row("no_bottom", no_echoes,
                   "reading without an echo: zero, the greatest range, or none at all", manual),
        choice_row("mode", {"free-running", "interrogated"},
                   "interrogated: one reading after each Z; F and Z of the host change it", manual),
        number_row("rate", "Hz", 4, 0.05, 20,
                   "pings a second while free-running; less where the line is slower",
                   "own choice: one host is too slow for 5 Hz, another waits for 1 s at most"),
        number_row("range", "m", 50, 1, 500, "greatest depth that it listens for",
                   "own choice: what the emulated transducer reaches"),
        number_row("baud", "bit/s", 9600, 0, 4e6,
                   "line rate of pty and TCP endpoints; 0: not paced; not of UDP",
                   "SeaNet specification notes; the format mm goes with 115200"),
    };
    for (Option& row : echosounder::common_options()) rows.push_back(std::move(row));
    return rows;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.sounding = echosounder::read_sounding(config);
    s.format = text(o, "format") == "nmea"
                   ? std::nullopt
                   : std::optional(choice<altimeter::Format>(formats, text(o, "format")));
    s.no_echo = choice<NoEcho>(no_echoes, text(o, "no_bottom"));
    s.free_running = text(o, "mode") == "free-running";
    return s;
}

}  // namespace echoloop::micron_echosounder
