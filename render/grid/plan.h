// How rows of beams (Shot::elevations) are drawn: views of the whole field, and which beams hear which pixel
// how loud. Depends on the geometry only, so one plan serves many pings; knows no scene.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/fan/plan.h"
#include "render/grid/lobes.h"

namespace echoloop {

/// A beam that hears a pixel in its main lobe, with this share of the pixel's power in steps of 1 /
/// whole_share.
struct Heard {
    std::uint16_t beam, share;
};
inline constexpr float whole_share = 65535;

/// A sum of far echo, see far.h, and how much of a pixel goes there.
struct FarShare {
    std::uint32_t sum;
    float share;
};

/// Between two neighbours of evenly spaced places: the lower one, and the share of the one after it.
struct Between {
    std::uint16_t lower = 0;
    float next = 0;
};

/// Side lobes of a grid: its beams hear along their row through those beside their axes, and along their
/// column through those above and below. What is off both ways is weaker by both and left out.
///
/// Echo is summed by row and sector of the angle across, and by node across and sector of elevation; sectors
/// are tents as in far_lobes.h. Nodes are evenly spaced angles across the field, and beams lie between two of
/// them.
struct GridFar {
    std::size_t nodes = 0;              ///< 0: no side lobes
    std::vector<float> beside, above;   ///< nodes x sectors, rows x sectors: what a beam hears of them
    std::vector<Between> node, across;  ///< of every beam: its node and its sector
    std::vector<Between> row_sector;    ///< of every row: in elevation
    std::vector<float>
        row_share;  ///< per beam: of its power, so that a row's beams add up to what the row hears
    std::vector<float> column_share;  ///< the same for a column
    /// Of every pixel around the field, from its number in `first` on.
    std::vector<std::uint32_t> first;
    std::vector<FarShare> shares;

    std::size_t sum_beside(std::size_t row, std::size_t sector) const;
    std::size_t sum_above(std::size_t number_of_node, std::size_t sector, std::size_t rows) const;
};

/// The views are those of the field first, each pixel's weight is its solid angle; there are no BeamLines and
/// no level lines.
struct GridPlan : FanPlan {
    explicit GridPlan(const FanGeometry& rows_of_beams);

    GridLobes lobes;
    std::size_t columns, rows;
    std::vector<double>
        axes;  ///< rad, cone angle of each beam's axis, as a line array tells directions apart
    std::vector<std::uint32_t> first_heard;  ///< per pixel of the field's views, and one more
    std::vector<Heard> heard;
    GridFar far;

    std::span<const Heard> heard_by(std::size_t pixel) const {
        return std::span(heard).subspan(first_heard[pixel], first_heard[pixel + 1] - first_heard[pixel]);
    }
    /// Else it is one of those around the field.
    bool is_in_field(std::size_t pixel) const { return pixel + 1 < first_heard.size(); }
    std::span<const View> field_views() const { return std::span(views).first(level_views); }
    std::span<const View> other_views() const { return std::span(views).subspan(level_views); }
};

GridPlan plan_grid(const FanGeometry& geometry, const PlanDensity& density);

}  // namespace echoloop
