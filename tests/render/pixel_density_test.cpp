// V16: the number of pixels and the fineness of a mesh are bookkeeping; levels do not depend on them.
#include <gtest/gtest.h>

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

MeanEchogram mean_of(const std::shared_ptr<const Scene>& scene, double pixel_density, std::uint64_t pings) {
    Renderer renderer(scene, test::water_of(1500), {.columns_per_beam = 3, .pixel_density = 2 * pixel_density, .effects = test::boxes().effects});
    Shot shot = test::forward_looking();
    MeanEchogram mean{shot.bearings.size(), shot.bins, std::vector<double>(shot.bearings.size() * shot.bins)};
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        const Echogram e = renderer.render(shot, {});
        for (std::size_t i = 0; i < e.values.size(); ++i)
            mean.values[i] += e.values[i] / static_cast<double>(pings);
    }
    return mean;
}

/// True where the level jumps by 3 dB or more to one of the bins around: an object's outline, the end of its
/// shadow or the limit of the fan passes here, within a pixel of where it really is.
bool at_an_edge(const MeanEchogram& e, std::size_t beam, std::size_t bin) {
    constexpr std::size_t bins_around = 3, beams_around = 1;
    const double here = e.at(beam, bin);
    for (std::size_t b = beam - std::min(beam, beams_around); b <= std::min(beam + beams_around, e.beams - 1);
         ++b)
        for (std::size_t i = bin - std::min(bin, bins_around); i <= std::min(bin + bins_around, e.bins - 1);
             ++i)
            if (e.at(b, i) < here / 2 || e.at(b, i) > here * 2) return true;
    return false;
}

struct Comparison {
    std::size_t compared = 0, different = 0;
    double largest = 0;  ///< dB
    std::size_t edges = 0, different_edges = 0;
};

Comparison compare(const MeanEchogram& coarse, const MeanEchogram& fine) {
    Comparison out;
    for (std::size_t beam = 0; beam < fine.beams; ++beam)
        for (std::size_t bin = 0; bin < fine.bins; ++bin) {
            if (fine.at(beam, bin) == 0 && coarse.at(beam, bin) == 0) continue;
            const bool edge = at_an_edge(fine, beam, bin);
            const double difference = std::abs(test::db(coarse.at(beam, bin) / fine.at(beam, bin)));
            const bool different = !(difference <= 0.2);
            ++(edge ? out.edges : out.compared);
            (edge ? out.different_edges : out.different) += different;
            if (!edge) out.largest = std::max(out.largest, difference);
        }
    return out;
}

TEST(PixelDensity, DoublingChangesNoBinOfAFloor) {
    const auto scene = scene_of({test::floor_at(-5, 200)});
    const Comparison c = compare(mean_of(scene, 1, 1), mean_of(scene, 2, 1));
    RecordProperty("largest_db", std::to_string(c.largest));
    EXPECT_GT(c.compared, 70'000U);
    EXPECT_EQ(c.different, 0U) << "of " << c.compared << ", by up to " << c.largest << " dB";
    EXPECT_LT(c.different_edges, 500U) << "of " << c.edges;
}

// With objects, bins within 3 bins or one beam of an edge are left out, as the edge moves by up to a pixel;
// the mean is taken over 16 pings.
TEST(PixelDensity, DoublingChangesNoBinAwayFromEdges) {
    const auto scene = scene_of({test::floor_at(-5, 200), test::box("box", {15, 2, -4}, {3, 4, 2}, 0.4),
                                 test::wall_at(35, 40, -5, 5)});
    const MeanEchogram coarse = mean_of(scene, 2, 16), fine = mean_of(scene, 4, 16);
    const Comparison c = compare(coarse, fine);
    EXPECT_GT(c.compared, 60'000U);
    EXPECT_LT(c.different, c.compared / 500) << "by up to " << c.largest << " dB";
    EXPECT_LT(c.different_edges + c.different, (c.compared + c.edges) / 40);
    EXPECT_LT(c.largest, 2.5);
    double coarse_power = 0, fine_power = 0;
    for (const double v : coarse.values) coarse_power += v;
    for (const double v : fine.values) fine_power += v;
    EXPECT_NEAR(test::db(coarse_power / fine_power), 0, 0.02);
}

// Each beam hears the same from a box, however many pixels show it.
TEST(PixelDensity, DoublingChangesNoBeam) {
    const auto scene =
        scene_of({test::box("box", {15, 2, -4}, {3, 4, 2}, 0.4), test::sphere({12, -4, -4}, 0.6, 32)});
    const MeanEchogram coarse = mean_of(scene, 1, 16), fine = mean_of(scene, 2, 16);
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
        if (beams[fine.beams + beam] < 0.02 * loudest) continue;
        EXPECT_NEAR(test::db(beams[beam] / beams[fine.beams + beam]), 0, 0.2) << "beam " << beam;
    }
}

TEST(PixelDensity, FinerMeshKeepsTheLevel) {
    const MeanEchogram coarse = mean_of(scene_of({test::floor_at(-5, 60, 1)}), 1, 1);
    const MeanEchogram fine = mean_of(scene_of({test::floor_at(-5, 60, 240)}), 1, 1);
    const Comparison c = compare(coarse, fine);
    EXPECT_EQ(c.different, 0U) << "of " << c.compared << ", by up to " << c.largest << " dB";
}

}  // namespace
}  // namespace echoloop
