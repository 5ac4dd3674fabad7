#include "emulator/devices/micron-echosounder/settings.h"

#include "emulator/contract/endpoint.h"

namespace echoloop::micron_echosounder {
namespace {

const char* const spec = "SeaNet specification notes";
const char* const manual = "maker's manual of the Micron Echosounder";

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    using altimeter::Format;
    o.words(s.format, "format",
            {{"3P3", Format::three_decimals},
             {"3P2", Format::two_decimals},
             {"mm", Format::millimetres},
             {"nmea", std::nullopt}},
            "3P3: xxx.xxxm CR LF; 3P2: xxx.xxm CR LF; mm: whole millimetres, dmm LF; nmea: $PADBT", spec);
    o.choice(s.no_echo, "no_bottom", {"zero", "maximum", "silent"},
             "reading without an echo: zero, the greatest range, or none at all", manual);
    o.words(s.free_running, "mode", {{"free-running", true}, {"interrogated", false}},
            "interrogated: one reading after each Z; F and Z of the host change it", manual);
    o.number(s.sounding.rate, "rate", "Hz", 0.05, 20,
             "pings a second while free-running; less if the line is slower",
             "own choice: one host is too slow for 5 Hz, another waits for 1 s at most");
    o.number(s.sounding.range, "range", "m", 1, 500, "greatest depth that it listens for",
             "own choice: what the emulated transducer reaches");
    o.number(s.sounding.baud, "baud", "bit/s", 0, 4e6,
             "line rate of pty and TCP endpoints, not of UDP; 0: not paced",
             "SeaNet specification notes; the format mm goes with 115200");
    describe(s.sounding, o, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    s.sounding.baud = line_rate(config.endpoints, s.sounding.baud);
    s.sounding.sensors = Sensors(config.random_key, config.effects);
    return s;
}

}  // namespace echoloop::micron_echosounder
