// The steps in which plan_fan() makes a plan. Used by the planning code only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/fan/lobe.h"
#include "render/fan/plan.h"

namespace echoloop {

/// The weights of a fan's directions.
struct FanLobes {
    FanLobes(const FanGeometry& geometry, std::shared_ptr<const StaveErrors> errors);

    Lobe horizontal, vertical;
    bool surround;  ///< level views hand over to it at their upper and lower limits
    bool single;    ///< one beam: surround pixels are weighed with its whole pattern
    bool piston;    ///< the pattern depends on the angle off the axis only

    /// Two-way power of a piston at bearing and elevation off its axis.
    double of_piston(double bearing, double elevation) const;
};

/// rad; level views reach so far above and below the fan's plane.
inline double drawn_half_height(const FanLobes& lobes) {
    return std::min(lobes.vertical.edge(), deg_to_rad(60));
}

/// Share 0..1 of a direction's echo that the level views take: it falls to nothing over the last 5 deg, and
/// the surround takes the rest, so that their pixels of different size leave no seam.
inline double level_share_at(double edge, double elevation) {
    return std::clamp((edge - std::abs(elevation)) / std::min(deg_to_rad(5), edge / 3), 0.0, 1.0);
}
inline double level_share(const FanLobes& lobes, double elevation) {
    const double edge = drawn_half_height(lobes);
    if (!lobes.surround) return std::abs(elevation) <= edge ? 1 : 0;
    return level_share_at(edge, elevation);
}

/// How many pixels the usual one is wide, where `usual` of them would do for `count`.
inline double usual_size(std::size_t count, std::size_t usual) {
    return std::max(1.0, static_cast<double>(count) / static_cast<double>(usual));
}

/// Into how many parts each side of a pixel is cut where it makes `parts` of them: a whole number of samples,
/// so that each has neighbours a pixel away, and a rest of lines.
inline std::size_t cuts_per_side(double parts) {
    return static_cast<std::size_t>(std::ceil(std::sqrt(std::max(parts, 1.0)) - 1e-9));
}

/// Near side lobes are summed line by line up to this many beam widths off the axis: five lobes of a line
/// aperture, down to -25 dB one way.
inline constexpr double near_beam_widths = 7;

/// rad, of a line's edges and its middle.
struct LineBearings {
    double low = 0, middle = 0, high = 0;
};

/// Of all level lines.
std::vector<LineBearings> bearings_of_lines(const FanPlan& plan);
/// Appends the level views.
void add_level_views(FanPlan& plan, const FanGeometry& geometry, const PlanDensity& density,
                     const FanLobes& lobes);
/// Weighs the pixels of all level views, and finds which of them lie within the nominal height.
void weigh_level_pixels(FanPlan& plan, const FanLobes& lobes, double fan_height);
/// Gives each beam its lines.
void share_lines(FanPlan& plan, const FanGeometry& geometry, const FanLobes& lobes);
/// Appends views of all directions that the level views leave out, as far as the array hears them.
void add_surround(FanPlan& plan, const FanGeometry& geometry, const FanLobes& lobes, double density);
/// All directions in front of an array: five faces of a cube of `side` x `side` pixels, those beside cut in
/// half.
std::array<View, 5> front_half_cube(std::size_t side);
/// Sorts lines and surround pixels into sectors and finds what each beam hears of them.
void add_far_lobes(FanPlan& plan, const FanGeometry& geometry, const FanLobes& lobes);

}  // namespace echoloop
