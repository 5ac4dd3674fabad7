// How a fan is drawn: its perspective views, the weight of every pixel, and which lines belong to which
// beams. Depends on the fan's geometry only, so one plan serves many pings.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/echogram.h"
#include "render/effects.h"
#include "render/view.h"

namespace echoloop {

class StaveErrors;

struct PlanDensity {
    double columns_per_beam = 1.5;
    double pixels = 1;  ///< factor on the number of pixels
    bool operator==(const PlanDensity&) const = default;
};

/// The lines whose echo a beam hears directly, in its main lobe and the side lobes next to it.
struct BeamLines {
    double bearing = 0;  ///< rad, of its axis
    std::size_t first_line = 0, lines = 0;
    std::size_t first_weight = 0;                      ///< in FanPlan::line_weight, one per line
    std::size_t first_nominal = 0, nominal_lines = 0;  ///< lines that lie within beam_width
};

/// Samples first..last - 1 of a line lie within fan_height.
struct SampleRange {
    std::size_t first = 0, last = 0;
};

/// A far sector, and how much of a pixel or line goes to the next one: sectors are tents, so that coarse
/// pixels leave no pattern.
struct SectorShare {
    std::uint16_t sector = 0;
    float next = 0;
};

/// Something across one pixel: its mean, and how it changes from edge to edge along lines and along samples.
struct Linear {
    float mean = 0, line = 0, sample = 0;
    /// Pixels from its middle.
    float at(float lines, float samples) const { return mean + line * lines + sample * samples; }
};

/// What the array hears of a surround pixel, by where in it a ping samples: then the mean over pings is right
/// to second order, however much the pattern changes across the pixel.
struct SurroundPixel {
    Linear beside, off_plane;  ///< sr, solid angle times the pattern
    Linear sector;             ///< in spacings of sectors, from the first one of a kind
};

/// Far side lobes: `sectors` sums of echo (see far_lobes.h) feed every `beams_per_node`th beam with the
/// weights weight[node * sectors + sector]; the beams between are interpolated.
struct FarLobes {
    std::size_t sectors = 0, nodes = 0, beams_per_node = 1;
    std::vector<float> weight;
};

/// A beam's two-way power over bearing, or over the sine of an angle, so finely that what lies between its
/// values is as if linear.
struct LobeTable {
    double step = 0;            ///< rad, or of the sine
    std::vector<float> values;  ///< from the axis on
    bool empty() const { return values.empty(); }
    /// `off`: rad off the axis, or the sine of that.
    float at(float off) const {
        const float place = std::abs(off) / static_cast<float>(step);
        const std::size_t cell = std::min(static_cast<std::size_t>(place), values.size() - 2);
        const float share = std::min(place - static_cast<float>(cell), 1.0F);
        return values[cell] + share * (values[cell + 1] - values[cell]);
    }
};

/// A lobe that both the sender and the receiver have, or only one, as coarse pixels see it: one way's power
/// over the sine of the angle off the axis, and its square, each as the mean over a pixel's width.
struct SmoothLobe {
    LobeTable power, square;
    LobeTable exact;         ///< one way's power itself
    bool both_ways = false;  ///< else the receiver's alone
    float spacing = 1;       ///< of the nulls, over the sine
    bool empty() const { return power.empty(); }
    /// Of the two-way power at the sine `before`: what a receiver hears that sees the same at `after`. Lobes
    /// that are narrower than a pixel fit each other again and again as they are shifted.
    float kept(float before, float after) const;
};

/// A LobeTable to both sides of the axis, which are not alike where staves differ.
struct SidedLobeTable {
    LobeTable left, right;
    bool empty() const { return right.empty(); }
    float at(float off) const { return (off < 0 ? left : right).at(off); }
};

/// What of a shot decides its plan.
struct FanGeometry {
    std::vector<double> bearings;
    double beam_width = 0, fan_height = 0;
    double elevation_step = 0;  ///< rad, wished between samples: bin length over the window's end
    AxisPattern horizontal, vertical;
    bool patterns = false, side_lobes = false;
    std::vector<double> elevations{};  ///< rad, of rows of such beams; empty: one fan
    ArrayErrors errors{};              ///< of its staves; a single beam and rows have none
    std::size_t staves = 0;            ///< those that have errors; 0: half a wavelength apart
    double margin = 0;  ///< rad, drawn finely beyond a fan's edges: it comes into one that turns
    friend bool operator==(const FanGeometry&, const FanGeometry&) = default;
};

/// Of the beams of one array (see arrays.h). Level views first, ascending in bearing, then the surround
/// views.
struct FanPlan : Picture {
    FanGeometry geometry;
    std::size_t bytes = 0;                 ///< of what grows with the beams
    double centre = 0;                     ///< rad, bearing of the array's axis
    double first_edge = 0, last_edge = 0;  ///< rad, bearings between which it is drawn finely
    std::size_t level_views = 0;
    std::size_t lines = 0;          ///< of the level views
    std::size_t usual_samples = 0;  ///< of a level line at the usual density

    /// Per pixel of each distinct view, see View::first_pixel: the share 0..1 of the pixel that is drawn
    /// finely, and the same times the pixel's solid angle in sr and its pattern.
    std::vector<float> coverage, weight;
    std::size_t first_surround_pixel = 0;
    std::vector<SurroundPixel>
        surround;  ///< from first_surround_pixel on; `weight` is the mean of both kinds

    std::vector<SampleRange> nominal;  ///< of every level line

    std::vector<BeamLines> beams;
    std::vector<float> line_weight;  ///< share of a line's power that a beam hears, 0..1
    SidedLobeTable across;  ///< the same by where in a line a ping samples; empty for boxes and single beams
    /// What a single beam hears over the sine of cone_angle(): its samples are weighed one by one. Empty for
    /// other beams, boxes, and pistons, whose pattern is in `weight`.
    LobeTable beside;
    std::vector<SectorShare> line_sector;  ///< far sector of every level line
    FarLobes far_lobes;
    /// Of the surround's pixels; empty where turning changes nothing. A piston's is the second.
    SmoothLobe far_across, far_upwards;
    /// Of a fan whose beams send as they receive: power over the rad by which the receiver has turned, of
    /// what both have in common in their main lobes and those beside, and in far ones. Else empty.
    LobeTable common_ahead, common_far;
    std::shared_ptr<const StaveErrors> errors;  ///< null: none

    /// The level view that holds an image line.
    const View& view_of(std::size_t line) const;
    /// The level view that shows a bearing, or the one that comes nearest to it.
    const View& view_at(double bearing) const;
    std::span<const View> surround_views() const { return std::span(views).subspan(level_views); }
};

/// At the far end of the window, one sample step moves a surface at 45 degrees by two bins.
FanGeometry geometry_of(const Shot& shot, const Effects& effects);

FanPlan plan_fan(const FanGeometry& geometry, const PlanDensity& density);

}  // namespace echoloop
