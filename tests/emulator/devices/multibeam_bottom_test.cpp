// Bottom detection of multibeams: right on flat, sloping and stepped floors, and wrong where a real head is
// wrong.
#include "emulator/devices/family/multibeam/bottom.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/emulator/devices/seabed_echo.h"

namespace echoloop::test {
namespace {

using multibeam::Detection;
using multibeam::Method;

std::vector<Detection> detect(const Echogram& e, const multibeam::Gates& gates = {}, double margin = 10) {
    const double window = static_cast<double>(e.shot.bins) * e.shot.bin_interval;
    std::vector<multibeam::TimeGate> times;
    for (const double angle : e.shot.bearings)
        times.push_back(multibeam::time_gate(gates, angle, 1500, window));
    multibeam::Rule rule;
    rule.margin = margin;
    return multibeam::detect(e, times, rule);
}

double slant(const Detection& d) { return d.time * 750; }

std::size_t found(const std::vector<Detection>& all) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](auto& d) { return d.found(); }));
}

struct Floor {
    const char* name;
    Bottom bottom;
};
void PrintTo(const Floor& floor, std::ostream* out) { *out << floor.name; }

class MultibeamFloor : public testing::TestWithParam<Floor> {};

TEST_P(MultibeamFloor, IsWithinHalfAPerCentInsideSixtyDegrees) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Shot shot = wide_fan(75);
        const auto all = detect(bottom_echo(shot, GetParam().bottom, {.seed = seed}));
        for (std::size_t n = 0; n < all.size(); ++n) {
            const double angle = shot.bearings[n];
            const double truth = GetParam().bottom(angle);
            ASSERT_TRUE(all[n].found()) << rad_to_deg(angle);
            EXPECT_NEAR(slant(all[n]), truth, 0.005 * truth) << rad_to_deg(angle) << " deg, seed " << seed;
            EXPECT_TRUE(all[n].in_line) << rad_to_deg(angle);
            EXPECT_GT(all[n].excess, 10);
            EXPECT_LE(all[n].begin, all[n].time);
            EXPECT_GE(all[n].end, all[n].time);
        }
    }
}

/// What floats in the water, heard from right before the array on: as R^-2.
Echogram with_water(Echogram e) {
    std::mt19937 random(7);
    std::exponential_distribution<float> speckle(1);
    for (std::size_t beam = 0; beam < e.beams(); ++beam)
        for (std::size_t bin = 0; bin < e.shot.bins; ++bin) {
            const double range = e.bin_range(bin);
            e.values[beam * e.shot.bins + bin] += static_cast<float>(1e4 / (range * range)) * speckle(random);
        }
    return e;
}

TEST(MultibeamDetection, IsNotTakenInByTheWaterBeforeTheArray) {
    const Shot shot = wide_fan(75);
    const Echogram e = with_water(bottom_echo(shot, flat(15), {}));
    ASSERT_GT(e.beam(0)[2], 1e6) << "louder than the bottom";
    const auto all = detect(e);
    for (std::size_t n = 0; n < all.size(); ++n) {
        const double truth = 15 / std::cos(shot.bearings[n]);
        EXPECT_NEAR(slant(all[n]), truth, 0.005 * truth) << rad_to_deg(shot.bearings[n]);
    }
    EXPECT_EQ(found(detect(with_water(empty_sea(shot, {})))), 0) << "water alone is no bottom";
}

/// One beam's speckle leaves next to nothing of its bottom, less than side lobes could bring; and all beams
/// hear the bottom before and behind the boat a little later, by way of the fan's side lobes.
Echogram with_hole(Echogram e, std::size_t hole) {
    const auto first = static_cast<std::size_t>(15 / 750.0 / e.shot.bin_interval) - 2;
    for (std::size_t beam = 0; beam < e.beams(); ++beam)
        for (std::size_t bin = first; bin < first + 60; ++bin) {
            float& value = e.values[beam * e.shot.bins + bin];
            if (beam == hole && bin < first + 10) value *= 0.005F;
            if (bin > first + 34) value += 3000;
        }
    return e;
}

