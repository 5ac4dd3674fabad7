// Ranges of neighbours as a real Sonar 3D-15 sends them: often equal, though the echoes are not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "emulator/contract/random_key.h"
#include "emulator/devices/sonar-3d-15/image.h"

namespace echoloop::sonar_3d_15 {
namespace {

/// Independent noise; every 16th pixel or so has no echo.
std::vector<std::uint32_t> noise() {
    std::vector<std::uint32_t> image(width * height);
    for (std::size_t i = 0; i < image.size(); ++i)
        image[i] =
            split_mix(i + 99999) % 16 == 0 ? 0 : 10000 + static_cast<std::uint32_t>(split_mix(i) % 5000);
    return image;
}

TEST(Sonar3d15Ranges, HaveTheRunsOfARecording) {
    const auto image = smoothed(noise());
    std::array<double, 5> runs{};
    double all = 0;
    for (std::size_t row = 0; row < height; ++row)
        for (std::size_t at = row * width; at < (row + 1) * width;) {
            std::size_t end = at;
            while (end < (row + 1) * width && image[end] == image[at]) ++end;
            if (image[at] != 0) ++runs.at(std::min<std::size_t>(end - at, 5) - 1), ++all;
            at = end;
        }
    // Six real images: 0.495, 0.308, 0.143, 0.043. Independent noise has no slopes, as theirs have: nearer it
    // is before a surface, in tests/e2e/test_recordings.py.
    EXPECT_NEAR(runs[0] / all, 0.50, 0.12);
    EXPECT_NEAR(runs[1] / all, 0.31, 0.08);
    EXPECT_NEAR(runs[2] / all, 0.14, 0.05);
    EXPECT_NEAR(runs[3] / all, 0.04, 0.03);
}

TEST(Sonar3d15Ranges, WithoutAnEchoStayWithout) {
    const auto before = noise(), after = smoothed(before);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i] == 0, after[i] == 0);
    const std::vector<std::uint32_t> flat(width * height, 5);
    EXPECT_EQ(smoothed(flat), flat);
    std::vector<std::uint32_t> lone(width * height, 0);
    lone[300] = 7;
    EXPECT_EQ(smoothed(lone), lone);
}

}  // namespace
}  // namespace echoloop::sonar_3d_15
