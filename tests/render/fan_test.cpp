#include <gtest/gtest.h>

#include <numeric>

#include "render/acoustics/pattern.h"
#include "render/fan/binning.h"
#include "render/fan/far_lobes.h"
#include "render/fan/line_bins.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

double sum(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

FanPlan plan_of(const Shot& shot, const Effects& effects = Effects::none(), const PlanDensity& density = {}) {
    return plan_fan(geometry_of(shot, effects), density);
}

/// The weights of one line of a view.
double line_sum(const FanPlan& plan, std::size_t line) {
    const View& view = plan.view_of(line);
    const auto first = plan.weight.begin() + static_cast<std::ptrdiff_t>(
                                                 view.first_pixel + (line - view.first_line) * view.samples);
    return std::accumulate(first, first + static_cast<std::ptrdiff_t>(view.samples), 0.0);
}

// A box of 120 x 20 deg in bearing and elevation has the solid angle 2 sin(10 deg) x 120 deg.
TEST(FanPlan, PixelsHoldTheSolidAngleOfTheFan) {
    for (const auto& [aperture, height] :
         {std::pair{120.0, 20.0}, {3.0, 35.0}, {300.0, 40.0}, {30.0, 110.0}}) {
        const FanPlan plan = plan_of(test::fan(aperture, height, 32, 500, 50));
        double total = 0;
        for (std::size_t line = 0; line < plan.lines; ++line) total += line_sum(plan, line);
        const double expected = 2 * std::sin(deg_to_rad(height / 2)) * deg_to_rad(aperture);
        EXPECT_NEAR(total / expected, 1, 2e-3) << aperture << " x " << height;
    }
}

TEST(FanPlan, NoViewIsWiderThan62Degrees) {
    for (const double aperture : {3.0, 60.0, 120.0, 359.0})
        for (const View& view : plan_of(test::fan(aperture, 20, 64, 500, 50)).views)
            EXPECT_LE(view.bearing_at(static_cast<double>(view.lines)) - view.bearing_at(0),
                      deg_to_rad(62.001));
}

TEST(FanPlan, EveryBeamGetsItsWidth) {
    const Shot touching = test::fan(120, 20, 256, 500, 50);
    Shot overlapping = touching, gappy = touching;
    overlapping.beam_width *= 2.5;
    gappy.beam_width *= 0.4;
    for (const Shot& shot : {touching, overlapping, gappy}) {
        const FanPlan plan = plan_of(shot);
        for (const BeamLines& beam : plan.beams) {
            double width = 0;
            for (std::size_t i = 0; i < beam.lines; ++i) {
                const View& view = plan.view_of(beam.first_line + i);
                const auto in_view = static_cast<double>(beam.first_line + i - view.first_line);
                width += plan.line_weight[beam.first_weight + i] *
                         (view.bearing_at(in_view + 1) - view.bearing_at(in_view));
            }
            EXPECT_NEAR(width, shot.beam_width, 1e-6);
        }
    }
}

TEST(FanPlan, StaysWithinItsBounds) {
    const FanPlan plan = plan_of(test::fan(359, 120, 4096, 4096, 50), Effects::none(), {64, 64});
    EXPECT_LE(plan.lines, 8192U);
    EXPECT_LE(plan.lines * plan.samples, std::size_t{5} << 20);
}

void share_out(SectorShare share, double amount, std::vector<double>& sectors) {
    sectors[share.sector] += (1 - share.next) * amount;
    if (share.next > 0) sectors[share.sector + 1U] += share.next * amount;
}

/// What a single beam hears of a line: its samples differ, as it is the wider the higher it looks.
double single_beam_sum(const FanPlan& plan, std::size_t line) {
    const View& view = plan.view_of(line);
    const double in_view = static_cast<double>(line - view.first_line) + 0.5;
    double sum = 0;
    for (std::size_t i = 0; i < view.samples; ++i) {
        const double elevation = view.elevation_at(in_view, static_cast<double>(i) + 0.5);
        const double off = std::sin(view.bearing_at(in_view) - plan.beams[0].bearing) * std::cos(elevation);
        const std::size_t pixel = view.first_pixel + (line - view.first_line) * view.samples + i;
        sum += plan.weight[pixel] * plan.beside.at(static_cast<float>(off));
    }
    return sum;
}

/// What a beam hears of a world that scatters the same from everywhere: all weights that lead to it.
double heard(const FanPlan& plan, std::size_t b) {
    const BeamLines& beam = plan.beams[b];
    double sum = 0;
    for (std::size_t i = 0; i < beam.lines; ++i)
        sum += plan.line_weight[beam.first_weight + i] * (plan.beside.empty()
                                                              ? line_sum(plan, beam.first_line + i)
                                                              : single_beam_sum(plan, beam.first_line + i));
    const FarLobes& far = plan.far_lobes;
    std::vector<double> sectors(far.sectors);
    if (plan.beams.size() > 1)
        for (std::size_t line = 0; line < plan.lines; ++line)
            share_out(plan.line_sector[line], line_sum(plan, line), sectors);
    for (const SurroundPixel& pixel : plan.surround) {
        const auto place = static_cast<double>(pixel.sector.mean);
        const double beside = pixel.beside.mean, off_plane = pixel.off_plane.mean;
        share_out(sector_at_place(plan, SectorKind::beside, place), beside, sectors);
        share_out(sector_at_place(plan, SectorKind::off_plane, place), off_plane, sectors);
    }
    const std::size_t node = b / far.beams_per_node;
    for (std::size_t s = 0; s < far.sectors; ++s) sum += far.weight[node * far.sectors + s] * sectors[s];
    return sum;
}

/// The same by a sum over the half space in front of the array, in steps of 0.1 deg.
double expected_to_be_heard(const Shot& shot, double beam) {
    const TwoWayPattern across(shot.horizontal, shot.beam_width), up(shot.vertical, shot.fan_height);
    const double step = deg_to_rad(0.1);
    double sum = 0;
    for (double e = -std::numbers::pi / 2 + step / 2; e < std::numbers::pi / 2; e += step)
        for (double b = -std::numbers::pi / 2 + step / 2; b < std::numbers::pi / 2; b += step) {
            // Beams of a fan are upright planes about as far as where the surround begins.
            const bool level = shot.bearings.size() > 1 && std::abs(e) < shot.fan_height;
            const double off = level ? b - beam : std::asin(std::sin(b) * std::cos(e)) - beam;
            sum += up.power(e) * across.power(off) * std::cos(e) * step * step;
        }
    return sum;
}

// Main lobe, side lobes and what lies around together are the integral of the pattern.
TEST(FanPlan, BeamsHoldTheirWholePattern) {
    Shot head = test::scanning();
    Shot array = test::forward_looking();
    array.horizontal = {ApertureShape::line, 1};
    array.vertical = {ApertureShape::line, 1};
    const FanPlan one = plan_of(head, Effects()), many = plan_of(array, Effects());
    EXPECT_NEAR(test::db(heard(one, 0) / expected_to_be_heard(head, 0)), 0, 0.1);
    for (const std::size_t beam : {0U, 128U, 200U})  // nodes of the far lobes
        EXPECT_NEAR(test::db(heard(many, beam) / expected_to_be_heard(array, array.bearings[beam])), 0, 0.15)
            << beam;
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
    std::vector<float> out(bins);
    LineBins(out.data(), bins).deposit(low, high, 1);
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

TEST(LineBins, ClearsWhatItHeldButForWhatIsSetAnew) {
    constexpr std::size_t count = 256;  // a bit for each 16
    std::vector<float> out(count);
    LineBins row(out.data(), count);
    row.deposit(10, 40, 1), row.deposit(100, 200, 1), row.deposit(250.5F, 250.5F, 1);
    std::fill(out.begin() + 120, out.begin() + 130, 3.0F);
    row.clear_but(120, 130);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(out[i], 120 <= i && i < 130 ? 3 : 0) << i;
    EXPECT_TRUE(row.empty());
}

// Equation 1 of the paper with the constants of the authors' code.
TEST(Cerqueira, Sigmoid) {
    EXPECT_NEAR(cerqueira_sigmoid(2.0F / 3), 0.5, 1e-6);
    EXPECT_NEAR(cerqueira_sigmoid(1), 1 / (1 + std::exp(-6.0)), 1e-6);
    EXPECT_NEAR(cerqueira_sigmoid(0), 1 / (1 + std::exp(12.0)), 1e-7);
}

}  // namespace
}  // namespace echoloop
