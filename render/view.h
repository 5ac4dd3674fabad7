// Perspective views of a fan: which bearings and elevations their pixels see. Pure geometry; knows no GL and
// no scene.
//
// The image is transposed: one image row (a "line") is one bearing, so that what goes into one beam lies
// together in memory; along a line the elevation falls from sample to sample. Image plane at focal length 1:
// x to starboard, y up.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/pose.h"

namespace echoloop {

struct View {
    double bearing = 0, elevation = 0;  ///< rad, of the view's axis, relative to the fan's centre
    double left = 0, right = 0, bottom = 0, top = 0;  ///< edges on the image plane
    std::size_t lines = 0, samples = 0;
    /// Lines, at least 0.5, and samples, at least 1, that a pixel of the usual size is wide and high.
    double usual_width = 1, usual_height = 1;
    bool sharp_outlines = false;  ///< a sample beside an outline is not spread beyond it
    bool surround = false;        ///< of what side lobes alone hear: coarse, and sampled at rest
    std::size_t first_line = 0;   ///< of this view in the image that all views share
    std::size_t first_pixel = 0;  ///< of this view's weights in the plan: lines x samples of them

    double line_width() const { return (right - left) / static_cast<double>(lines); }
    double sample_height() const { return (top - bottom) / static_cast<double>(samples); }
    /// Image plane coordinates; whole numbers are pixel edges, +0.5 their centres.
    double x(double line) const { return left + line * line_width(); }
    double y(double sample) const { return top - sample * sample_height(); }
    /// rad, relative to the fan's centre; of a level view.
    double bearing_at(double line) const { return bearing + std::atan(x(line)); }
    /// rad, elevation over the fan's plane; of a level view.
    double elevation_at(double line, double sample) const {
        return std::atan(y(sample) / std::sqrt(1 + x(line) * x(line)));
    }
    /// sr, of one pixel in a line whose middle has the square `x2` of x: dx dy / (1 + x^2 + y^2)^(3/2).
    double solid_angle(double x2, std::size_t sample) const;

    /// Rotation from the view (x forward, y to port, z up) to the fan's own frame.
    Quat fan_from_view() const { return axis_angle({0, 0, 1}, -bearing) * axis_angle({0, 1, 0}, -elevation); }
};

/// The views of one picture: an image of image_lines x samples pixels holds them one below the other.
struct Picture {
    std::vector<View> views;
    std::size_t image_lines = 0;
    std::size_t samples = 0;  ///< the image's width

    std::size_t pixels() const;  ///< of all views
};

/// Rotation from the fan's frame to the sonar's, after pan and tilt as Shot defines them.
inline Quat sonar_from_fan(double pan, double tilt) {
    return axis_angle({0, 0, 1}, -pan) * axis_angle({0, 1, 0}, -tilt);
}

/// Where in its pixel a ping samples, in pixels within -0.5..0.5.
struct PixelOffset {
    double line = 0, sample = 0;
};

/// An evenly spread sequence over pings (R2, the plastic number), 0 for ping 0: the mean over N pings sees a
/// pixel's area as N well spread samples do.
PixelOffset jitter_of(std::uint64_t ping);

/// Of one ping.
struct SampleOffsets {
    PixelOffset level, surround;
    PixelOffset of(const View& view) const { return view.surround ? surround : level; }
};

}  // namespace echoloop