TEST(MultibeamDetection, FindsTheBottomInAHoleOfTheSpeckle) {
    const Shot shot = wide_fan(45);
    for (const std::size_t hole : {100U, 123U, 131U}) {
        const auto all = detect(with_hole(bottom_echo(shot, flat(15), {.speckle = false}), hole));
        const double truth = 15 / std::cos(shot.bearings[hole]);
        ASSERT_TRUE(all[hole].found()) << rad_to_deg(shot.bearings[hole]);
        EXPECT_NEAR(slant(all[hole]), truth, 0.005 * truth) << rad_to_deg(shot.bearings[hole]);
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, MultibeamFloor,
                         testing::Values(Floor{"flat", flat(15)}, Floor{"slope", sloping(15, deg_to_rad(15))},
                                         Floor{"slope to port", sloping(12, deg_to_rad(-20))}),
                         [](const testing::TestParamInfo<Floor>& which) {
                             return std::string(which.param.name).substr(0, 5) + std::to_string(which.index);
                         });

TEST(MultibeamStep, BothSidesAreRightAndTheWallLiesBetween) {
    const Shot shot = wide_fan(45);
    const double low = 15, height = 2, across = 6;
    const auto all = detect(bottom_echo(shot, step(low, height, across), {}));
    const double foot = std::atan(across / low), top = std::atan(across / (low - height));
    for (std::size_t n = 0; n < all.size(); ++n) {
        const double angle = shot.bearings[n], depth = slant(all[n]) * std::cos(angle);
        const double away = 1.5 * shot.beam_width;
        if (angle < foot - away) {
            EXPECT_NEAR(depth, low, 0.005 * low) << rad_to_deg(angle);
        } else if (angle > top + away) {
            EXPECT_NEAR(depth, low - height, 0.005 * low) << rad_to_deg(angle);
        } else {
            EXPECT_GT(depth, low - height - 0.1);
            EXPECT_LT(depth, low + 0.1);
        }
    }
}

TEST(MultibeamPulse, DoesNotShiftTheBottomHoweverLongItIs) {
    for (const double length : {20e-6, 100e-6, 380e-6}) {
        Shot shot = wide_fan(45);
        shot.pulse_length = length;
        const auto all = detect(bottom_echo(shot, flat(15), {.speckle = false}));
        for (const std::size_t n : {100U, 128U, 150U})
            EXPECT_NEAR(slant(all[n]) * std::cos(shot.bearings[n]), 15, 0.008) << length;
    }
}

TEST(MultibeamPhase, TakesOverWhereFootprintsAreLongAgainstThePulse) {
    const Shot shot = wide_fan(45);
    const auto all = detect(bottom_echo(shot, flat(15), {}));
    const auto by_phase = [&](double from, double to) {
        int phase = 0, count = 0;
        for (std::size_t n = 0; n < all.size(); ++n) {
            const double angle = std::abs(rad_to_deg(shot.bearings[n]));
            if (angle < from || angle >= to) continue;
            ++count;
            phase += all[n].method == Method::phase;
        }
        return static_cast<double>(phase) / count;
    };
    EXPECT_EQ(by_phase(0, 15), 0.0) << "footprints are shorter than the pulse";
    EXPECT_GT(by_phase(45, 60.1), 0.9);
}

TEST(MultibeamPhase, IsMoreExactThanTheMiddleOfTheEcho) {
    // The floor ends within the footprint of each beam on its outer side, as where weed or a shadow swallows
    // it.
    const Shot shot = wide_fan(60);
    Echogram e = bottom_echo(shot, flat(20), {.speckle = false});
    const std::size_t beam = 240;  // 53 deg
    const auto axis = static_cast<std::size_t>(2 * flat(20)(shot.bearings[beam]) / 1500 / shot.bin_interval);
    for (const std::size_t n : {beam - 1, beam, beam + 1})
        for (std::size_t bin = axis + 6; bin < shot.bins; ++bin) e.values[n * shot.bins + bin] *= 0.15F;
    const auto all = detect(e);
    EXPECT_EQ(all[beam].method, Method::phase);
    EXPECT_NEAR(slant(all[beam]), flat(20)(shot.bearings[beam]), 0.003 * 33);
}

TEST(MultibeamPhase, WideBeamsSeeTheBottomNoDeeperThanItIs) {
    // The echo's time bends over a wide beam: at 58 deg its middle comes 0.1 % after that of the axis.
    Shot shot = wide_fan(45);
    shot.beam_width = deg_to_rad(2);
    const auto all = detect(bottom_echo(shot, flat(14), {.speckle = false}));
    for (const std::size_t n : {5U, 15U, 40U, 230U}) {
        EXPECT_EQ(all[n].method, Method::phase);
        EXPECT_NEAR(slant(all[n]) / flat(14)(shot.bearings[n]), 1, 3e-4) << rad_to_deg(shot.bearings[n]);
    }
}

TEST(MultibeamFan, ItsHeightAndSideLobesAlongTheTrackMakeTheBottomNoDeeper) {
    // What lies at an angle along the track is farther: an unshaded projector 3 deg high hears it by 0.07 %
    // on average.
    Shot shot = wide_fan(45);
    shot.beam_width = deg_to_rad(1.5);
    shot.fan_height = deg_to_rad(3);
    shot.vertical = {ApertureShape::line, 1};
    Echogram e = empty_sea(shot, {});
    for (double along = -0.4; along < 0.4; along += 0.004) {
        const double x = std::numbers::pi * 0.886 * along / shot.fan_height;
        const double lobe = std::abs(x) < 1e-9 ? 1 : std::sin(x) * std::sin(x) / (x * x);
        const auto behind = [=](double angle) { return flat(14)(angle) / std::cos(along); };
        add_bottom(e, behind, {.echo = 1e6 * lobe, .speckle = false});
    }
    const auto all = detect(e);
    double sum = 0;
    for (std::size_t n = 10; n < 246; ++n) sum += slant(all[n]) / flat(14)(shot.bearings[n]) - 1;
    EXPECT_NEAR(sum / 236, 0, 3e-4);
}

TEST(MultibeamPhase, OutermostBeamsGoOnInLine) {
    Shot shot = wide_fan(60);
    shot.beam_width = deg_to_rad(2);
    double worst = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto all = detect(bottom_echo(shot, flat(14), {.seed = seed}));
        for (const std::size_t edge : {0U, 1U, 2U, 253U, 254U, 255U})
            worst = std::max(worst, std::abs(slant(all[edge]) / flat(14)(shot.bearings[edge]) - 1));
    }
    EXPECT_LT(worst, 0.005);
}

