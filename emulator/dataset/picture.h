// Pictures of pings as matrices of counts: columns of beams over range, the same in metres, rows of beams.
// Each pixel is one bin, of which it has the level and the label; nothing is interpolated.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/echogram.h"

namespace echoloop {

/// Grey values of a picture. Counts go from 1; 0 is nothing: no echo at all, or no beam looks there.
struct PictureScale {
    double at_0, per_count;
    std::uint16_t count(double level) const;
};
/// dB re 1 uPa; the paper's rule has values of 0..1.
PictureScale scale_of(EchoRule rule);

/// Range in a column: of the leading edge of bin 0, of a bin.
struct RangeAxis {
    double first = 0, step = 0;  ///< m
    std::size_t bins = 0;
};

struct CountPicture {
    std::size_t width = 0, height = 0;
    std::vector<std::uint16_t> counts, labels;  ///< row by row from the top
};

/// Columns of bins, one for each beam, in the order in which they come.
struct Scan {
    std::vector<double> bearings;               ///< rad, clockwise, of each column
    std::vector<std::uint16_t> counts, labels;  ///< column by column
};

/// Range downwards from the nearest bin, a column for each beam.
CountPicture polar_picture(const Scan& scan, std::size_t bins);

/// From above, the sonar's axis up and starboard to the right: which bins each pixel shows.
struct CartesianMap {
    struct Spot {
        std::uint32_t first = 0, count = 0;  ///< in Scan::counts; 0: no beam looks there
    };
    std::size_t width = 0, height = 0;
    double metres_per_pixel = 0, origin_x = 0, origin_y = 0;  ///< px, of the sonar from the upper left corner
    std::vector<Spot> spots;
};

/// `width`: rad, of a beam. 400 pixels at most to the end of the range. All round, the sonar is in the
/// middle; else the picture is cut to the sector.
CartesianMap cartesian_map(std::span<const double> bearings, double width, const RangeAxis& axis,
                           bool all_round);
/// Of the bins in a pixel, the loudest.
CountPicture cartesian_picture(const CartesianMap& map, const Scan& scan);

/// Rows of beams as they look ahead, the highest at the top: the loudest bin of each, and its range in steps
/// of 1 mm, or of 1 cm where 65 m are not enough.
struct FrontPictures {
    CountPicture levels;
    std::vector<std::uint16_t> ranges;
    double metres_per_count = 0.001;
};
FrontPictures front_pictures(std::span<const std::uint16_t> counts, std::span<const std::uint16_t> labels,
                             const Shot& shot, const RangeAxis& axis);

}  // namespace echoloop
