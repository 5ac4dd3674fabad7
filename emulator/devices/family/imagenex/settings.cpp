#include "emulator/devices/family/imagenex/settings.h"

#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::imagenex_head {
namespace {

const char* const spec = "Imagenex specification notes";

Acoustics read_acoustics(const Profile& p, bool tvg) {
    Acoustics a;
    a.frequency = figure(p, "frequency");
    a.source_level = figure(p, "source_level");
    a.beam_width = deg_to_rad(figure(p, "beam_width"));
    a.fan_height = deg_to_rad(figure(p, "fan_height"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.receiver.bandwidth = figure(p, "receiver_bandwidth");
    a.full_scale_level = figure(p, "full_scale_level");
    a.nearest_range = figure(p, "nearest_range");
    a.ring_down_level = figure(p, "ring_down_level");
    a.ring_down_decay = figure(p, "ring_down_decay");
    a.tvg = tvg;
    return a;
}

/// Of the one line; 0: of datagrams, which come as a whole when their last byte would.
double reply_rate(const DeviceConfig& config) {
    if (config.endpoints.size() != 1)
        throw std::invalid_argument("an Imagenex head has one serial line: give exactly one endpoint");
    if (config.endpoints.front().on_udp()) return 0;
    return line_rate(config.endpoints, number(config.options, "baud"));
}

ShotTiming timing_of(const std::string& word) {
    return word == "none" ? ShotTiming::none : word == "fixed" ? ShotTiming::fixed : ShotTiming::table;
}

std::vector<Option> line_options(const Defaults& defaults) {
    return {
        integer_row("head_id", "", defaults.head_id, defaults.lowest_id, defaults.highest_id,
                    "only commands for this id are answered; several heads may share a pair", spec),
        choice_row("mode_byte", {"any", "strict"},
                   "strict: answer only where byte 6 has the bits transmit, send data and slave", spec),
        choice_row("status", defaults.status, "byte 4 of a reply, hexadecimal", spec),
        choice_row("reply_baud", {"ignored", "honoured"},
                   "byte 21 of a command: the rate at which its reply comes", spec),
        number_row(
            "baud", "bit/s", usual_baud, 0, 4e6,
            "line rate of pty and TCP endpoints; 0: the reply comes as one burst when its last byte would",
            spec),
    };
}

}  // namespace

std::vector<Option> option_table(const Defaults& defaults) {
    auto all = line_options(defaults);
    const std::vector<Option> data{
        choice_row(
            "timing", {"table", "none", "fixed"},
            "from command to the end of the reply: fit of the maker's table; the echo and the line only; "
            "fixed_time",
            spec),
        number_row("fixed_time", "s", 0.1, 0.001, 60, "under timing fixed, never less than the echo takes",
                   spec),
        choice_row("echo_ceiling", defaults.ceilings, "greatest value of 8-bit echo data", spec),
        choice_row("data_16_bit", {"plain", "7+7"},
                   "16-bit echo data, low byte first: 0 to 65535, or 14 bits with bit 7 of each byte clear",
                   spec),
        choice_row("fc_in_data", {"avoided", "kept"},
                   "FC within 4-bit, 16-bit or over-127 echo data: sent as FB, since some hosts read to the "
                   "first FC; or as it is",
                   "own choice: how a head avoids it is not known"),
        number_row("profile_threshold", "%", 50, 1, 100,
                   "of the scale; the first echo above it is the profile range",
                   "recordings of a real 852: first values of 64 to 127 of 127"),
    };
    all.insert(all.end(), data.begin(), data.end());
    return all;
}

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"frequency", "Hz", "at which the widths hold", 10e3, 10e6},
        {"source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {"beam_width", "deg", "horizontal -3 dB full width, two-way", 0.1, 90},
        {"fan_height", "deg", "vertical -3 dB full width, two-way", 0.1, 120},
        {"receiver_bandwidth", "Hz", "lets noise in, whatever the pulse", 1e2, 1e7},
        {"full_scale_level", "dB re 1 uPa", "reads full scale where all gains are 0 dB", 0, 300},
        {"nearest_range", "m", "echoes from nearer are no profile range", 0, 10},
        {"ring_down_level", "dB re 1 uPa", "of the transmitter's own sound at the receiver", -300, 300},
        {"ring_down_decay", "dB/s", "how fast it dies away after the pulse", 1, 1e7},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.head_id = static_cast<std::uint8_t>(integer(o, "head_id"));
    s.strict = text(o, "mode_byte") == "strict";
    s.status = static_cast<std::uint8_t>(std::stoi(text(o, "status"), nullptr, 16));
    s.obey_baud = text(o, "reply_baud") == "honoured";
    s.line_rate = reply_rate(config);
    s.timing = timing_of(text(o, "timing"));
    s.fixed_time = number(o, "fixed_time");
    s.ceiling = std::stoi(text(o, "echo_ceiling"));
    s.seven_bits_each = text(o, "data_16_bit") == "7+7";
    s.keep_fc = text(o, "fc_in_data") == "kept";
    s.profile_threshold = number(o, "profile_threshold") / 100;
    s.acoustics = read_acoustics(config.profile, config.effects.has(Effect::tvg));
    return s;
}

}  // namespace echoloop::imagenex_head
