#include "emulator/devices/family/tritech/acoustics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace echoloop::tritech {
namespace {

constexpr double intermediate_frequency = 455e3;  // Hz
constexpr double clock_frequency = 32e6;          // Hz
constexpr double silence = -300;                  // dB

/// `prefix`: "" or "low_". Its directivity index is left out.
void describe(Band& b, const std::string& prefix, FigureList& f) {
    f.number(b.frequency, prefix + "frequency", "Hz", 10e3, 10e6,
             "of the transducer, the middle of a swept band");
    f.number(b.source_level, prefix + "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(b.beam_width, prefix + "beam_width", 0.1, 60, "horizontal -3 dB full width, two-way");
    f.degrees(b.fan_height, prefix + "fan_height", 0.1, 120, "vertical -3 dB full width, two-way");
    f.number(b.absorption, prefix + "tvg_absorption", "dB/m", 0, 2, "time-varied gain, one way");
}

void describe(Tunable& t, FigureList& f) {
    describe(t.low, "low_", f);
    f.number(t.low.directivity_index, "low_directivity_index", "dB", 0, 60,
             "of the receiver against isotropic noise");
    f.number(t.lowest, "lowest_frequency", "Hz", 10e3, 10e6, "a lower TxN is raised to it");
    f.number(t.highest, "highest_frequency", "Hz", 10e3, 10e6, "a higher TxN is lowered to it");
    f.number(t.receiver_band, "receiver_band", "Hz", 0, 5e6,
             "RxN further away from TxN hears nothing but noise");
}

/// The same aperture at another frequency: widths go with 1 / f, absorption about with f, the index with f^2.
Band at_frequency(Band band, double frequency) {
    const double ratio = frequency / band.frequency;
    constexpr double widest = 2.0;  // rad
    band.beam_width = std::min(band.beam_width / ratio, widest);
    band.fan_height = std::min(band.fan_height / ratio, widest);
    band.directivity_index = std::max(0.0, band.directivity_index + 20 * std::log10(ratio));
    band.absorption *= ratio;
    band.frequency = frequency;
    return band;
}

}  // namespace

double frequency_of(std::uint32_t word) { return word * clock_frequency / 0x1p32; }

double usual_slope(double frequency) {
    // A public driver's table.
    constexpr std::array<std::pair<double, double>, 8> table{{{200e3, 70},
                                                              {325e3, 90},
                                                              {580e3, 110},
                                                              {675e3, 125},
                                                              {795e3, 130},
                                                              {935e3, 140},
                                                              {1210e3, 150},
                                                              {2000e3, 180}}};
    const auto above =
        std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.first >= frequency; });
    if (above == table.begin()) return table.front().second;
    if (above == table.end()) return table.back().second;
    const auto below = std::prev(above);
    const double part = (frequency - below->first) / (above->first - below->first);
    return std::lerp(below->second, above->second, part);
}

Tuning tune(const Acoustics& acoustics, const Channel& channel) {
    if (!acoustics.tunable) return {acoustics.band};
    const Tunable& t = *acoustics.tunable;
    const double asked = channel.tx_n == 0 ? acoustics.band.frequency : frequency_of(channel.tx_n);
    const double frequency = std::clamp(asked, t.lowest, t.highest);
    const bool low = frequency < std::sqrt(t.low.frequency * acoustics.band.frequency);
    Tuning tuning{at_frequency(low ? t.low : acoustics.band, frequency)};
    const double heard = frequency_of(channel.rx_n) - intermediate_frequency;
    tuning.deaf = channel.rx_n != 0 && std::abs(heard - frequency) > t.receiver_band;
    tuning.tvg = channel.slope / usual_slope(frequency);
    return tuning;
}

double tvg_db(double range, const Acoustics& acoustics, const Tuning& tuning) {
    if (!acoustics.tvg) return 0;
    const double r = std::max(range, 1.0);
    return tuning.tvg * (acoustics.tvg_spreading * std::log10(r) + 2 * tuning.band.absorption * r);
}

Shot sounding(const Acoustics& acoustics, const Tuning& tuning, double pulse) {
    Shot shot;
    shot.bearings = {0.0};
    shot.beam_width = tuning.band.beam_width;
    shot.fan_height = tuning.band.fan_height;
    shot.frequency = tuning.band.frequency;
    shot.bandwidth = acoustics.bandwidth;
    shot.pulse_length = std::max(pulse, acoustics.shortest_pulse);
    shot.source_level = tuning.deaf ? silence : tuning.band.source_level;
    shot.horizontal = acoustics.horizontal;
    shot.vertical = acoustics.vertical;
    shot.receiver = acoustics.receiver;
    shot.receiver.directivity_index = tuning.band.directivity_index;
    return shot;
}

void describe(Acoustics& a, FigureList& f) {
    describe(a.band, "", f);
    f.number(a.bandwidth, "bandwidth", "Hz", 0, 5e6, "width of the swept band; 0: a tone");
    f.number(a.shortest_pulse, "shortest_pulse", "s", 1e-6, 1e-2,
             "shorter commanded pulses are lengthened to it");
    f.number(a.tvg_spreading, "tvg_spreading", "dB per decade of range", 0, 60, "time-varied gain");
    f.number(a.reference_level, "reference_level", "dB re 1 uPa", 0, 300,
             "level after time-varied gain that reads 0 dB at zero gain");
    if (a.tunable) describe(*a.tunable, f);
    f.common(a.horizontal, a.vertical, a.receiver);
    f.number(a.receiver.most_looks, "most_looks", "", 1, 1e6, "that a bin takes, however long it is");
    a.band.directivity_index = a.receiver.directivity_index;
}

}  // namespace echoloop::tritech
