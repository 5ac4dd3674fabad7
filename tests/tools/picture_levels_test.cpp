// Levels of a picture are steps of half a decibel: each byte stands for the level that it begins at.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tools/bag/levels.h"

namespace echoloop::bag {
namespace {

constexpr std::size_t beams = 8, bins = 500;
constexpr double step = 0.5, rounding = 1e-3;  // dB

Echogram echogram_of(std::vector<float> values) {
    Shot shot;
    shot.bearings.assign(beams, 0.0);
    shot.bins = bins;
    return {shot, {}, {}, 1500, std::move(values), 0, {}, {}};
}

TEST(PictureLevels, EachByteBeginsAtItsLevel) {
    std::mt19937 random(5);
    for (const float loudest : {1e-6F, 1.0F, 3e11F, 9e19F}) {
        std::uniform_real_distribution<float> decibels(-126, 0);
        std::vector<float> values;
        for (std::size_t i = 0; i < beams * bins; ++i)
            values.push_back(loudest * std::pow(10.0F, decibels(random) / 10));
        values.front() = loudest;
        const Levels levels = levels_of(echogram_of(values));
        ASSERT_EQ(levels.bytes.size(), values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double byte = static_cast<std::uint8_t>(levels.bytes[i]);
            ASSERT_GT(byte, 0) << values[i];
            const double above = 10 * std::log10(double(values[i])) - (levels.floor + (byte - 1) * step);
            EXPECT_GE(above, -rounding) << values[i];
            EXPECT_LT(above, step + rounding) << values[i];
        }
    }
}

TEST(PictureLevels, WhatIsSilentOrFarBelowTheLoudestIsNothing) {
    std::vector<float> values(beams * bins, 0.0F);
    values[0] = 1e9F, values[1] = 1e9F * 1e-13F, values[2] = -1.0F;
    const Levels levels = levels_of(echogram_of(values));
    EXPECT_EQ(levels.bytes.substr(1), std::string(values.size() - 1, '\0'));
    EXPECT_NE(levels.bytes[0], '\0');
}

}  // namespace
}  // namespace echoloop::bag
