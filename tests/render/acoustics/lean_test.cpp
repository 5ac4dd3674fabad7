// Speckle of beams that overlap: the same where they hear the same scatterers.
#include "render/acoustics/lean.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "render/acoustics/lean_kernels.h"
#include "render/acoustics/random.h"
#include "render/acoustics/scatterer_view.h"
#include "tests/render/acoustics/chain_shots.h"
#include "tests/render/acoustics/statistics.h"

namespace echoloop {
namespace {

using test::chain_shot;

constexpr double pulse = 0.075;  // m
const Effects speckled = test::only({Effect::pulse, Effect::speckle});

/// BeamKernel's weights of cells 0, 1, ... as they are written down, their squares' sum made 1.
double heard_at(const std::vector<std::vector<float>>& fields, std::size_t bin, double place, int first,
                double reach, double middle) {
    double sum = 0, energy = 0;
    for (std::size_t k = 0; k < fields.size(); ++k) {
        const double weight = BeamKernel{reach, middle}.weight(place - (first + static_cast<int>(k)));
        sum += weight * double{fields[k][bin]}, energy += weight * weight;
    }
    return sum / std::sqrt(energy);
}

TEST(LeanKernels, HearEachBinAtItsPlaceHoweverManyThereAre) {
    constexpr int first = -5;
    constexpr std::size_t cells = 11, most = 130;
    constexpr double reach = 1.6, middle = -2;
    std::vector<std::vector<float>> fields(cells, std::vector<float>(most));
    std::array<const float*, cells> of{};
    for (std::size_t k = 0; k < cells; ++k) {
        for (std::size_t i = 0; i < most; ++i)
            fields[k][i] = static_cast<float>(static_cast<double>(mix(k, i) >> 11U) * 0x1p-53 - 0.5);
        of[k] = fields[k].data();
    }
    std::vector<float> places(most);  // all over the cells, and then all in one
    for (std::size_t i = 0; i < most; ++i)
        places[i] = i < 70 ? static_cast<float>(-3 + 0.006 * static_cast<double>(mix(9, i) % 1000)) : 1.25F;
    const BeamKernel kernel{reach, middle};
    for (const std::size_t count : {1U, 31U, 32U, 33U, 64U, 110U, 128U}) {
        std::vector<float> energies(count), out(most, -9);
        kernels::hear_cells({of.data(), cells, first, kernel.cells(), 1 / static_cast<float>(reach * reach),
                             static_cast<float>(middle)},
                            places.data(), count, energies.data(), out.data());
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_NEAR(out[i], heard_at(fields, i, double{places[i]}, first, reach, middle), 2e-6)
                << "bin " << i << " of " << count;
        EXPECT_EQ(out[count], -9) << "beyond the last of " << count;
    }
}

TEST(LeanKernels, TellRatiosOfPowers) {
    std::vector<float> a, b, out;
    for (const float ratio : {1e-8F, 0.3F, 0.7071F, 0.99F, 1.0F, 1.01F, 1.4143F, 5.0F, 3e9F})
        a.push_back(7 * ratio), b.push_back(7), out.push_back(1);
    kernels::add_log_ratio(2, a.data(), b.data(), a.size(), out.data());
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(out[i], 1 + 2 * std::log(double{a[i]} / double{b[i]}), 2.1e-4) << a[i] / b[i];
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> far{-9, 9, 0.5F, nan};
    kernels::limit(2, far.size(), far.data());
    EXPECT_EQ(far, (std::vector<float>{-2, 2, 0.5F, -2}));
}

/// Beams a third of their width apart.
Shot overlapping(std::size_t beams, std::size_t bins, double bin) {
    Shot shot = chain_shot(beams, bins, bin, pulse);
    shot.receiver.bins = BinRule::sample;
    for (double& bearing : shot.bearings) bearing /= 3;
    return shot;
}

/// Mean power where each bin's echo comes from one direction (rad) alone, as on a floor seen obliquely.
std::vector<float> from_one_direction(const Shot& shot, const std::function<double(std::size_t)>& direction) {
    std::vector<float> means(shot.bearings.size() * shot.bins);
    for (std::size_t beam = 0; beam < shot.bearings.size(); ++beam)
        for (std::size_t bin = 0; bin < shot.bins; ++bin) {
            const double off = (shot.bearings[beam] - direction(bin)) / shot.beam_width;
            means[beam * shot.bins + bin] = static_cast<float>(std::exp(-4 * std::log(2.0) * off * off));
        }
    return means;
}

std::vector<float> heard(const Shot& shot, std::vector<float> means, SpeckleOptions options = {}) {
    AcousticChain(speckled, options).apply(shot, {}, test::water_speed, {}, means);
    return means;
}

/// Of every `step`th bin of a beam, power over the mean echo that the chain without speckle gives.
std::vector<float> speckle_of(const Shot& shot, const std::vector<float>& means, std::size_t beam,
                              std::size_t step) {
    auto plain = means;
    AcousticChain(test::only({Effect::pulse})).apply(shot, {}, test::water_speed, {}, plain);
    const auto values = heard(shot, means);
    std::vector<float> out;
    for (std::size_t bin = 60; bin < shot.bins; bin += step)
        out.push_back(values[beam * shot.bins + bin] / plain[beam * shot.bins + bin]);
    return out;
}

struct Bins {
    double length;     ///< m
    std::size_t step;  ///< from one independent value to the next
};

TEST(Lean, BeamsThatHearTheSameScatterersHaveTheSameSpeckle) {
    for (const auto [length, step] : {Bins{0.02, 8}, Bins{0.1, 1}, Bins{0.4, 1}}) {
        const Shot shot = overlapping(31, 4000, length);
        const auto one =
            from_one_direction(shot, [](std::size_t bin) { return 1e-6 * static_cast<double>(bin); });
        const std::vector<float> even(one.size(), 1.0F);
        const auto beam = [&, step = step](const std::vector<float>& means, std::size_t n) {
            return speckle_of(shot, means, n, step);
        };
        for (const std::size_t n : {13U, 14U, 16U, 18U})
            EXPECT_GT(correlation(beam(one, 15), beam(one, n)), 0.97) << n << ", bins of " << length;
        EXPECT_NEAR(correlation(beam(even, 15), beam(even, 18)), 0.2, 0.1)
            << "a width apart on an even floor";
    }
}

TEST(Lean, TheOutermostBeamsToo) {
    const Shot shot = overlapping(31, 4000, 0.1);
    for (const std::size_t edge : {0U, 30U}) {
        const auto one = from_one_direction(shot, [&](std::size_t) { return 1.01 * shot.bearings[edge]; });
        const std::size_t inside = edge == 0 ? 2 : 28;
        EXPECT_GT(correlation(speckle_of(shot, one, edge, 1), speckle_of(shot, one, inside, 1)), 0.97)
            << edge;
    }
}

TEST(Lean, AnEchoOfTwoDirectionsLiesBetween) {
    // As wide as a beam: each beam hears scatterers that the next but two does not, but some that it does.
    const Shot shot = overlapping(31, 8000, 0.1);
    std::vector<float> means(31 * 8000);
    for (std::size_t beam = 0; beam < 31; ++beam)
        for (std::size_t bin = 0; bin < 8000; ++bin) {
            const double off = shot.bearings[beam] / shot.beam_width;
            means[beam * 8000 + bin] = static_cast<float>(std::exp(-2 * std::log(2.0) * off * off));
        }
    const double like = correlation(speckle_of(shot, means, 14, 1), speckle_of(shot, means, 16, 1));
    EXPECT_GT(like, 0.2);
    EXPECT_LT(like, 0.9);
}

// V8 holds whichever direction the echo comes from, while that wanders from cell to cell.
TEST(Lean, SpeckleStaysFullyDeveloped) {
    const auto around = [](const Shot& shot, std::size_t beam, double pace) {
        return from_one_direction(shot, [=, &shot](std::size_t bin) {
            return shot.bearings[beam] + shot.beam_width * std::sin(pace * static_cast<double>(bin));
        });
    };
    const Shot coarse = overlapping(31, 30'000, 0.1);
    for (const std::size_t beam : {0U, 20U}) {
        const auto s = intensity_statistics(speckle_of(coarse, around(coarse, beam, 1e-3), beam, 1));
        EXPECT_NEAR(s.mean, 1, 0.03) << beam;
        EXPECT_NEAR(s.scintillation, 1, 0.06) << beam;
    }
    const Shot fine = overlapping(31, 60'000, 0.02);
    const auto s = intensity_statistics(speckle_of(fine, around(fine, 15, 1e-4), 15, 8));
    EXPECT_NEAR(s.mean, 1, 0.04);
    EXPECT_NEAR(s.scintillation, 1, 0.08);
    EXPECT_NEAR(s.db_deviation, 5.57, 0.15);
    EXPECT_LT(s.kolmogorov, s.kolmogorov_limit);
}

TEST(Lean, DoesNotDependOnThreads) {
    const Shot many = overlapping(120, 500, 0.03);  // as many as are worth a second thread
    Shot few = many;
    few.bearings.resize(30);
    const auto sweep = [](std::size_t bin) { return 1e-3 * static_cast<double>(bin) - 0.3; };
    const auto all = heard(many, from_one_direction(many, sweep)),
               part = heard(few, from_one_direction(few, sweep));
    EXPECT_EQ(all, heard(many, from_one_direction(many, sweep)));
    EXPECT_TRUE(std::equal(part.begin(), part.end() - 500, all.begin()))
        << "but for the last, which lacks a neighbour";
}

TEST(Lean, IsNoneWhereBeamsAreFewOrFarApart) {
    const auto apart = [](std::size_t beams, double widths) {
        Shot shot = chain_shot(beams, 10, 0.1, pulse);
        for (double& bearing : shot.bearings) bearing *= widths;
        return Lean(shot, 0.01).any();
    };
    EXPECT_TRUE(apart(3, 0.9));
    EXPECT_FALSE(apart(2, 0.9));
    EXPECT_FALSE(apart(3, 1.0));
}

TEST(Lean, FindsTheDirectionUpToAWidthAndAHalf) {
    const Shot shot = overlapping(61, 16, 0.1);
    const double cell = shot.beam_width / 2;
    for (const double widths : {-3.0, -1.4, -0.3, 0.3, 1.0, 3.0}) {
        const auto one = from_one_direction(
            shot, [&](std::size_t) { return shot.bearings[30] + widths * shot.beam_width; });
        std::vector<float> cells(16);
        Lean::Means means;
        for (std::size_t beam = 29; beam <= 31; ++beam)
            means.of(beam).assign(&one[beam * shot.bins], &one[(beam + 1) * shot.bins]);
        const Lean lean(shot, cell);
        lean.find(30, means, 0, cells);
        for (const float at : cells) EXPECT_NEAR(at, std::clamp(2 * widths, -3.0, 3.0), 0.01);
        std::vector<Lean::Stretch> stretches;
        lean.cut(30, means, 0, 16, 128, stretches);
        ASSERT_EQ(stretches.size(), 1);
        EXPECT_TRUE(stretches[0].leans);
        lean.cut(30, means, 2, 16, 128, stretches);
        ASSERT_EQ(stretches.size(), 1);
        EXPECT_FALSE(stretches[0].leans) << "all of it below what is heard";
    }
}

TEST(Lean, CutsABeamIntoStretchesThatLeanAndThoseBetweenThem) {
    constexpr std::size_t bins = 4310, most = 128;
    const Shot shot = overlapping(3, bins, 0.1);
    Lean::Means means;
    for (std::size_t beam = 0; beam < 3; ++beam) means.of(beam).assign(bins, 1.0F);
    const auto leans = [](std::size_t bin) {
        return bin == 70 || (200 <= bin && bin < 500) || (4090 <= bin && bin < 4100) || bin == bins - 1;
    };
    for (std::size_t bin = 0; bin < bins; ++bin)
        if (leans(bin)) means.of(bin % 2 == 0 ? 0 : 2)[bin] = 9;  // to the left and to the right
    std::vector<Lean::Stretch> stretches;
    Lean(shot, shot.beam_width / 2).cut(1, means, 0, bins, most, stretches);
    std::size_t next = 0;
    for (const auto& [first, count, leaning] : stretches) {
        ASSERT_EQ(first, next) << "one behind the other";
        next += count;
        std::size_t own = 0;
        for (std::size_t bin = first; bin < next; ++bin) own += leans(bin) ? 1 : 0;
        EXPECT_EQ(leaning, own > 0) << "bins " << first << " to " << next;
        EXPECT_TRUE(!leaning || count <= most) << "bins " << first << " to " << next;
    }
    EXPECT_EQ(next, bins);
    EXPECT_EQ(stretches.size(), 10);  // four parts lean, of which one is cut into three
}

}  // namespace
}  // namespace echoloop
