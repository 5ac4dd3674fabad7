// V16: the number of pixels and the fineness of a mesh are bookkeeping; levels do not depend on them.
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "tests/render/meshes.h"
#include "tests/render/shots.h"
#include "tools/echoloop/bench/scenes.h"

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

MeanEchogram mean_of(const std::shared_ptr<const Scene>& scene, double pixel_density, std::uint64_t pings,
                     Shot shot = array(), const Pose& pose = {}) {
    Renderer renderer(scene, test::water_of(1500), {.pixel_density = pixel_density, .effects = means()});
    MeanEchogram mean{shot.bearings.size(), shot.bins, std::vector<double>(shot.bearings.size() * shot.bins)};
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        shot.random_key = shot.ping;  // moves the samples that side lobes hear, which a sonar at rest keeps
        const Echogram e = renderer.render(shot, pose);
        for (std::size_t i = 0; i < e.values.size(); ++i)
            mean.values[i] += e.values[i] / static_cast<double>(pings);
    }
    return mean;
}

struct Comparison {
    std::size_t compared = 0, different = 0;
    double largest = 0;  ///< dB
};

/// Bins whose levels differ by more than 0.2 dB, from `first` on, as heard in thermal noise: 42.5 dB re 1
/// uPa^2/Hz, a band of 7.5 kHz, a directivity index of 30 dB. Bins more than `below_loudest` dB below the
/// loudest are left out.
Comparison compare(const MeanEchogram& coarse, const MeanEchogram& fine, std::size_t first,
                   std::size_t end = 500, double below_loudest = 1e9) {
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

constexpr std::size_t main_lobe =
    125;  ///< the first bin in which a floor 5 m below is seen by the level views alone

TEST(PixelDensity, DoublingChangesNoBinOfAFloorInTheMainLobe) {
    const auto scene = scene_of({test::floor_at(-5, 200)});
    const Comparison c = compare(mean_of(scene, 1, 8), mean_of(scene, 2, 8), main_lobe, 490);
    EXPECT_GT(c.compared, 90'000U);
    EXPECT_EQ(c.different, 0U) << "of " << c.compared << ", by up to " << c.largest << " dB";
}

/// The middle of the paper's forward-looking sonar, every beam as wide as in the whole; `range`: m.
Shot quarter_array(double range) {
    Shot shot = test::fan(30, 20, 64, 500, range);
    shot.tilt = deg_to_rad(-20);
    shot.pulse_length = shot.bin_interval;
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.vertical = {ApertureShape::line, 2};
    return shot;
}

Shot head(double range) {
    Shot shot = test::fan(3, 35, 1, 500, range);
    shot.pulse_length = shot.bin_interval;
    shot.horizontal = shot.vertical = {ApertureShape::line, 2};
    return shot;
}

struct Place {
    std::string name;
    std::shared_ptr<const Scene> scene;
    Pose pose;
    double range;  ///< m
};

std::vector<Place> places() {
    const std::string scenes = ECHOLOOP_SOURCE_DIR "/config/scenes/";
    const auto boxes = scene_of({test::floor_at(-5, 200), test::box("box", {15, 2, -4}, {3, 4, 2}, 0.4),
                                 test::wall_at(35, 40, -5, 5)});
    return {{"floor", scene_of({test::floor_at(-5, 200)}), {}, 50},
            {"boxes", boxes, {}, 50},
            {"big100k", Scene::from_meshes(bench::scene_meshes("big100k")), {}, 50},
            {"manifold", Scene::load(scenes + "manifold.glb"), {{-17.5, 0, -3.1}, {}}, 50},
            {"tank", Scene::load(scenes + "tank.glb"), {{0, 0, -2}, {}}, 12}};
}

/// Fainter bins need more pings: with 3000 of them all are the same, but for a few at the level of the noise.
void expect_the_same_bins(const Place& place, const char* sonar, const Shot& shot, std::uint64_t pings) {
    const MeanEchogram coarse = mean_of(place.scene, 1, pings, shot, place.pose);
    const MeanEchogram fine = mean_of(place.scene, 2, pings, shot, place.pose);
    const Comparison loud = compare(coarse, fine, 0, 500, 30);
    ASSERT_GT(loud.compared, 50U);
    EXPECT_EQ(loud.different, 0U) << place.name << ", " << sonar << ": of " << loud.compared
                                  << " bins, by up to " << loud.largest << " dB";
    EXPECT_NEAR(test::db(total(coarse) / total(fine)), 0, 0.01) << place.name << ", " << sonar;
}

// First return and side lobes too.
TEST(PixelDensity, DoublingChangesNoBinOfAnArray) {
    for (const Place& place : places()) expect_the_same_bins(place, "array", quarter_array(place.range), 512);
}

TEST(PixelDensity, DoublingChangesNoBinOfAHead) {
    for (const Place& place : places()) expect_the_same_bins(place, "head", head(place.range), 512);
}

/// Share of a sonar's bins, among those within 30 dB of the loudest, whose mean scatters from ping to ping by
/// more than a fifth of what one look of speckle does: 0.2 of the level.
double share_that_scatters(const Place& place, Shot shot) {
    constexpr double pings = 64;
    Renderer renderer(place.scene, test::water_of(1500), {.effects = means()});
    std::vector<double> sum(shot.bearings.size() * shot.bins), squares(sum.size());
    for (shot.ping = 0; shot.ping < 64; ++shot.ping) {
        const Echogram e = renderer.render(shot, place.pose);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const auto value = static_cast<double>(e.values[i]);
            sum[i] += value / pings, squares[i] += value * value / pings;
        }
    }
    const double least = 1e-3 * *std::ranges::max_element(sum);
    double heard = 0, scattered = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        if (sum[i] < least) continue;
        ++heard;
        scattered += squares[i] - sum[i] * sum[i] > 0.2 * 0.2 * sum[i] * sum[i] ? 1 : 0;
    }
    return scattered / heard;
}

// What fewer samples cost is scatter. It hides in the speckle, but for edges and thin pipes, which a sample
// sees or does not. Samples of 2 bins and 0.2 deg had 0.053, 0.236 and 0.063 in the last three, the
// manifold's before its gravel had uneven edges, which add 0.08.
TEST(PixelDensity, SamplesOfAFanScatterLessThanAFifthOfTheSpeckle) {
    constexpr std::array most{0.001, 0.03, 0.10, 0.42, 0.09};
    const auto all = places();
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_LT(share_that_scatters(all[i], quarter_array(all[i].range)), most[i]) << all[i].name;
}

// Lines of 0.4 deg instead of 0.6 had 0.068, 0.038 and 0.001 in the last three; of 0.8 0.137, 0.061 and
// 0.021.
TEST(PixelDensity, SamplesOfAHeadScatterLessThanAFifthOfTheSpeckle) {
    constexpr std::array most{0.005, 0.01, 0.10, 0.07, 0.03};
    const auto all = places();
    for (std::size_t i = 0; i < all.size(); ++i) {
        double share = 0;
        constexpr int pans = 6;
        for (int pan = 0; pan < pans; ++pan) {
            Shot shot = head(all[i].range);
            shot.pan = deg_to_rad(10 + 360.0 * pan / pans - 180);
            share += share_that_scatters(all[i], shot) / pans;
        }
        EXPECT_LT(share, most[i]) << all[i].name;
    }
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
    // From the bin on that begins at the floor: whether its nearest point is a hair nearer is rounding.
    const Comparison c = compare(coarse, fine, 50);
    EXPECT_EQ(c.different, 0U) << "of " << c.compared << ", by up to " << c.largest << " dB";
}

}  // namespace
}  // namespace echoloop
