#include <gtest/gtest.h>

#include <numeric>

#include "render/fan/binning.h"
#include "render/fan/line_bins.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

double sum(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// A box of 120 x 20 deg in bearing and elevation has the solid angle 2 sin(10 deg) x 120 deg.
TEST(FanPlan, PixelsHoldTheSolidAngleOfTheFan) {
    for (const auto& [aperture, height] :
         {std::pair{120.0, 20.0}, {3.0, 35.0}, {300.0, 40.0}, {30.0, 110.0}}) {
        const FanPlan plan = plan_fan(geometry_of(test::fan(aperture, height, 32, 500, 50)), {});
        const double expected = 2 * std::sin(deg_to_rad(height / 2)) * deg_to_rad(aperture);
        EXPECT_NEAR(sum(plan.solid_angle) / expected, 1, 2e-3) << aperture << " x " << height;
    }
}

TEST(FanPlan, NoViewIsWiderThan62Degrees) {
    for (const double aperture : {3.0, 60.0, 120.0, 359.0})
        for (const View& view : plan_fan(geometry_of(test::fan(aperture, 20, 64, 500, 50)), {}).views)
            EXPECT_LE(view.bearing_at(static_cast<double>(view.lines)) - view.bearing_at(0),
                      deg_to_rad(62.001));
}

TEST(FanPlan, EveryBeamGetsItsWidth) {
    const Shot touching = test::fan(120, 20, 256, 500, 50);
    Shot overlapping = touching, gappy = touching;
    overlapping.beam_width *= 2.5;
    gappy.beam_width *= 0.4;
    for (const Shot& shot : {touching, overlapping, gappy}) {
        const FanPlan plan = plan_fan(geometry_of(shot), {});
        std::vector<double> width(shot.bearings.size());
        for (std::size_t line = 0; line < plan.lines; ++line) {
            const View& view = plan.view_of(line);
            const auto in_view = static_cast<double>(line - view.first_line);
            const double line_width = view.bearing_at(in_view + 1) - view.bearing_at(in_view);
            for (std::uint32_t i = plan.first_share[line]; i < plan.first_share[line + 1]; ++i)
                width[plan.shares[i].beam] += plan.shares[i].weight * line_width;
        }
        for (const double w : width) EXPECT_NEAR(w, shot.beam_width, 1e-6);
    }
}

TEST(FanPlan, StaysWithinItsBounds) {
    const FanPlan plan = plan_fan(geometry_of(test::fan(359, 120, 4096, 4096, 50)), {64, 64});
    EXPECT_LE(plan.lines, 8192U);
    EXPECT_LE(plan.lines * plan.samples, std::size_t{5} << 20);
}

TEST(Jitter, SpreadsEvenlyAndStartsInTheMiddle) {
    EXPECT_EQ(jitter_of(0).line, 0);
    EXPECT_EQ(jitter_of(0).sample, 0);
    double lines = 0, samples = 0;
    for (std::uint64_t ping = 0; ping < 64; ++ping) {
        const PixelOffset offset = jitter_of(ping);
        EXPECT_LE(std::abs(offset.line), 0.5);
        EXPECT_LE(std::abs(offset.sample), 0.5);
        lines += offset.line / 64;
        samples += offset.sample / 64;
    }
    EXPECT_NEAR(lines, 0, 0.02);
    EXPECT_NEAR(samples, 0, 0.02);
}

std::vector<float> deposited(float low, float high, std::size_t bins = 8) {
    LineBins line(bins);
    line.clear();
    line.deposit(low, high, 1);
    std::vector<float> out(bins);
    line.add_to(out.data(), 1);
    return out;
}

TEST(LineBins, SpreadsOverTheBinsThatItCovers) {
    EXPECT_EQ(deposited(2.5F, 2.5F), (std::vector<float>{0, 0, 1, 0, 0, 0, 0, 0}));
    EXPECT_EQ(deposited(2, 4), (std::vector<float>{0, 0, 0.5F, 0.5F, 0, 0, 0, 0}));
    EXPECT_EQ(deposited(1.5F, 3.5F), (std::vector<float>{0, 0.25F, 0.5F, 0.25F, 0, 0, 0, 0}));
}

TEST(LineBins, DropsWhatIsOutside) {
    for (const auto& [low, high] : {std::pair{-3.0F, -1.0F}, {8.0F, 9.0F}, {1e30F, 2e30F}})
        EXPECT_EQ(sum(deposited(low, high)), 0) << low;
    EXPECT_NEAR(sum(deposited(-1, 1)), 0.5, 1e-6);
    EXPECT_NEAR(sum(deposited(7, 9)), 0.5, 1e-6);
    EXPECT_NEAR(sum(deposited(-8, 16)), 8.0 / 24, 1e-6);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(sum(deposited(nan, nan)), 0);
}

// Equation 1 of the paper with the constants of the authors' code.
TEST(Cerqueira, Sigmoid) {
    EXPECT_NEAR(cerqueira_sigmoid(2.0F / 3), 0.5, 1e-6);
    EXPECT_NEAR(cerqueira_sigmoid(1), 1 / (1 + std::exp(-6.0)), 1e-6);
    EXPECT_NEAR(cerqueira_sigmoid(0), 1 / (1 + std::exp(12.0)), 1e-7);
}

}  // namespace
}  // namespace echoloop
