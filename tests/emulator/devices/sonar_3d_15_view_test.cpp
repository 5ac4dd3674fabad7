// The beams of an image: each pixel's beam looks where the maker's formula says that the pixel does.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "emulator/devices/sonar-3d-15/view.h"

namespace echoloop::sonar_3d_15 {
namespace {

void expect_true(const ModeFigures& mode, bool first_row_up) {
    const View view = make_view(mode, first_row_up);
    ASSERT_EQ(view.bearings.size(), 256U);
    ASSERT_EQ(view.elevations.size(), 64U);
    std::set<std::size_t> pixels;
    for (std::size_t beam = 0; beam < 256 * 64; ++beam) {
        const std::size_t pixel = view.pixel_of(beam);
        pixels.insert(pixel);
        const double px = static_cast<double>(pixel % 256), py = static_cast<double>(pixel / 256);
        const double yaw = px / 255 * mode.fov_horizontal - mode.fov_horizontal / 2;
        const double pitch = py / 63 * mode.fov_vertical - mode.fov_vertical / 2;
        EXPECT_NEAR(view.bearings[beam % 256], yaw, 1e-12);
        EXPECT_NEAR(view.elevations[beam / 256], first_row_up ? -pitch : pitch, 1e-12);
    }
    EXPECT_EQ(pixels.size(), 256U * 64) << "no two beams share a pixel";
    EXPECT_EQ(*pixels.rbegin(), 256U * 64 - 1);
}

TEST(Sonar3d15View, EveryPixelHasTheBeamOfTheMakersFormula) {
    ModeFigures low, high;
    low.fov_horizontal = deg_to_rad(90);
    high.fov_horizontal = low.fov_vertical = high.fov_vertical = deg_to_rad(40);
    for (const bool first_row_up : {false, true}) {
        expect_true(low, first_row_up);
        expect_true(high, first_row_up);
    }
}

}  // namespace
}  // namespace echoloop::sonar_3d_15
