// The frame of a polar picture: where the sonar stands in it, its rings, ticks, labels, captions and colour
// bar. Knows no level and no file.
#pragma once

#include <string>

#include "tools/draw/canvas.h"
#include "tools/draw/polar.h"

namespace echoloop::draw {

/// What the colour bar and the captions say.
struct Legend {
    std::string title, subtitle;
    double bottom = 0, top = 1;  ///< levels of the darkest and the brightest colour
    double label_step = 10;
    std::string unit;
};

struct Chart {
    int width = 0, height = 0;                     ///< px, of the whole picture
    double center_x = 0, center_y = 0;             ///< px, the sonar
    double scale = 1;                              ///< px per m
    int left = 0, top = 0, right = 0, bottom = 0;  ///< px, box around the sector

    /// Fits the sector of `scan` into a picture `width` px wide.
    static Chart fit(const PolarScan& scan, int width);
};

void draw_grid(Canvas& canvas, const Chart& chart, const PolarScan& scan);
void draw_legend(Canvas& canvas, const Chart& chart, const Legend& legend);

}  // namespace echoloop::draw
