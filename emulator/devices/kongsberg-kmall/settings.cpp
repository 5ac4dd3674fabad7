#include "emulator/devices/kongsberg-kmall/settings.h"

#include <cmath>
#include <utility>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::kongsberg_kmall {
namespace {

const char* const notes = "specification notes on KMALL";
const char* const own = "own choice";

void read_options(const Options& o, Settings& s) {
    s.pinging = flag(o, "pinging");
    s.water_column = flag(o, "water_column");
    s.range = number(o, "range");
    s.frequency = number(o, "frequency");
    s.pulse = number(o, "pulse");
    s.power = number(o, "power");
    s.port_edge = s.starboard_edge = deg_to_rad(number(o, "sector_width")) / 2;
    s.values_as_xml = text(o, "values_text") == "814";
    s.soundings = static_cast<std::size_t>(integer(o, "soundings"));
    s.equidistant = text(o, "beam_spacing") == "equidistant";
    s.ping_rate = number(o, "ping_rate");
    s.absorption = number(o, "absorption") / 1000;
    s.version = text(o, "mrz_version") == "0" ? 0 : 2;
    s.sounder = static_cast<std::uint16_t>(integer(o, "sounder"));
    s.system_id = static_cast<std::uint8_t>(integer(o, "system_id"));
    s.latitude = number(o, "latitude");
    s.longitude = number(o, "longitude");
    s.datagram_gap = number(o, "datagram_gap");
}

void read_profile(const Profile& p, Settings& s) {
    s.source_level = figure(p, "source_level");
    s.receive_beam_width = deg_to_rad(figure(p, "receive_beam_width"));
    s.transmit_beam_width = deg_to_rad(figure(p, "transmit_beam_width"));
    s.detection_margin = figure(p, "detection_margin");
    s.water_column_reference = figure(p, "water_column_reference");
    s.horizontal = axis_pattern(p, "horizontal");
    s.vertical = axis_pattern(p, "vertical");
    s.receiver = receiver(p);
    s.tune(std::exchange(s.frequency, figure(p, "reference_frequency")));
}

}  // namespace

void Settings::tune(double hertz) {
    const double ratio = std::exchange(frequency, hertz) / hertz;
    receive_beam_width *= ratio;
    transmit_beam_width *= ratio;
    receiver.directivity_index -= 20 * std::log10(ratio);
}

std::vector<Option> option_table() {
    return {
        flag_row("pinging", true, "it pings at power-up; the text 458 starts, 457 stops it",
                 "own choice, so that a first run shows a bottom"),
        flag_row("water_column", false, "#MWC at power-up; the text 461 switches it on, 460 off", own),
        number_row("range", "m", 40, 2, 600, "how far it listens", own),
        number_row("frequency", "Hz", 300e3, 200e3, 400e3, "frequency mode",
                   "maker's names of the EM 2040's modes: 200, 300, 400 kHz"),
        number_row("pulse", "s", 35e-6, 25e-6, 600e-6, "CW pulse length", own),
        number_row("power", "dB", 0, -40, 0, "re full power", own),
        number_row("sector_width", "deg", 120, 10, 150, "of the fan", own),
        integer_row("soundings", "", 400, 16, 512, "beams of a ping", "two real #MRZ datagrams: 400"),
        choice_row("beam_spacing", {"equiangle", "equidistant"}, "on a flat floor", notes),
        number_row("ping_rate", "Hz", 5, 0.1, 50, "upper limit", own),
        number_row("absorption", "dB/km", 70, 0, 300, "that the sounder reckons with in its gain", own),
        choice_row("mrz_version", {"2", "0"}, "of #MRZ: 152 or 144 bytes of ping info", notes),
        integer_row("sounder", "", 2040, 1, 65535,
                    "number of the echo sounder; commands must name it: EM2040_40, EM2040 or 2040", notes),
        integer_row("system_id", "", 40, 0, 255,
                    "tells sounders of one number apart; ends the sounder's name",
                    "default of a known driver: EM2040_40"),
        number_row("latitude", "deg", 0, -89, 89, "of the scene's origin", own),
        number_row("longitude", "deg", 0, -180, 180, "of the scene's origin", own),
        choice_row("values_text", {"401", "814"},
                   "the number of the text that answers 261 and 262: JSON, or XML of later controllers",
                   "401: a known driver's list of texts; 814: its code"),
        number_row("datagram_gap", "s", 2e-3, 0, 0.1, "pause between the parts of a water column",
                   "own choice: receivers with default buffers lose faster bursts"),
    };
}

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"source_level", "dB re 1 uPa at 1 m", "at full power", 100, 260},
        {"reference_frequency", "Hz", "at which beam widths and directivity index are given", 10e3, 10e6},
        {"receive_beam_width", "deg", "-3 dB full width across track, one way", 0.05, 20},
        {"transmit_beam_width", "deg", "-3 dB full width along track, one way", 0.05, 20},
        {"water_column_reference", "dB re 1 uPa", "level after gain that reads 0 dB in #MWC", 0, 300},
        {"detection_margin", "dB", "echoes that are not so far above the noise are no bottom", 0, 60},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

Settings read_settings(const DeviceConfig& config) {
    Settings s;
    read_options(config.options, s);
    read_profile(config.profile, s);
    s.tvg = config.effects.has(Effect::tvg);
    s.echoes_last = config.effects.has(Effect::pulse);
    s.sound_speed = config.sound_speed;
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::kongsberg_kmall
