// How rows of beams (Shot::elevations) are drawn: views of the whole field, and which beams hear which pixel
// how loud. Depends on the geometry only, so one plan serves many pings; knows no scene.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/fan/plan.h"

namespace echoloop {

/// What of a shot decides its plan.
struct GridGeometry {
    FanGeometry row;                 ///< of one row: bearings, widths, patterns
    std::vector<double> elevations;  ///< rad, of the rows
    friend bool operator==(const GridGeometry&, const GridGeometry&) = default;
};

GridGeometry grid_geometry_of(const Shot& shot, const Effects& effects);

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

struct GridPlan {
    /// The views, those of the field first, and the solid angle of each pixel; no beams and no lines.
    FanPlan drawing;
    std::size_t columns = 0, rows = 0;
    std::vector<double>
        across;  ///< rad, cone angle of each beam's axis, as a line array tells directions apart
    std::vector<std::uint32_t> first_heard;  ///< per pixel of the field's views, and one more
    std::vector<Heard> heard;
    GridFar far;

    std::span<const Heard> heard_by(std::size_t pixel) const {
        return std::span(heard).subspan(first_heard[pixel], first_heard[pixel + 1] - first_heard[pixel]);
    }
    /// Of what grows with the grid.
    std::size_t bytes() const {
        return heard.size() * sizeof heard[0] + first_heard.size() * sizeof first_heard[0] +
               far.shares.size() * sizeof far.shares[0] +
               across.size() * (sizeof across[0] + 4 * sizeof(float));
    }
    std::span<const View> field_views() const { return std::span(drawing.views).first(drawing.level_views); }
    std::span<const View> other_views() const {
        return std::span(drawing.views).subspan(drawing.level_views);
    }
};

GridPlan plan_grid(const GridGeometry& geometry, const PlanDensity& density);

}  // namespace echoloop
