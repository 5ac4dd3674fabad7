// Curves over two linear axes, as a picture. Knows no sonar and no file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/draw/draw.h"

namespace echoloop::draw {

struct Curve {
    std::string label;
    std::vector<std::pair<double, double>> points;  ///< x ascending
    bool dots = false;                              ///< single points instead of a line
};

struct Plot {
    std::string title, x_label, y_label;
    std::vector<Curve> curves;
    double bottom = 0, top = 1;  ///< of the vertical axis; what is outside is not drawn
};

/// Throws std::invalid_argument if there is no point, or the horizontal or vertical axis has no extent.
Picture plot_picture(const Plot& plot, int width = 900, int height = 480);

}  // namespace echoloop::draw
