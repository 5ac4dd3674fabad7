#include <gtest/gtest.h>

#include "render/acoustics/rows.h"
#include "tests/render/acoustics/chain_shots.h"
#include "tests/render/acoustics/statistics.h"

namespace echoloop {
namespace {

constexpr std::size_t columns = 8, rows = 33;

/// Rows of beams a quarter of their height apart, each of which is the output of the chain for even power.
Echogram even_rows(Effects effects, float power) {
    Echogram grid;
    grid.shot = test::chain_shot(columns, 4000, 0.3, 0.075);
    grid.shot.fan_height = deg_to_rad(2);
    grid.shot.vertical = {ApertureShape::hamming, 1};
    for (std::size_t row = 0; row < rows; ++row)
        grid.shot.elevations.push_back(deg_to_rad(0.5 * static_cast<double>(row) - 8));
    grid.sound_speed = test::water_speed;
    grid.values.assign(grid.beams() * grid.shot.bins, power);
    AcousticChain chain(effects);
    apply_to_rows(chain, {}, grid);
    return grid;
}

// V27 upright: intensities of rows of beams that share staves, at 0.25, 0.5, 0.75, 1 and 1.5 heights.
TEST(Rows, ThatShareStavesCorrelate) {
    const Echogram speckle = even_rows(test::only({Effect::pulse, Effect::speckle}), 1);
    const Echogram noise = even_rows(test::only({Effect::pulse, Effect::noise}), 0);
    const auto between = [](const Echogram& grid, std::size_t step) {
        double sum = 0;
        for (std::size_t row = 0; row + step < rows; ++row)
            sum += correlation(grid.beam(columns * row + 3), grid.beam(columns * (row + step) + 3)) /
                   static_cast<double>(rows - step);
        return sum;
    };
    const std::pair<std::size_t, double> pairs[] = {
        {1, 0.907}, {2, 0.675}, {3, 0.410}, {4, 0.200}, {6, 0.022}};
    for (const auto& [step, expected] : pairs) {
        EXPECT_NEAR(between(speckle, step), expected, 0.03) << step << " quarters";
        EXPECT_NEAR(between(noise, step), expected, 0.03) << "noise, " << step << " quarters";
    }
}

}  // namespace
}  // namespace echoloop
