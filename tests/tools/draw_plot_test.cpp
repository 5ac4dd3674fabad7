#include <gtest/gtest.h>

#include <stdexcept>

#include "tools/draw/palette.h"
#include "tools/draw/plot.h"

namespace echoloop::draw {
namespace {

/// Middle of the pixels that differ between two pictures; (-1, -1) if none do.
std::pair<double, double> middle_of_change(const Image& before, const Image& after) {
    double x = 0, y = 0, count = 0;
    for (int py = 0; py < after.height; ++py)
        for (int px = 0; px < after.width; ++px)
            if (before.at(px, py) != after.at(px, py)) x += px, y += py, ++count;
    return count > 0 ? std::pair{x / count, y / count} : std::pair{-1.0, -1.0};
}

Plot plot_with(std::vector<std::pair<double, double>> dots) {
    return {"", "", "", {{"", {{0, 0}, {10, 0}}, false}, {"", std::move(dots), true}}, 0, 10};
}

TEST(Plot, PlacesPointsLinearlyOnBothAxes) {
    const Image empty = plot_picture(plot_with({}));
    const auto at = [&](double x, double y) {
        return middle_of_change(empty, plot_picture(plot_with({{x, y}})));
    };
    const auto low = at(2.5, 2.5), middle = at(5, 5), high = at(7.5, 7.5);
    EXPECT_NEAR(middle.first - low.first, high.first - middle.first, 1);
    EXPECT_NEAR(middle.second - low.second, high.second - middle.second, 1);
    EXPECT_GT(middle.first - low.first, 150);   // a quarter of the width
    EXPECT_GT(low.second - middle.second, 60);  // upwards
    EXPECT_NEAR(at(5, 2.5).first, middle.first, 1);
}

TEST(Plot, LeavesOutWhatIsBeyondTheAxis) {
    const Image empty = plot_picture(plot_with({}));
    EXPECT_EQ(middle_of_change(empty, plot_picture(plot_with({{5, 11}}))).first, -1);
    EXPECT_EQ(middle_of_change(empty, plot_picture(plot_with({{5, -1}}))).first, -1);
}

TEST(Plot, RefusesAnAxisWithoutExtent) {
    EXPECT_THROW(plot_picture({"", "", "", {}, 0, 1}), std::invalid_argument);
    EXPECT_THROW(plot_picture({"", "", "", {{"", {{1, 1}}, true}}, 0, 1}), std::invalid_argument);
    EXPECT_THROW(plot_picture({"", "", "", {{"", {{0, 0}, {1, 1}}, true}}, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::draw
