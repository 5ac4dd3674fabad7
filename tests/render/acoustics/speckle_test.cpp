#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "render/acoustics/pattern.h"
#include "tests/render/acoustics/chain_shots.h"
#include "tests/render/acoustics/statistics.h"

namespace echoloop {
namespace {

using test::chain_shot;
using test::only;
using test::output;

const Effects speckled = only({Effect::pulse, Effect::speckle});
constexpr double wavelength = 0.002;  ///< m, 750 kHz

/// A shot of which each bin is one look.
Shot sampled(std::size_t beams, std::size_t bins, double bin, double pulse) {
    Shot shot = chain_shot(beams, bins, bin, pulse);
    shot.receiver.bins = BinRule::sample;
    return shot;
}

constexpr std::size_t whole_pulse = 100;  ///< bins from which on the longest one here is heard whole

/// Every `step`th bin of every `beam_step`th beam, where all of the pulse is heard.
std::vector<float> thinned(const std::vector<float>& values, const Shot& shot, std::size_t step,
                           std::size_t beam_step = 2) {
    std::vector<float> out;
    for (std::size_t beam = 0; beam < shot.bearings.size(); beam += beam_step)
        for (std::size_t bin = whole_pulse; bin < shot.bins; bin += step)
            out.push_back(values[beam * shot.bins + bin]);
    return out;
}

void expect_fully_developed(const IntensityStatistics& s) {
    EXPECT_NEAR(s.amplitude_cv, 0.5227, 0.01);
    EXPECT_NEAR(s.scintillation, 1, 0.04);
    EXPECT_NEAR(s.skewness, 2, 0.15);
    EXPECT_NEAR(s.db_deviation, 5.57, 0.1);
    EXPECT_NEAR(s.db_offset, -2.51, 0.05);
    EXPECT_LT(s.kolmogorov, s.kolmogorov_limit);
}

// V8, in bins of the pulse, of a quarter of it, and far shorter than it.
TEST(Speckle, FullyDeveloped) {
    for (const double bin : {0.075, 0.01875, 0.0009}) {
        const Shot shot = sampled(120, 4000, bin, 0.075);
        const auto apart = static_cast<std::size_t>(std::ceil(0.15 / bin));
        std::vector<float> values;
        for (int place = 0; values.size() < 60'000; ++place) {
            const auto more =
                thinned(output(speckled, shot, 1, {{7.3 * place, -4.1 * place, 0}, {}}), shot, apart);
            values.insert(values.end(), more.begin(), more.end());
        }
        const IntensityStatistics s = intensity_statistics(values);
        SCOPED_TRACE("bins of " + std::to_string(bin) + " m");
        EXPECT_NEAR(s.mean, 0.075 / bin, 0.03 * 0.075 / bin);
        expect_fully_developed(s);
    }
}

TEST(Speckle, WithoutAPulseEveryBinIsOneLook) {
    const Shot shot = chain_shot(60, 2000, 0.3, 0.075);
    expect_fully_developed(intensity_statistics(thinned(output(only({Effect::speckle}), shot), shot, 1)));
}

// V32: Goodman 2007, looks in a mean over T of a rectangular pulse tau.
TEST(Speckle, BinsAverageLooks) {
    const std::pair<double, double> looks[] = {{0.25, 1.19}, {0.5, 1.41}, {1, 2.00},
                                               {2, 3.43},    {4, 6.40},   {8, 12.4}};
    for (const auto& [length, n] : looks) {
        const Shot shot = chain_shot(120, 4000, 0.075 * length, 0.075);
        const IntensityStatistics s = intensity_statistics(thinned(output(speckled, shot), shot, 1));
        EXPECT_NEAR(s.mean * length, 1, 0.01);
        EXPECT_NEAR(1 / s.scintillation / n, 1, 0.05) << length << " pulses";
    }
}

// V31: mean and peak of n looks; standard deviation in dB, coefficient of variation, level.
TEST(Speckle, LooksOfMeanAndPeak) {
    struct Row {
        double pulses;  ///< that have so many looks
        double mean_db, mean_cv, peak_db, peak_cv, peak_level;
    };
    for (const Row& row : {Row{1.0, 3.49, 0.363, 3.59, 0.377, 1.76},
                           {2.376, 2.31, 0.254, 2.55, 0.284, 3.19},
                           {5.055, 1.58, 0.178, 1.94, 0.223, 4.34}}) {
        Shot shot = chain_shot(120, 4000, 0.075 * row.pulses, 0.075);
        const auto mean = intensity_statistics(thinned(output(speckled, shot), shot, 1));
        EXPECT_NEAR(mean.db_deviation / row.mean_db, 1, 0.05) << row.pulses;
        EXPECT_NEAR(mean.amplitude_cv / row.mean_cv, 1, 0.05) << row.pulses;
        shot.receiver.bins = BinRule::peak;
        const auto peak = intensity_statistics(thinned(output(speckled, shot), shot, 1));
        EXPECT_NEAR(peak.db_deviation / row.peak_db, 1, 0.05) << row.pulses;
        EXPECT_NEAR(peak.amplitude_cv / row.peak_cv, 1, 0.05) << row.pulses;
        EXPECT_NEAR(test::to_db(peak.mean / mean.mean), row.peak_level, 0.1) << row.pulses;
    }
}

// V32: (1 - x / d)^2 of the intensity over range.
TEST(Speckle, CorrelatesOverThePulse) {
    const Shot shot = sampled(200, 2000, 0.01, 0.08);
    const auto values = output(speckled, shot);
    const auto correlation_at = [&](std::size_t lag) {
        std::vector<float> a, b;
        for (std::size_t beam = 0; beam < 200; ++beam)
            for (std::size_t bin = 60; bin + lag < 2000; ++bin) {
                a.push_back(values[beam * 2000 + bin]);
                b.push_back(values[beam * 2000 + bin + lag]);
            }
        return correlation(a, b);
    };
    EXPECT_NEAR(correlation_at(2), 0.56, 0.03);
    EXPECT_NEAR(correlation_at(4), 0.25, 0.03);
    EXPECT_NEAR(correlation_at(6), 0.06, 0.03);
    EXPECT_NEAR(correlation_at(10), 0, 0.03);
}

TEST(Speckle, SameViewSameBytes) {
    Shot shot = chain_shot(20, 500, 0.02, 0.075);
    const Pose pose{{1, 2, -3}, from_rpy(0.1, 0.2, 0.3)};
    const auto first = output(speckled, shot, 1, pose);
    shot.ping = 99;
    EXPECT_EQ(output(speckled, shot, 1, pose), first);
    shot.random_key = 8;
    EXPECT_LT(std::abs(correlation(output(speckled, shot, 1, pose), first)), 0.05);
}

/// Beams two widths apart that look to port and to starboard of the x axis by 10 deg at most; wide pulses, so
/// that motion along the beams changes nothing.
struct Moving {
    explicit Moving(AxisPattern pattern) : shot(sampled(11, 1500, 0.4, 0.4)) {
        shot.horizontal = pattern;
        aperture = TwoWayPattern(pattern, shot.beam_width).aperture().length_in_wavelengths() * wavelength;
    }
    std::vector<float> at(const Pose& pose) const { return output(speckled, shot, 1, pose); }
    /// Correlation after a way in the sonar's frame, the mean over some begins and headings of it.
    double after(Vec3 way) const {
        double sum = 0;
        constexpr int begins = 24;
        for (int i = 0; i < begins; ++i) {
            const Vec3 begin{3.1 * i, -2.3 * i, 0.7 * i};
            const Quat heading = from_rpy(0, 0, 0.9 * i);
            sum += correlation(at({begin, heading}), at({begin + rotate(heading, way), heading})) / begins;
        }
        return sum;
    }
    Shot shot;
    double aperture;  ///< m
};

// V30: a tenth and a quarter of the aperture across the line of sight.
TEST(Speckle, DecorrelatesOverHalfAnAperture) {
    struct Case {
        AxisPattern pattern;
        double tenth, quarter;
    };
    for (const Case& c : {Case{{ApertureShape::line, 1}, 0.643, 0.251},
                          {{ApertureShape::line, 2}, 0.895, 0.517},
                          {{ApertureShape::hamming, 1}, 0.643, 0.055}}) {
        const Moving sonar(c.pattern);
        EXPECT_NEAR(sonar.after({0, 0.1 * sonar.aperture, 0}), c.tenth, 0.05);
        EXPECT_NEAR(sonar.after({0, 0.25 * sonar.aperture, 0}), c.quarter, 0.05);
        EXPECT_NEAR(sonar.after({0, 2 * sonar.aperture, 0}), 0, 0.02);
        EXPECT_NEAR(sonar.after({0, 0, 2 * sonar.aperture}), 0, 0.02);
        EXPECT_GT(sonar.after({0, 1e-4, 0}), 0.97) << "no step of 0.1 mm leaves less";
        EXPECT_GT(sonar.after({0, 0, 1e-4}), 0.97);
        EXPECT_GT(sonar.after({1e-4, 0, 0}), 0.97);
    }
}

// V30: a fixed bin keeps (1 - x / d)^2; lambda / 4 at 750 kHz, 25 us; the envelope itself moves by x.
TEST(Speckle, MovesAlongTheLineOfSight) {
    const double pulse = 25e-6 * test::water_speed / 2, x = wavelength / 4;
    Shot shot = sampled(1, 60'000, x, pulse);
    const auto before = output(speckled, shot, 1, {{7, 0, 0}, {}});
    const auto after = output(speckled, shot, 1, {{7 + x, 0, 0}, {}});
    EXPECT_NEAR(correlation(before, after), 0.947, 0.05);
    const std::span<const float> all(before), moved(after);
    EXPECT_GT(correlation(all.subspan(101, 50'000), moved.subspan(100, 50'000)), 0.95)
        << "what was x farther off";
    const auto between = output(speckled, shot, 1, {{7 + 1.5 * x, 0, 0}, {}});
    EXPECT_NEAR(test::sum_of(between) / test::sum_of(before), 1, 0.02) << "between two bins, too";
    const auto twice = output(speckled, shot, 1, {{7 + 10 * x, 0, 0}, {}});
    EXPECT_NEAR(correlation(before, twice), std::pow(1 - 10 * x / pulse, 2), 0.05);
    EXPECT_GT(correlation(all.subspan(110, 50'000), std::span(twice).subspan(100, 50'000)), 0.95);
}

// No step of 0.1 mm, and none of a twentieth of a width, leaves another picture, wherever it begins.
TEST(Speckle, HasNoCellsToFlickerOn) {
    Shot shot = sampled(16, 400, 0.05, 0.075);
    shot.horizontal = {ApertureShape::hamming, 1};
    for (const Quat& mounted :
         {Quat{}, from_rpy(std::numbers::pi, 0, 0), from_rpy(0, std::numbers::pi / 2, 0)}) {
        double least = 1;
        auto before = output(speckled, shot, 1, {{-2e-3, 0, 0}, mounted});
        for (int i = 1; i < 80; ++i) {
            const double way = 1e-4 * i;
            const Pose pose{{-2e-3 + way, way / 2, -way / 3},
                            mounted * from_rpy(2e-5 * i, 1e-5 * i, 4e-5 * i)};
            auto after = output(speckled, shot, 1, pose);
            least = std::min(least, correlation(before, after));
            before = std::move(after);
        }
        EXPECT_GT(least, 0.96);
    }
}

// Beams two widths apart against each other, bins against each other, port against starboard.
TEST(Speckle, CellsAreIndependent) {
    for (const double bin : {0.02, 0.15}) {
        const Shot shot = chain_shot(64, 4000, bin, 0.075);
        const auto values = output(speckled, shot);
        const auto beam = [&](std::size_t i) {
            return thinned({&values[i * 4000], &values[i * 4000] + 4000}, chain_shot(1, 4000, bin, 0.075),
                           bin < 0.1 ? 8 : 1);
        };
        const double limit = bin < 0.1 ? 0.16 : 0.06;  // 3.6 standard errors of one pair
        double pairs = 0, mirrored = 0;
        for (std::size_t i = 0; i < 30; ++i) {
            EXPECT_LT(std::abs(correlation(beam(i), beam(i + 2))), limit)
                << "beams " << i << " and the next but one";
            EXPECT_LT(std::abs(correlation(beam(i), beam(63 - i))), limit) << "port and starboard of " << i;
            pairs += correlation(beam(i), beam(i + 2)) / 30,
                mirrored += correlation(beam(i), beam(63 - i)) / 30;
        }
        EXPECT_NEAR(pairs, 0, 0.05);
        EXPECT_NEAR(mirrored, 0, 0.05);
    }
}

// A head that steps by less than its beam: neighbours look alike, directions two widths apart do not.
TEST(Speckle, OfAScanningHeadFollowsTheBearing) {
    for (const double bin : {0.02, 0.1}) {
        Shot shot = chain_shot(1, 4000, bin, 0.075);
        const auto at = [&](double pan_deg, double yaw_deg) {
            shot.pan = deg_to_rad(pan_deg);
            return output(speckled, shot, 1, {{}, from_rpy(0, 0, deg_to_rad(yaw_deg))});
        };
        const auto centre = at(40, 0);
        EXPECT_GT(correlation(at(40.1, 0), centre), 0.9) << bin;
        EXPECT_LT(std::abs(correlation(at(42.01, 0), centre)), 0.15) << bin;
        EXPECT_GT(correlation(at(40, -0.1), centre), 0.9) << "yaw to starboard adds to the bearing";
        EXPECT_GT(correlation(at(30, -10), centre), 0.99);
        for (const double pan : {40.0, 40.1, 40.25, 40.37}) {
            const auto values = at(pan, 0);
            EXPECT_NEAR(test::sum_of(values) / 4000 * bin / 0.075, 1, 0.12) << pan;
        }
    }
}

TEST(Speckle, OfAHangingHeadFollowsTheBearing) {
    Shot shot = chain_shot(1, 2000, 0.1, 0.075);
    const auto at = [&](double pan_deg, double yaw_deg) {
        shot.pan = deg_to_rad(pan_deg);
        return output(speckled, shot, 1, {{}, from_rpy(std::numbers::pi, 0, deg_to_rad(yaw_deg))});
    };
    EXPECT_GT(correlation(at(30, 10), at(40, 0)), 0.99);
    EXPECT_LT(std::abs(correlation(at(30, -10), at(40, 0))), 0.1);
}

// A fan that looks down: a roll moves its beams over the bottom.
TEST(Speckle, OfAFanThatLooksDownFollowsTheRoll) {
    Shot shot = chain_shot(21, 4000, 0.1, 0.075);
    const Quat down = from_rpy(0, std::numbers::pi / 2, 0);
    const auto rolled = [&](double deg) {
        return output(speckled, shot, 1, {{}, down * from_rpy(0, 0, deg_to_rad(deg))});
    };
    const auto before = rolled(0), after = rolled(1);  // one beam further to port
    const std::span<const float> all(before), moved(after);
    EXPECT_GT(std::max(correlation(all.first(80'000), moved.last(80'000)),
                       correlation(all.last(80'000), moved.first(80'000))),
              0.95);
}

/// Mean correlation of beams `step` apart.
double between_beams(const std::vector<float>& values, const Shot& shot, std::size_t step) {
    double sum = 0;
    const std::size_t pairs = shot.bearings.size() - step;
    for (std::size_t i = 0; i < pairs; ++i)
        sum += correlation(std::span(values).subspan(i * shot.bins, shot.bins),
                           std::span(values).subspan((i + step) * shot.bins, shot.bins)) /
               static_cast<double>(pairs);
    return sum;
}

// V27: intensities of beams that share staves, |r|^2, at 0.25, 0.5, 0.75, 1 and 1.5 widths; of noise and of
// speckle, in bins of one look and of several.
TEST(Speckle, BeamsThatShareStavesCorrelate) {
    struct Case {
        AxisPattern pattern;
        double expected[5];
        double tolerance;
    };
    for (const Case& c : {Case{{ApertureShape::line, 1}, {0.849, 0.501, 0.175, 0.016, 0.042}, 0.05},
                          {{ApertureShape::hamming, 1}, {0.907, 0.675, 0.410, 0.200, 0.022}, 0.03}})
        for (const double bin : {0.0751, 0.3}) {
            Shot shot = chain_shot(96, 4000, bin, 0.075);
            if (bin < 0.1) shot.receiver.bins = BinRule::sample;
            shot.horizontal = c.pattern;
            for (double& bearing : shot.bearings) bearing *= 0.25;
            const auto speckle = output(speckled, shot);
            const auto noise = output(only({Effect::pulse, Effect::noise}), shot, 0);
            const std::size_t steps[] = {1, 2, 3, 4, 6};
            for (std::size_t i = 0; i < 5; ++i) {
                EXPECT_NEAR(between_beams(speckle, shot, steps[i]), c.expected[i], c.tolerance)
                    << steps[i] << " quarters, bins of " << bin;
                EXPECT_NEAR(between_beams(noise, shot, steps[i]), c.expected[i], c.tolerance)
                    << "noise, " << steps[i] << " quarters, bins of " << bin;
            }
        }
}

// V27: a head both ways by one plain line, by step over its one-way width.
TEST(Speckle, StepsOfAHeadCorrelate) {
    Shot shot = sampled(1, 4000, 0.1, 0.075);
    shot.horizontal = {ApertureShape::line, 2};
    const double one_way = shot.beam_width * 0.886 / 0.638;
    const std::pair<double, double> steps[] = {{0.15, 0.933}, {0.3, 0.756}, {0.6, 0.324}, {1, 0.047}};
    for (const auto& [step, expected] : steps) {
        double sum = 0;
        for (int i = 0; i < 40; ++i) {
            shot.pan = 0.1 * i;
            const auto before = output(speckled, shot);
            shot.pan += step * one_way;
            sum += correlation(before, output(speckled, shot)) / 40;
        }
        EXPECT_NEAR(sum, expected, 0.03) << step;
    }
}

TEST(Speckle, KDistribution) {
    for (const double shape : {0.5, 2.0, 10.0}) {
        const Shot shot = sampled(200, 4000, 0.075, 0.075);
        const auto s = intensity_statistics(output(speckled, shot, 1, {}, {shape}));
        EXPECT_NEAR(s.mean, 1, 0.02);
        EXPECT_NEAR(s.scintillation, 1 + 2 / shape, 0.06 * (1 + 2 / shape)) << "nu " << shape;
    }
}

// Rician: the point's power adds to the mean, and its interference to the variance.
TEST(Speckle, APointInterferesWithTheBottom) {
    for (const double bin : {0.02, 0.3}) {
        Shot shot = chain_shot(1, 40, bin, 0.075);
        if (bin < 0.1) shot.receiver.bins = BinRule::sample;
        const double looks = bin > 0.1 ? 6.40 : 1, height = 0.075 / bin;
        AcousticChain chain(speckled);
        std::vector<float> seen;
        for (int i = 0; i < 20'000; ++i) {
            std::vector<float> values(40, 1.0F);
            const PointEcho point{0, 20.2 * bin, 9 * (looks > 1 ? 1 : height), 1.2 + i};
            chain.apply(shot, {{1.01 * i, 0.77 * i, 0}, {}}, test::water_speed, {&point, 1}, values);
            seen.push_back(values[looks > 1 ? 20 : 22]);
        }
        const double diffuse = height, echo = 9 * height;
        const auto s = intensity_statistics(seen);
        EXPECT_NEAR(s.mean, diffuse + echo, 0.06 * (diffuse + echo)) << bin;
        const double variance = (diffuse * diffuse + 2 * diffuse * echo) / looks;
        EXPECT_NEAR(s.scintillation * s.mean * s.mean, variance, 0.12 * variance) << bin;
    }
}

// A point in a bin that keeps its peak reads as high as in a bin that it fills.
TEST(Speckle, AShortEchoKeepsItsPeak) {
    Shot shot = chain_shot(1, 40, 0.3, 0.075);
    const std::vector<PointEcho> point{{0, 6.1, 8, 0}};
    EXPECT_NEAR(output(only({Effect::pulse}), shot, point)[20], 2, 0.1);
    shot.receiver.bins = BinRule::peak;
    EXPECT_NEAR(output(only({Effect::pulse}), shot, point)[20], 8, 0.1);
}

}  // namespace
}  // namespace echoloop
