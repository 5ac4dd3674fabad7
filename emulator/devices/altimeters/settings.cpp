#include "emulator/devices/altimeters/settings.h"

#include <stdexcept>

namespace echoloop::altimeters {
namespace {

const char* const spec = "altimeter specification notes";
const char* const manual = "maker's manual, by the altimeter specification notes";
const char* const own = "own choice: none is published";

void describe_line(Sounding& s, OptionList& o, double fastest, double farthest, const char* rate_source,
                   const char* range_source) {
    o.number(s.rate, "rate", "Hz", 0.0002, fastest,
             "pings a second; less if the range or the line needs longer", rate_source);
    o.number(s.range, "range", "m", 1, farthest, "greatest distance that it listens for", range_source);
    o.number(s.baud, "baud", "bit/s", 0, 4e6, "line rate of pty and TCP endpoints, not of UDP; 0: not paced",
             spec);
}

}  // namespace

void describe(Valeport& s, OptionList& o, FigureList& f) {
    o.choice(s.format, "format", {"NMEA", "SDDBT", "TRITEC", "BENTHOS"},
             "$PRVAT, $SDDBT, or the lines of those makers; a host changes it by #082", manual);
    o.choice(s.no_bottom, "no_bottom", {"zero", "text", "last", "silent"},
             "without an echo: 00.000, the error text, the last distance, or no line", own);
    o.choice(s.pressure, "pressure", {"sensor", "zeros", "none"},
             "in $PRVAT: of a sensor, 0000.000, or no such field", manual);
    o.flag(s.running, "running", "at power-up, since it goes on in its last mode", manual);
    o.text(s.error_text, "error_text", "with no_bottom text; a host changes it by #118", own);
    o.text(s.serial, "serial", "answer to #034", own);
    describe_line(s.sounding, o, 4, 100, "manual: 1, 2 or 4 Hz", "own choice: the specification names none");
    describe(s.sounding, o, f);
}

altimeter::Format Tritech::format() const {
    using altimeter::Format;
    if (!point) return Format::centimetres;
    if (addressed()) return Format::three_decimals;
    return switches >= 12  ? Format::two_decimals
           : switches >= 8 ? Format::two_digits
                           : Format::three_decimals;
}

void describe(Tritech& s, OptionList& o, FigureList& f) {
    o.whole(
        s.switches, "switches", "", 4, 47,
        "sum of its switches: 4 xxx.xxxm, 8 xx.xxxm, 12 xxx.xxm, each + 1 free running, + 2 the greatest "
        "distance without an echo instead of zero; 17, 18 $PADBT; 32 to 39 addressed A to H, 40 to 47 with "
        "the greatest distance",
        manual);
    o.words(s.point, "text", {{"metres", true}, {"centimetres", false}},
            "centimetres: five digits without point or letter, as one public reader divides by 100", spec);
    describe_line(s.sounding, o, 20, 200, "by the specification notes: PA500 10 Hz, PA200 7 Hz",
                  "by a log of a PA500: 50 m");
    describe(s.sounding, o, f);
}

void describe(Benthos& s, OptionList& o, FigureList& f) {
    o.words(s.previous, "no_bottom", {{"previous", true}, {"R99.99E", false}},
            "a missed echo: the previous distance with E, and R99.99E after five; or R99.99E at once",
            manual);
    o.number(s.nearest, "nearest", "m", 0.1, 5, "nearer ones are marked with <", manual);
    describe_line(s.sounding, o, 5, 99.99, manual, manual);
    describe(s.sounding, o, f);
}

void describe(Echologger& s, OptionList& o, FigureList& f) {
    o.words(s.nmea, "output", {{"nmea", true}, {"simple", false}},
            "DBT, DPT and MTW, or metres alone; a host changes it by #output 3 and 1", spec);
    o.number(s.dead_zone, "dead_zone", "m", 0, 10, "nothing nearer is told; #deadzone", spec);
    o.number(s.offset, "offset", "m", -10, 10, "added to what is told; #offset", spec);
    o.number(s.temperature, "temperature", "degC", -4, 40, "in MTW",
             "own choice: the scenario's own default");
    describe_line(s.sounding, o, 10, 100, spec, spec);
    describe(s.sounding, o, f);
}

void describe(Imagenex& s, OptionList& o, FigureList& f) {
    describe_line(s.sounding, o, 20, 49, own, "65535 us there and back at 1500 m/s");
    describe(s.sounding, o, f);
}

void check_switches(int switches) {
    if (switches != 16 && (switches <= 18 || switches >= 32)) return;
    throw std::invalid_argument(
        "option 'switches': " + std::to_string(switches) +
        (switches == 16 ? " is the bathymetric format, whose layout is not public" : " means nothing") +
        "; write 4 to 15, 17, 18 or 32 to 47");
}

}  // namespace echoloop::altimeters
