// The fans of an image against the geometry of the render module: each pixel's beam looks where the maker's
// formula says that the pixel does.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "emulator/devices/sonar-3d-15/view.h"

namespace echoloop::sonar_3d_15 {
namespace {

struct Look {
    std::size_t fans;
    double worst_across, worst_along;  ///< rad, off the beam's axis
    std::size_t beams_used;
};

/// Differences between the maker's formula and the beam of Shot, in and across the fan's plane.
Look look_at(const ModeFigures& mode, bool first_row_up) {
    const View view = make_view(mode, first_row_up);
    Look look{view.tilts.size(), 0, 0, 0};
    std::set<std::pair<std::size_t, std::size_t>> used;
    for (std::size_t fan = 0; fan < view.pixels.size(); ++fan) {
        for (const PixelBeam& at : view.pixels[fan]) {
            const double px = static_cast<double>(at.pixel % 256), py = static_cast<double>(at.pixel / 256);
            const double yaw = px / 255 * mode.fov_horizontal - mode.fov_horizontal / 2;
            const double pitch =
                (py / 63 * mode.fov_vertical - mode.fov_vertical / 2) * (first_row_up ? -1 : 1);
            // Forward, starboard, up of the pixel, and the same turned into the fan's plane.
            const double x = std::cos(pitch) * std::cos(yaw), y = std::cos(pitch) * std::sin(yaw);
            const double z = std::sin(pitch), t = view.tilts[fan];
            const double in_x = x * std::cos(t) + z * std::sin(t), in_z = z * std::cos(t) - x * std::sin(t);
            look.worst_across = std::max(look.worst_across, std::abs(std::asin(in_z)));
            look.worst_along =
                std::max(look.worst_along, std::abs(std::atan2(y, in_x) - view.bearings[at.beam]));
            used.emplace(fan, at.beam);
        }
    }
    look.beams_used = used.size();
    return look;
}

void expect_true(const ModeFigures& mode) {
    for (const bool first_row_up : {false, true}) {
        const Look look = look_at(mode, first_row_up);
        EXPECT_LE(look.worst_across, mode.fov_vertical / 63 / 2 + 1e-6);
        EXPECT_LE(look.worst_along, mode.fov_horizontal / 255 / 2 + 1e-3);
        EXPECT_EQ(look.beams_used, 256U * 64) << "no two pixels share a beam";
    }
}

TEST(Sonar3d15View, EveryPixelHasABeamOfItsOwnWithinHalfARowAndColumn) {
    ModeFigures low, high;
    low.fov_horizontal = deg_to_rad(90);
    high.fov_horizontal = low.fov_vertical = high.fov_vertical = deg_to_rad(40);
    expect_true(low);
    expect_true(high);
    EXPECT_EQ(look_at(low, false).fans, 86U);
    EXPECT_EQ(look_at(high, false).fans, 68U);
}

TEST(Sonar3d15View, TheMiddleColumnsHaveTheirRowsExactly) {
    ModeFigures low;
    low.fov_horizontal = deg_to_rad(90);
    low.fov_vertical = deg_to_rad(40);
    const View view = make_view(low, false);
    std::size_t found = 0;
    for (std::size_t fan = 0; fan < view.tilts.size(); ++fan)
        for (const PixelBeam& at : view.pixels[fan])
            if (at.pixel % 256 == 128) {
                const double pitch =
                    static_cast<double>(at.pixel / 256) / 63 * low.fov_vertical - low.fov_vertical / 2;
                EXPECT_NEAR(view.tilts[fan], pitch, 1e-5);
                ++found;
            }
    EXPECT_EQ(found, 64U);
}

}  // namespace
}  // namespace echoloop::sonar_3d_15
