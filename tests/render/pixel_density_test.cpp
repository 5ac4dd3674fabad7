// V16: the number of pixels and the fineness of a mesh are bookkeeping; levels do not depend on them.
#include <gtest/gtest.h>

#include <numeric>

#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::scene_of;

struct MeanEchogram {
    std::size_t beams, bins;
    std::vector<double> values;
    double at(std::size_t beam, std::size_t bin) const { return values[beam * bins + bin]; }
};

/// Everything that shapes mean levels; what fluctuates is left out, and what has its own rays.
Effects means() {
    Effects effects;
    for (const Effect effect : {Effect::speckle, Effect::noise, Effect::multipath, Effect::saturation})
        effects.set(effect, false);
    return effects;
}

Shot array() {
    Shot shot = test::forward_looking();
    shot.pulse_length = 133e-6;  // a bin
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.vertical = {ApertureShape::line, 1};
    return shot;
}

MeanEchogram mean_of(const std::shared_ptr<const Scene>& scene, double pixel_density, std::uint64_t pings) {
    Renderer renderer(scene, test::water_of(1500), {.pixel_density = pixel_density, .effects = means()});
    Shot shot = array();
    MeanEchogram mean{shot.bearings.size(), shot.bins, std::vector<double>(shot.bearings.size() * shot.bins)};
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        const Echogram e = renderer.render(shot, {});
        for (std::size_t i = 0; i < e.values.size(); ++i)
            mean.values[i] += e.values[i] / static_cast<double>(pings);
    }
    return mean;
}

struct Comparison {
    std::size_t compared = 0, different = 0;
    double largest = 0;  ///< dB
};

/// Bins whose levels differ by more than 0.2 dB, from `first` on, as heard in thermal noise: 42.5 dB re 1 uPa^2/Hz, a
/// band of 7.5 kHz, a directivity index of 30 dB. Bins more than `below_loudest` dB below the loudest are left out.
Comparison compare(const MeanEchogram& coarse, const MeanEchogram& fine, std::size_t first, std::size_t end = 500,
                   double below_loudest = 1e9) {
    const double noise = std::pow(10, (42.5 + 10 * std::log10(7500) - 30) / 10);
    const double least = *std::ranges::max_element(fine.values) * std::pow(10, -below_loudest / 10);
    Comparison out;
    for (std::size_t beam = 0; beam < fine.beams; ++beam)
        for (std::size_t bin = first; bin < end; ++bin) {
            if (fine.at(beam, bin) < least) continue;
            if (fine.at(beam, bin) == 0 && coarse.at(beam, bin) == 0) continue;
            const double difference =
                std::abs(test::db((coarse.at(beam, bin) + noise) / (fine.at(beam, bin) + noise)));
            ++out.compared;
            out.different += !(difference <= 0.2);
            out.largest = std::max(out.largest, difference);
        }
    return out;
}

double total(const MeanEchogram& e) { return std::accumulate(e.values.begin(), e.values.end(), 0.0); }

constexpr std::size_t main_lobe = 125;  ///< the first bin in which a floor 5 m below is seen by the level views alone

TEST(PixelDensity, DoublingChangesNoBinOfAFloorInTheMainLobe) {
    const auto scene = scene_of({test::floor_at(-5, 200)});
    const Comparison c = compare(mean_of(scene, 1, 1), mean_of(scene, 2, 1), main_lobe, 490);
    EXPECT_GT(c.compared, 90'000U);
    EXPECT_EQ(c.different, 0U) << "of " << c.compared << ", by up to " << c.largest << " dB";
}

// Outlines and the ends of shadows lie within a pixel of where they are; the nulls between vertical side lobes, which
// the surround shows in coarse pixels, are filled by their size. All else keeps its level.
TEST(PixelDensity, DoublingChangesOnlyOutlinesAndNulls) {
    const auto scene = scene_of({test::floor_at(-5, 200), test::box("box", {15, 2, -4}, {3, 4, 2}, 0.4),
                                 test::wall_at(35, 40, -5, 5)});
    const MeanEchogram coarse = mean_of(scene, 1, 32), fine = mean_of(scene, 2, 32);
    const Comparison seen = compare(coarse, fine, main_lobe), all = compare(coarse, fine, 0);
    const Comparison loud = compare(coarse, fine, main_lobe, 500, 30);
    EXPECT_LT(seen.different, seen.compared / 20) << "by up to " << seen.largest << " dB";
    EXPECT_LT(loud.different, loud.compared / 200) << "by up to " << loud.largest << " dB";
    EXPECT_LT(all.different, all.compared / 10) << "by up to " << all.largest << " dB";
    EXPECT_NEAR(test::db(total(coarse) / total(fine)), 0, 0.01);
}

// Each beam hears the same from a box, however many pixels show it.
TEST(PixelDensity, DoublingChangesNoBeam) {
    const auto scene =
        scene_of({test::box("box", {15, 2, -4}, {3, 4, 2}, 0.4), test::sphere({12, -4, -4}, 0.6, 32)});
    const MeanEchogram coarse = mean_of(scene, 1, 64), fine = mean_of(scene, 2, 64);
    std::vector<double> beams;
    for (const MeanEchogram* e : {&coarse, &fine})
        for (std::size_t beam = 0; beam < e->beams; ++beam) {
            double power = 0;
            for (std::size_t bin = 0; bin < e->bins; ++bin) power += e->at(beam, bin);
            beams.push_back(power);
        }
    double loudest = 0;
    for (const double power : beams) loudest = std::max(loudest, power);
    for (std::size_t beam = 0; beam < fine.beams; ++beam) {
        if (beams[fine.beams + beam] < 0.1 * loudest) continue;
        EXPECT_NEAR(test::db(beams[beam] / beams[fine.beams + beam]), 0, 0.2) << "beam " << beam;
    }
}

TEST(PixelDensity, FinerMeshKeepsTheLevel) {
    const MeanEchogram coarse = mean_of(scene_of({test::floor_at(-5, 60, 1)}), 1, 1);
    const MeanEchogram fine = mean_of(scene_of({test::floor_at(-5, 60, 240)}), 1, 1);
    const Comparison c = compare(coarse, fine, 0);
    EXPECT_EQ(c.different, 0U) << "of " << c.compared << ", by up to " << c.largest << " dB";
}

}  // namespace
}  // namespace echoloop
