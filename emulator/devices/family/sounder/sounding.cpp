#include "emulator/devices/family/sounder/sounding.h"

#include <algorithm>
#include <cmath>

namespace echoloop::echosounder {

double Sounding::period() const { return std::max(1 / rate, window() + processing_time); }

double Sounding::line_time(std::size_t bytes) const {
    constexpr double bits_per_byte = 10;  // 8N1
    return baud > 0 ? bits_per_byte * static_cast<double>(bytes) / baud : 0;
}

void describe(Sounding& s, OptionList& o, FigureList& f) {
    o.number(s.sound_speed, "sound_speed", "m/s", 1300, 1700,
             "that it assumes to turn times into depths; the water has its own", "usual setting of sounders");
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the end of listening to the first byte",
             "own estimate");
    o.number(
        s.tracking_lag, "tracking_lag", "s", 0, 10,
        "time constant by which readings follow the bottom; after a jump they wait twice as long. 0: every "
        "ping speaks for itself",
        "none is published");
    Acoustics& a = s.acoustics;
    f.number(a.frequency, "frequency", "Hz", 10e3, 2e6, "of the tone");
    f.number(a.pulse_length, "pulse_length", "s", 10e-6, 10e-3, "of every pulse");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.beam_width, "beam_width", 1, 90, "of the conical beam, -3 dB full width, two-way");
    double blanking = 0;  // m
    f.number(blanking, "blanking", "m", 0, 20, "nothing nearer is taken for the bottom");
    s.bottom.blanking = 2 * blanking / s.sound_speed;
    f.number(s.bottom.margin, "detection_margin", "dB", 0, 60, "how far above the noise a bottom must be");
    f.number(s.bottom.edge, "edge_level", "dB", 0, 40,
             "below the strongest echo, where the bottom's leading edge counts");
    f.common(a.horizontal, a.vertical, a.receiver);
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

Shot plain_shot(Sounding sounding, double sound_speed, std::size_t step, double range) {
    if (range > 0) sounding.range = range * sounding.sound_speed / sound_speed;
    Shot shot = shot_from(sounding);
    shot.ping = step + 1;
    return shot;
}

}  // namespace echoloop::echosounder
