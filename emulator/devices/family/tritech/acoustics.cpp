#include "emulator/devices/family/tritech/acoustics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace echoloop::tritech {
namespace {

constexpr double intermediate_frequency = 455e3;  // Hz
constexpr double clock_frequency = 32e6;          // Hz
constexpr double silence = -300;                  // dB

double deg(const Profile& p, const std::string& name) { return deg_to_rad(figure(p, name)); }

/// `prefix`: "" or "low_".
Band read_band(const Profile& p, const std::string& prefix) {
    return {figure(p, prefix + "frequency"),         figure(p, prefix + "source_level"),
            deg(p, prefix + "beam_width"),           deg(p, prefix + "fan_height"),
            figure(p, prefix + "directivity_index"), figure(p, prefix + "tvg_absorption")};
}

std::vector<FigureRow> band_figures(const std::string& prefix) {
    return {
        {prefix + "frequency", "Hz", "of the transducer, the middle of a swept band", 10e3, 10e6},
        {prefix + "source_level", "dB re 1 uPa at 1 m", "on the axis", 100, 240},
        {prefix + "beam_width", "deg", "horizontal -3 dB full width, two-way", 0.1, 60},
        {prefix + "fan_height", "deg", "vertical -3 dB full width, two-way", 0.1, 120},
        {prefix + "tvg_absorption", "dB/m", "time-varied gain, one way", 0, 2},
    };
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

Acoustics read_acoustics(const Profile& p, bool tunable, bool tvg) {
    Acoustics a;
    a.band = read_band(p, "");
    if (tunable)
        a.tunable = Tunable{read_band(p, "low_"), figure(p, "lowest_frequency"),
                            figure(p, "highest_frequency"), figure(p, "receiver_band")};
    a.bandwidth = figure(p, "bandwidth");
    a.shortest_pulse = figure(p, "shortest_pulse");
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.reference_level = figure(p, "reference_level");
    a.tvg_spreading = figure(p, "tvg_spreading");
    a.tvg = tvg;
    return a;
}

std::vector<FigureRow> acoustic_figures(bool tunable) {
    std::vector<FigureRow> rows = band_figures("");
    const auto add = [&](std::vector<FigureRow> more) {
        std::move(more.begin(), more.end(), std::back_inserter(rows));
    };
    add({{"bandwidth", "Hz", "width of the swept band; 0: a tone", 0, 5e6},
         {"shortest_pulse", "s", "shorter commanded pulses are made as long", 1e-6, 1e-2},
         {"tvg_spreading", "dB per decade of range", "time-varied gain", 0, 60},
         {"reference_level", "dB re 1 uPa", "level after time-varied gain that reads 0 dB at zero gain", 0,
          300}});
    if (tunable) {
        add(band_figures("low_"));
        add({{"low_directivity_index", "dB", "of the receiver against isotropic noise", 0, 60},
             {"lowest_frequency", "Hz", "TxN below it is taken as it", 10e3, 10e6},
             {"highest_frequency", "Hz", "TxN above it is taken as it", 10e3, 10e6},
             {"receiver_band", "Hz", "RxN further away from TxN hears nothing but noise", 0, 5e6}});
    }
    add(common_figures());
    return rows;
}

}  // namespace echoloop::tritech