TEST(MultibeamNoise, WeakEchoesAreLostAndWhatIsFoundInNoiseIsNeitherBrightNorInLine) {
    const Shot shot = wide_fan(45);
    EXPECT_EQ(found(detect(bottom_echo(shot, flat(15), {.echo = 1e6}))), 256U);
    const auto weak = detect(bottom_echo(shot, flat(15), {.echo = 12}));
    EXPECT_LT(found(weak), 200U);
    for (const Detection& d : weak) EXPECT_LT(d.excess, 10);
    const auto noise = detect(empty_sea(shot, {}));
    EXPECT_LT(found(noise), 3U);
    const auto eager = detect(empty_sea(shot, {}), {}, 2);
    EXPECT_GT(found(eager), 100U) << "a low margin believes noise";
    const auto in_line = std::count_if(eager.begin(), eager.end(), [](auto& d) { return d.in_line; });
    EXPECT_LT(in_line, 60);
}

TEST(MultibeamMultipath, AGateBehindTheBottomFindsItTwiceAsDeep) {
    const Shot shot = wide_fan(70);
    Echogram e = bottom_echo(shot, flat(10), {});
    // The echo that bounced off the surface: twice the way, weaker.
    add_bottom(e, [](double angle) { return 20 / std::cos(angle); }, {.echo = 1e4, .seed = 7});
    EXPECT_NEAR(multibeam::median_depth(detect(e), shot.bearings, 1500), 10, 0.05);
    const auto fooled = detect(e, {.depth = multibeam::DepthGate{15, 30, 0}, .range = {}});
    EXPECT_NEAR(multibeam::median_depth(fooled, shot.bearings, 1500), 20, 0.1);
    EXPECT_GT(found(fooled), 250U);
}

TEST(MultibeamSideLobes, AStrongNadirDrownsTheOuterBeamsInAnArc) {
    const Shot shot = wide_fan(45);
    Echogram e = bottom_echo(shot, flat(15), {.echo = 1e3});
    for (std::size_t n = 0; n < 256; ++n) add_pulse(e, n, 2 * 15.0 / 1500, 35e-6, 1e6);
    const auto all = detect(e);
    for (const std::size_t n : {20U, 235U}) EXPECT_NEAR(slant(all[n]), 15, 0.1) << "its range, not its own";
}

TEST(MultibeamGates, CutWhatLiesOutsideAndBiasWhatTheyCutThrough) {
    const Shot shot = wide_fan(45);
    const Echogram e = bottom_echo(shot, flat(15), {});
    EXPECT_EQ(found(detect(e, {.depth = multibeam::DepthGate{20, 25, 0}, .range = {}})), 0U);
    EXPECT_EQ(found(detect(e, {.depth = {}, .range = multibeam::RangeGate{1, 14}})), 0U);
    EXPECT_EQ(found(detect(e, {.depth = multibeam::DepthGate{14, 16, 0}, .range = {}})), 256U);
    // A range gate at 20 m ends in the beam at acos(15 / 20) = 41 deg: farther out there is nothing.
    const auto cut = detect(e, {.depth = {}, .range = multibeam::RangeGate{0, 20}});
    for (std::size_t n = 0; n < 256; ++n) {
        const double angle = std::abs(rad_to_deg(shot.bearings[n]));
        if (angle >= 40 && angle <= 43) continue;
        EXPECT_EQ(cut[n].found(), angle < 40) << angle;
    }
    // A gate that slopes the wrong way lets one side through only.
    const auto tilted = detect(e, {.depth = multibeam::DepthGate{14, 16, deg_to_rad(20)}, .range = {}});
    EXPECT_TRUE(tilted[128].found());
    EXPECT_FALSE(tilted[10].found());
    EXPECT_FALSE(tilted[245].found());
}

}  // namespace
}  // namespace echoloop::test
