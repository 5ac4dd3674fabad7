#include "emulator/devices/family/sounder/sounding.h"

#include <algorithm>
#include <iterator>

#include "emulator/contract/endpoint.h"
#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::echosounder {
namespace {

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

double Sounding::period() const { return std::max(1 / rate, window() + processing); }

double Sounding::line_time(std::size_t bytes) const {
    constexpr double bits_per_byte = 10;  // 8N1
    return baud > 0 ? bits_per_byte * static_cast<double>(bytes) / baud : 0;
}

std::vector<Option> common_options() {
    return {
        number_row("sound_speed", "m/s", 1500, 1300, 1700,
                   "by which it turns times into depths; the water has its own", "usual setting of sounders"),
        number_row("processing", "s", 0.02, 0, 1, "from the end of listening to the first byte",
                   "own estimate"),
    };
}

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

Sounding read_sounding(const DeviceConfig& config) {
    const Options& o = config.options;
    Sounding s;
    s.rate = number(o, "rate");
    s.range = number(o, "range");
    s.sound_speed = number(o, "sound_speed");
    s.processing = number(o, "processing");
    s.baud = line_rate(config.endpoints, number(o, "baud"));
    s.acoustics = read_acoustics(config.profile);
    s.bottom.blanking = 2 * figure(config.profile, "blanking") / s.sound_speed;
    s.bottom.margin = figure(config.profile, "detection_margin");
    s.bottom.edge = figure(config.profile, "edge_level");
    return s;
}

Shot shot_from(const Sounding& sounding) {
    constexpr double bins_per_pulse = 5, most_bins = 20000;
    const Acoustics& a = sounding.acoustics;
    Shot shot;
    shot.bearings = {0.0};
    shot.beam_width = shot.fan_height = a.beam_width;
    const double bins = sounding.window() * bins_per_pulse / a.pulse_length;
    shot.bins = static_cast<std::size_t>(std::clamp(std::ceil(bins), 1.0, most_bins));
    shot.bin_interval = sounding.window() / static_cast<double>(shot.bins);
    shot.frequency = a.frequency;
    shot.pulse_length = a.pulse_length;
    shot.source_level = a.source_level;
    shot.horizontal = a.horizontal;
    shot.vertical = a.vertical;
    shot.receiver = a.receiver;
    shot.receiver.bandwidth = 1 / a.pulse_length;
    shot.interval = sounding.period();
    return shot;
}

Shot plain_shot(const DeviceConfig& config, std::size_t step, double range) {
    Sounding sounding = read_sounding(config);
    if (range > 0) sounding.range = range * sounding.sound_speed / config.sound_speed;
    Shot shot = shot_from(sounding);
    shot.ping = step + 1;
    return shot;
}

}  // namespace echoloop::echosounder
