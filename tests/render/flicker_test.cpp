// A scene at rest before a sonar at rest looks the same at every ping, but for noise.
#include <gtest/gtest.h>

#include "render/fan/resting_offset.h"
#include "tests/render/meshes.h"
#include "tests/render/shots.h"

namespace echoloop {
namespace {

using test::db;
using test::scene_of;

Effects steady() {
    Effects effects;
    for (const Effect effect : {Effect::speckle, Effect::noise, Effect::multipath, Effect::saturation})
        effects.set(effect, false);
    return effects;
}

/// An imaging sonar that looks along a floor with boxes on it, 5 m below.
Shot imaging(double range = 20) {
    Shot shot = test::fan(130, 20, 128, 400, range);
    shot.pulse_length = shot.bin_interval;
    shot.horizontal = {ApertureShape::hamming, 1};
    shot.vertical = {ApertureShape::line, 2};
    return shot;
}

std::shared_ptr<const Scene> boxes_on_a_floor() {
    return scene_of({test::floor_at(-5, 200), test::box("near", {4, 2, -4.5}, {1, 1, 1}, 0.4),
                     test::box("far", {9, -3, -4}, {2, 2, 2}, 0.2), test::wall_at(18, 40, -5, 5)});
}

struct Flicker {
    double typical = 0,
           worst = 0;  ///< dB, std of a bin from ping to ping: median, and of one bin in a hundred
};

/// `anew`: with the samples of side lobes placed anew at every ping. Of the bins from `first` to `end` that
/// are within 60 dB of the loudest.
Flicker flicker_of(Renderer& renderer, const Shot& one, std::size_t first, std::size_t end,
                   bool anew = false) {
    constexpr int pings = 24;
    Shot shot = one;
    const std::size_t size = shot.beams() * shot.bins;
    std::vector<double> sum(size), squares(size), mean(size);
    for (shot.ping = 0; shot.ping < pings; ++shot.ping) {
        if (anew) shot.random_key = shot.ping;
        const Echogram e = renderer.render(shot, {});
        for (std::size_t i = 0; i < size; ++i) {
            const double level = db(std::max(e.values[i], 1e-30F));
            sum[i] += level / pings, squares[i] += level * level / pings,
                mean[i] += e.values[i] / double{pings};
        }
    }
    const double least = *std::ranges::max_element(mean) * 1e-6;
    std::vector<double> spreads;
    for (std::size_t i = 0; i < size; ++i)
        if (i % shot.bins >= first && i % shot.bins < end && mean[i] > least)
            spreads.push_back(std::sqrt(std::max(squares[i] - sum[i] * sum[i], 0.0)));
    std::ranges::sort(spreads);
    EXPECT_GT(spreads.size(), 1000U);
    return {spreads[spreads.size() / 2], spreads[spreads.size() * 99 / 100]};
}

// Up to 13 m a level fan of 20 deg hears the floor through side lobes alone.
TEST(Flicker, WhatSideLobesHearStaysAtRest) {
    Renderer renderer(boxes_on_a_floor(), test::water_of(1500), {.effects = steady()});
    const Flicker side_lobes = flicker_of(renderer, imaging(), 100, 230);
    EXPECT_LT(side_lobes.typical, 0.05);
    EXPECT_LT(side_lobes.worst, 0.5);
    const Flicker before = flicker_of(renderer, imaging(), 100, 230, true);
    EXPECT_GT(before.worst, 3) << "this scene cannot tell";
    std::printf("std from ping to ping: median %.3f dB, 99 %% %.3f dB; placed anew %.3f and %.3f dB\n",
                side_lobes.typical, side_lobes.worst, before.typical, before.worst);
}

// Hovering within a few millimetres is as good as rest.
TEST(Flicker, SamplesMoveWithTheSonarAndNotByLeaps) {
    const PixelOffset here = resting_offset(7, {100, 200, -30}, 0.3),
                      beside = resting_offset(7, {100.003, 200, -30}, 0.3),
                      far = resting_offset(7, {100.4, 200, -30}, 0.3),
                      other = resting_offset(8, {100, 200, -30}, 0.3);
    EXPECT_LT(std::abs(std::remainder(here.line - beside.line, 1)), 0.003);
    EXPECT_LT(std::abs(std::remainder(here.sample - beside.sample, 1)), 0.003);
    EXPECT_GT(std::abs(std::remainder(here.line - far.line, 1)), 0.1);
    EXPECT_GT(std::abs(std::remainder(here.line - other.line, 1)), 0.01);
    double lines = 0, samples = 0;
    for (std::uint64_t key = 0; key < 1000; ++key) {
        const PixelOffset offset = resting_offset(key, {}, 0);
        EXPECT_LE(std::abs(offset.line), 0.5);
        EXPECT_LE(std::abs(offset.sample), 0.5);
        lines += offset.line / 1000, samples += offset.sample / 1000;
    }
    EXPECT_NEAR(lines, 0, 0.03);
    EXPECT_NEAR(samples, 0, 0.03);
}

}  // namespace
}  // namespace echoloop
