#include "render/fan/pixel_rows.h"

#include <gtest/gtest.h>

#include <vector>

namespace echoloop {
namespace {

constexpr float end = 10;  // m, of the window

/// A plane seen at grazing incidence: 1/R falls by 0.01 a pixel from 0.145, so that after five pixels it is
/// beyond the window.
Pixel pixel_of_plane(int i) { return {1 / (0.145F - 0.01F * static_cast<float>(i)), 0.2F, 0.5F, 3}; }

PixelRow loaded(const std::vector<Pixel>& pixels) {
    PixelRow row;
    row.load(pixels.data(), pixels.size(), end);
    return row;
}

TEST(PixelRow, APlaneThatLeavesTheWindowGoesOnByOnePixel) {
    std::vector<Pixel> pixels;
    for (int i = 0; i < 5; ++i) pixels.push_back(pixel_of_plane(i));
    pixels.resize(70);
    const PixelRow row = loaded(pixels);
    EXPECT_NEAR(row.range()[5], 1 / 0.095, 1e-4);
    EXPECT_EQ(row.surface()[5], 3);
    for (std::size_t i = 6; i < 70; ++i) EXPECT_EQ(row.surface()[i], 0) << i;
}

TEST(PixelRow, SoDoesOneThatComesIntoIt) {
    std::vector<Pixel> pixels(40);
    for (int i = 4; i >= 0; --i) pixels.push_back(pixel_of_plane(i));
    const PixelRow row = loaded(pixels);
    EXPECT_NEAR(row.range()[39], 1 / 0.095, 1e-4);
    EXPECT_EQ(row.surface()[39], 3);
    for (std::size_t i = 0; i < 39; ++i) EXPECT_EQ(row.surface()[i], 0) << i;
}

/// The plane before it goes on over a gap of one pixel, whatever comes behind.
TEST(PixelRow, AGapOfOnePixelIsFilledFromBefore) {
    std::vector<Pixel> pixels;
    for (int i = 0; i < 5; ++i) pixels.push_back(pixel_of_plane(i));
    pixels.push_back({});
    for (int i = 4; i >= 0; --i) pixels.push_back(pixel_of_plane(i)), pixels.back().surface = 4;
    EXPECT_EQ(loaded(pixels).surface()[5], 3);
}

TEST(PixelRow, APlaneThatEndsWithinTheWindowDoesNotGoOn) {
    std::vector<Pixel> pixels;
    for (int i = 0; i < 3; ++i) pixels.push_back(pixel_of_plane(i));
    pixels.resize(20);
    const PixelRow row = loaded(pixels);
    for (std::size_t i = 3; i < 20; ++i) EXPECT_EQ(row.surface()[i], 0) << i;
}

}  // namespace
}  // namespace echoloop
