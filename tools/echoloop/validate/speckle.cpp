// V8: the statistics of speckle, of the chain that every echo goes through. How it moves: moving_speckle.cpp.
#include <algorithm>
#include <cmath>

#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr std::size_t bins_per_pulse = 8, bins = 4096, speckle_beams = 120;

/// Bins much shorter than the pulse, so that a value is a sample and not a mean.
Shot speckle_shot() {
    Shot shot = fan(120, 20, speckle_beams, bins, 60);
    shot.pulse_length = static_cast<double>(bins_per_pulse) * shot.bin_interval;
    shot.receiver.bandwidth = 20 / shot.pulse_length;  // so wide that the pulse keeps its shape
    shot.receiver.bins = BinRule::sample;
    return shot;
}

/// Powers relative to their mean, of an even mean echo.
std::vector<double> speckled(const Pose& pose, SpeckleOptions options = {}, std::uint64_t ping = 0) {
    AcousticChain chain(only({Effect::pulse, Effect::speckle}), options);
    Shot shot = speckle_shot();
    shot.ping = ping;
    std::vector<float> values(speckle_beams * bins, 1.0F / bins_per_pulse);
    chain.apply(shot, pose, 1500, {}, values);
    return {values.begin(), values.end()};
}

/// Every 16th bin, two pulses apart, of every other beam, without those that the window's begin cuts.
std::vector<double> independent(const std::vector<double>& values) {
    std::vector<double> samples;
    for (std::size_t beam = 0; beam < speckle_beams; beam += 2)
        for (std::size_t bin = 32; bin < bins; bin += 2 * bins_per_pulse)
            samples.push_back(values[beam * bins + bin]);
    return samples;
}

std::vector<double> beam_of(const std::vector<double>& values, std::size_t beam, std::size_t shift = 0) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(beam * bins + 32 + shift);
    return {begin, begin + static_cast<std::ptrdiff_t>(bins - 128)};
}

/// Mean over the beams of the correlation with itself `lag` bins on.
double range_correlation(const std::vector<double>& values, std::size_t lag) {
    double sum = 0;
    for (std::size_t beam = 0; beam < speckle_beams; ++beam)
        sum += correlation(beam_of(values, beam), beam_of(values, beam, lag)) /
               static_cast<double>(speckle_beams);
    return sum;
}

/// Pulse lengths: a rectangular pulse's intensities correlate by (1 - lag / length)^2, a quarter at half its
/// length.
double correlation_length(const std::vector<double>& values) {
    double before = 1;
    for (std::size_t lag = 1; lag < 4 * bins_per_pulse; ++lag) {
        const double now = range_correlation(values, lag);
        if (now < 0.25)
            return 2 * (static_cast<double>(lag) - (0.25 - now) / (before - now)) / bins_per_pulse;
        before = now;
    }
    return 99;
}

std::vector<double> mapped(std::vector<double> values, double (*function)(double)) {
    std::transform(values.begin(), values.end(), values.begin(), function);
    return values;
}

Curve histogram(const std::vector<double>& samples) {
    Curve curve{"measured", {}, true};
    constexpr double width = 0.25;
    for (double x = 0; x < 6; x += width) {
        const auto in =
            std::count_if(samples.begin(), samples.end(), [&](double v) { return v >= x && v < x + width; });
        const double density = static_cast<double>(in) / (width * static_cast<double>(samples.size()));
        if (in > 0) curve.points.emplace_back(x + width / 2, std::log10(density));
    }
    return curve;
}

void check_distribution(Findings& find, const std::vector<double>& all) {
    const auto samples = independent(all);
    const auto n = static_cast<double>(samples.size());
    const Moments power = moments(samples);
    const Moments amplitude = moments(mapped(samples, [](double v) { return std::sqrt(v); }));
    const Moments decibels = moments(mapped(samples, [](double v) { return 10 * std::log10(v); }));
    find.source("Rayleigh amplitude, exponential power (Goodman 2007)");
    find.within("mean power re the mean echo", "dB", 0, 0.1, db(power.mean));
    find.within("coefficient of variation of the amplitude", "", 0.5227, 0.02,
                std::sqrt(amplitude.variance) / amplitude.mean);
    find.within("var(I) / mean(I)^2", "", 1, 0.08, power.variance / (power.mean * power.mean));
    find.within("skewness of I", "", 2, 0.25, power.skewness);
    find.within("standard deviation of the level", "dB", 5.57, 0.15, std::sqrt(decibels.variance));
    find.within("mean level less level of the mean", "dB", -2.51, 0.1, decibels.mean - db(power.mean));
    find.source("Kolmogorov-Smirnov, 1.63 / sqrt(N), 1 % level");
    find.at_most("distance from the exponential distribution, times sqrt(N)", "", 1.63,
                 distance_from_exponential(samples) * std::sqrt(n));
    Curve law{"exponential", {{0, 0}, {6, -6 * std::log10(std::exp(1.0))}}, false};
    find.plot("speckle", {"Power of speckle re its mean",
                          "I / mean(I)",
                          "log10 of the density",
                          {law, histogram(samples)},
                          -3.5,
                          0.5});
}

void check_correlation(Findings& find, const std::vector<double>& all) {
    find.source("a rectangular pulse correlates with itself over its length");
    find.within("correlation length in range", "pulse lengths", 1, 0.15, correlation_length(all));
    find.source("independent cells", Kind::property);
    find.at_most("correlation of bins two pulses apart", "", 0.05,
                 std::abs(range_correlation(all, 2 * bins_per_pulse)));
    double apart = 0;
    for (std::size_t beam = 0; beam + 2 < speckle_beams; ++beam)
        apart +=
            correlation(beam_of(all, beam), beam_of(all, beam + 2)) / static_cast<double>(speckle_beams - 2);
    find.at_most("correlation of beams two widths apart, mean", "", 0.05, std::abs(apart));
    double mirrored = 0;
    for (std::size_t beam = 0; beam < speckle_beams / 2; ++beam)
        mirrored +=
            correlation(beam_of(all, beam), beam_of(all, speckle_beams - 1 - beam)) / (speckle_beams / 2.0);
    find.at_most("correlation of port with starboard", "", 0.05, std::abs(mirrored));
}

double likeness(const std::vector<double>& a, const std::vector<double>& b) {
    return correlation(independent(a), independent(b));
}

}  // namespace

void check_speckle(Findings& find) {
    const auto still = speckled({});
    check_distribution(find, still);
    check_correlation(find, still);
    find.source("the same view is the same interference", Kind::property);
    find.within("correlation of two pings of a static sonar", "", 1, 1e-6,
                likeness(still, speckled({}, {}, 1)));
    find.source("K distribution, 1 + 2 / nu (Jakeman 1980)");
    const Moments few = moments(independent(speckled({}, {4})));
    find.within("scintillation, nu = 4", "", 1.5, 0.2, few.variance / (few.mean * few.mean));
}

}  // namespace echoloop::validation
