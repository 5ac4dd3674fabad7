// How a fan is drawn: its perspective views, the weight of every pixel, and which lines belong to which
// beams. Depends on the fan's geometry only, so one plan serves many pings.
#pragma once

#include <cstdint>
#include <vector>

#include "render/echogram.h"
#include "render/fan/view.h"

namespace echoloop {

struct PlanDensity {
    double columns_per_beam = 3;
    double pixels = 1;  ///< factor on the number of pixels
};

/// A share of a line's echo that goes to a beam.
struct BeamShare {
    std::uint32_t beam;
    float weight;  ///< of the line's power, 0..1: a box of beam_width now; a beam pattern has its place here
};

struct FanPlan {
    std::vector<View> views;
    std::size_t lines = 0, samples = 0;  ///< of the image that holds all views, one below the other

    /// Per pixel: the share 0..1 of the pixel within the fan's height (a box; a vertical pattern has its
    /// place here), and the same times the pixel's solid angle in sr. lines x samples.
    std::vector<float> coverage, solid_angle;

    /// Line i feeds shares[first_share[i]] up to shares[first_share[i + 1]].
    std::vector<BeamShare> shares;
    std::vector<std::uint32_t> first_share;

    /// The view that holds an image line.
    const View& view_of(std::size_t line) const;
};

/// What of a shot decides its plan.
struct FanGeometry {
    std::vector<double> bearings;
    double beam_width = 0, fan_height = 0;
    double elevation_step = 0;  ///< rad, wished between samples: bin length over the window's end
    friend bool operator==(const FanGeometry&, const FanGeometry&) = default;
};

/// At the far end of the window, one sample step moves a surface at 45 degrees by one bin.
FanGeometry geometry_of(const Shot& shot);

FanPlan plan_fan(const FanGeometry& geometry, const PlanDensity& density);

}  // namespace echoloop
