// V31, V32: the looks in a bin and what the receiver makes of them, and how bins correlate over range.
#include <cmath>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr std::size_t looks_beams = 60, looks_bins = 4000;
constexpr double looks_pulse = 0.075;  // m

/// Beams two widths apart, bins of so many pulses.
Shot in_bins(double pulses, BinRule rule) {
    Shot shot = fan(120, 20, looks_beams, looks_bins, pulses * looks_pulse * static_cast<double>(looks_bins));
    shot.beam_width = deg_to_rad(1);
    shot.pulse_length = 2 * looks_pulse / 1500;
    shot.receiver.bins = rule;
    return shot;
}

std::vector<double> speckle(const Shot& shot) {
    std::vector<float> values(looks_beams * looks_bins, 1.0F);
    AcousticChain(only({Effect::pulse, Effect::speckle})).apply(shot, {}, 1500, {}, values);
    return {values.begin(), values.end()};
}

struct BinScatter {
    double mean, looks, db, cv;
};

BinScatter scatter_of(const Shot& shot) {
    const auto values = speckle(shot);
    std::vector<double> amplitude, decibels;
    for (const double v : values) amplitude.push_back(std::sqrt(v)), decibels.push_back(10 * std::log10(v));
    const Moments power = moments(values), of_amplitude = moments(amplitude);
    return {power.mean, power.mean * power.mean / power.variance, std::sqrt(moments(decibels).variance),
            std::sqrt(of_amplitude.variance) / of_amplitude.mean};
}

double over_range(const std::vector<double>& values, std::size_t lag) {
    const std::span<const double> all(values);
    double sum = 0;
    for (std::size_t beam = 0; beam < looks_beams; ++beam)
        sum += correlation(all.subspan(beam * looks_bins + 64, 3800),
                           all.subspan(beam * looks_bins + 64 + lag, 3800)) /
               looks_beams;
    return sum;
}

}  // namespace

void check_looks(Findings& find) {
    struct LooksRow {
        double pulses;  ///< that hold so many looks
        const char* name;
        double mean_db, mean_cv, peak_db, peak_cv, peak_level;
    };
    constexpr LooksRow rows[] = {{1, "2", 3.49, 0.363, 3.59, 0.377, 1.76},
                                 {2.376, "4", 2.31, 0.254, 2.55, 0.284, 3.19},
                                 {5.055, "8", 1.58, 0.178, 1.94, 0.223, 4.34}};
    find.source("gamma distribution; greatest of n exponential variables");
    for (const LooksRow& row : rows) {
        const BinScatter mean = scatter_of(in_bins(row.pulses, BinRule::mean)),
                         peak = scatter_of(in_bins(row.pulses, BinRule::peak));
        const std::string of = std::string(" of ") + row.name + " looks";
        find.within("standard deviation, mean" + of, "dB", row.mean_db, 0.05 * row.mean_db, mean.db);
        find.within("CV of the amplitude, mean" + of, "", row.mean_cv, 0.05 * row.mean_cv, mean.cv);
        find.within("standard deviation, peak" + of, "dB", row.peak_db, 0.05 * row.peak_db, peak.db);
        find.within("CV of the amplitude, peak" + of, "", row.peak_cv, 0.05 * row.peak_cv, peak.cv);
        find.within("level of the peak re the mean" + of, "dB", row.peak_level, 0.1,
                    db(peak.mean / mean.mean));
    }
}

void check_range_texture(Findings& find) {
    find.source("looks in the mean over T of a CW pulse tau (Goodman 2007)");
    struct TextureRow {
        double pulses;
        const char* name;
        double looks;
    };
    constexpr TextureRow rows[] = {{0.25, "0.25", 1.19}, {0.5, "0.5", 1.41}, {1, "1", 2.00},
                                   {2, "2", 3.43},       {4, "4", 6.40},     {8, "8", 12.4}};
    for (const TextureRow& row : rows)
        find.within(std::string("looks at T / tau ") + row.name, "", row.looks, 0.05 * row.looks,
                    scatter_of(in_bins(row.pulses, BinRule::mean)).looks);
    const auto samples = speckle(in_bins(0.125, BinRule::sample));
    find.source("(1 - x / d)^2");
    find.within("correlation over range, x / d 0.25", "", 0.5625, 0.03, over_range(samples, 2));
    find.within("correlation over range, x / d 0.5", "", 0.25, 0.03, over_range(samples, 4));
    find.within("correlation over range, x / d 0.75", "", 0.0625, 0.03, over_range(samples, 6));
}

}  // namespace echoloop::validation
